#!/usr/bin/env python3
"""Draws the cells of others as lines for `--lattice`: x1,y1,x2,y2,rise in mm.

  cells.py hexagon-to-kagome SIDE GAMMA COLUMNS ROWS    hexagons whose corners become triangles of edge GAMMA x SIDE
  cells.py circles RADIUS COLUMNS ROWS                  circles that touch, square packed
  cells.py petals RADIUS COLUMNS ROWS HALF_AXIS         the same with two crossed ellipses in each circle
"""
import math
import sys


def hexagon_to_kagome(side, gamma, columns, rows):
    columns, rows = int(columns), int(rows)
    width, cut = math.sqrt(3) * side, gamma * side / math.sqrt(3)
    corners, walls = {}, set()
    for row in range(rows):
        for column in range(columns):
            centre = (width * (column + 0.5 * (row % 2)), 1.5 * side * row)
            ring = []
            for i in range(6):
                angle = math.pi * (i / 3 + 1 / 6)
                place = (centre[0] + side * math.cos(angle), centre[1] + side * math.sin(angle))
                key = (round(place[0] / side * 1000), round(place[1] / side * 1000))
                corners.setdefault(key, place)
                ring.append(key)
            walls.update(tuple(sorted((ring[i - 1], ring[i]))) for i in range(6))
    points = {key: [] for key in corners}
    for a, b in sorted(walls):
        start, end = corners[a], corners[b]
        share = cut / side
        near = tuple(s + share * (e - s) for s, e in zip(start, end))
        far = tuple(e + share * (s - e) for s, e in zip(start, end))
        if share < 0.499:
            yield *near, *far, 0.0
        points[a].append(near)
        points[b].append(far)
    if gamma > 0:
        for around in points.values():
            for i in range(len(around)):
                for j in range(i):
                    yield *around[j], *around[i], 0.0


def circles(radius, columns, rows):
    rise = radius * (1 - math.sqrt(0.5))
    for row in range(int(rows)):
        for column in range(int(columns)):
            x, y = 2 * radius * column, 2 * radius * row
            around = [(x + radius, y), (x, y + radius), (x - radius, y), (x, y - radius)]
            for i in range(4):
                yield *around[i - 1], *around[i], -rise


def petals(radius, columns, rows, half_axis, chords=24):
    yield from circles(radius, columns, rows)
    for row in range(int(rows)):
        for column in range(int(columns)):
            for a, b in ((radius, half_axis), (half_axis, radius)):
                angles = [2 * math.pi * i / chords for i in range(chords + 1)]
                ring = [(2 * radius * column + a * math.cos(t), 2 * radius * row + b * math.sin(t)) for t in angles]
                for start, end in zip(ring, ring[1:]):
                    yield *start, *end, 0.0


def main():
    kinds = {"hexagon-to-kagome": hexagon_to_kagome, "circles": circles, "petals": petals}
    if len(sys.argv) < 3 or sys.argv[1] not in kinds:
        sys.exit(__doc__)
    print("x1,y1,x2,y2,rise")
    for line in kinds[sys.argv[1]](*map(float, sys.argv[2:])):
        print(",".join(f"{value:.6f}" for value in line))


if __name__ == "__main__":
    main()
