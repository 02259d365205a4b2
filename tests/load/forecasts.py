#!/usr/bin/env python3
"""Predicted memory and disk space of jobs (cellcrush check) against what their workers use; a row of CSV each.

--record replaces these rows in forecasts.csv, and the figures of the table of README.md in evidence.csv.
"""
import argparse
import csv
import itertools
import json
import math
import os
import subprocess
import tempfile
import time

LATTICES = {"hexagon": 3, "square": 2, "triangle": 3}  # and the walls of a cell
# Hexagons that are listed as a frame, without plates.
FRAMES = ["frame_pushed", "frame_struck", "frame_loaded"]
LARGEST_FRAME = 100_000  # a larger one is more than a message may have
LAWS = {
    "plastic": [],
    "hardening": ["material.hardening_modulus_mpa=700", "material.isotropic_fraction=0.5"],
    "friction": ["contact.friction=0.2", "plates.friction=0.2"],
    "paper": ["section.formulation=DISPLACEMENT_BASED", "section.depth_rule=LOBATTO",
              "section.area_rule=CONSTANT_AREA"],
}
# Of so many elements: the strain to crush to, and seconds between checkpoints, so that a run writes several.
SIZES = {1_000: (0.8, 0.02), 10_000: (0.5, 0.05), 100_000: (0.05, 0.5), 500_000: (0.05, 5), 2_000_000: (0.02, 20)}
ELEMENTS_PER_WALL = 4
SIDE_MM, THICKNESS_MM = 4, 0.3
SPEED = 200  # m/s
COMMON = """
depth_mm: 4 elements_per_wall: 4 material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
output { sample_count: 100 frame_count: 10 } """
COLUMNS = ["lattice", "law", "size", "elements", "memory_predicted_mb", "memory_mb", "disk_predicted_mb", "disk_mb",
           "data_mb", "result_predicted_mb", "result_mb"]
HERE = os.path.dirname(os.path.abspath(__file__))


def frame_of(kind, columns, rows, strain):
    """On a rigid wall: pushed by another as by a plate, struck by one of several times its mass, or loaded a little."""
    nodes, beams = {}, []
    for row, column in itertools.product(range(rows), range(columns)):
        x, y = math.sqrt(3) * SIDE_MM * (column + 0.5 * (row % 2)), 1.5 * SIDE_MM * row
        corners = [(x + SIDE_MM * math.sin(turn), y + SIDE_MM * math.cos(turn))
                   for turn in (math.pi / 3 * corner for corner in range(6))]
        ring = [nodes.setdefault((round(1e3 * x), round(1e3 * y)), len(nodes)) for x, y in corners]
        beams += [tuple(sorted(pair)) for pair in zip(ring, ring[1:] + ring[:1])]
    low, high = (end(x for x, _ in nodes) / 1e3 for end in (min, max))
    end_time = strain * (high - low) / (1e3 * SPEED)
    walls = {
        "frame_pushed": "displacement_mm { points { time_s: 0 value: 0 } "
                        f"points {{ time_s: {end_time} value: {1e3 * SPEED * end_time} }} }}",
        "frame_struck": f"mass_g: {0.03 * len(beams)} speed_m_per_s: {SPEED}",
    }
    yield "lattice { frame { self_contact: true "
    yield from (f'nodes {{ id: "{name}" x_mm: {x / 1e3} y_mm: {y / 1e3} }}' for (x, y), name in nodes.items())
    yield from (f'beams {{ start: "{start}" end: "{end}" thickness_mm: {THICKNESS_MM} }}'
                for start, end in sorted(set(beams)))
    yield f'rigid_walls {{ id: "support" x_mm: {high + THICKNESS_MM} y_mm: 0 normal_x: -1 }}'
    if kind in walls:
        yield f'rigid_walls {{ id: "impact" x_mm: {low - THICKNESS_MM} y_mm: 0 normal_x: 1 {walls[kind]} }}'
    else:
        force = "component: COMPONENT_X force_n_or_n_mm { points { time_s: 0 value: 0.1 } }"
        yield from (f'loads {{ node: "{name}" {force} }}' for (x, _), name in nodes.items() if x / 1e3 < low + SIDE_MM)
    yield f"end_time_s: {end_time} }} }}"


def case_of(lattice, size):
    """Few columns, which are crushed in few steps; the more elements, the less far."""
    columns = 10 if size < 100_000 else 40
    rows = max(2, round(0.995 * size / (LATTICES.get(lattice, 3) * ELEMENTS_PER_WALL * columns)))
    strain = SIZES[size][0]
    if lattice in FRAMES:
        return "\n".join(frame_of(lattice, columns, rows, strain)) + COMMON
    return (
        f"lattice {{ {lattice} {{ columns: {columns} rows: {rows} side_mm: {SIDE_MM} "
        f"wall_thickness_mm: {THICKNESS_MM} }} }}"
        + COMMON + f"loading {{ speed_m_per_s: {SPEED} end_strain: {strain} }}"
    )


class Daemon:
    """With one worker; ends with the block."""

    def __init__(self, programs, folder, *options):
        self.data = os.path.join(folder, "data")
        self.client = [os.path.join(programs, "cellcrush"), "--server", "unix:" + os.path.join(folder, "socket")]
        self.process = subprocess.Popen(
            [os.path.join(programs, "cellcrushd"), "--data", self.data, "--listen", self.client[2], "--http", "none"]
            + ["--workers", "1", *options],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.process.stdout.readline()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def call(self, *words):
        done = subprocess.run(self.client + list(words) + ["--json"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        return json.loads(done.stdout)

    def wait(self, job):
        subprocess.run(self.client + ["watch", job], capture_output=True, check=False)

    def run(self, *case):
        """The most memory of the job's worker, the most bytes in its folder and the size of the result, polled."""
        job = self.call("submit", *case)["name"]
        folder = os.path.join(self.data, job)
        memory = data = 0
        largest = {}
        while True:
            try:
                with open(os.path.join(folder, "worker"), encoding="ascii") as file:
                    status = open(f"/proc/{file.read().split()[0]}/status", encoding="ascii").read()
                fields = {line.split(":")[0]: line.split(":")[1].split() for line in status.splitlines()}
                memory = max(memory, 1024 * int(fields["VmHWM"][0]))
                data = max(data, 1024 * int(fields["VmData"][0]))
            except (OSError, KeyError, IndexError):
                if self.call("show", job)["state"] not in ("PENDING", "RUNNING"):
                    break
            try:
                for entry in os.scandir(folder):
                    largest[entry.name] = max(largest.get(entry.name, 0), entry.stat().st_size)
            except OSError:
                pass
            time.sleep(0.003)
        shown = self.call("show", job)
        if shown["state"] != "SUCCEEDED":
            raise RuntimeError(f"{shown['state']}: {shown.get('cause_message')}")
        result = os.path.getsize(os.path.join(folder, "result.h5"))
        self.call("delete", job)
        checkpoints = [size for name, size in largest.items() if name.startswith("checkpoint")]
        if len(checkpoints) < 2:
            raise RuntimeError("too few checkpoints were written")
        # At one near the end all files are there at once. A short run has the partial one too briefly to be seen.
        others = sum(size for name, size in largest.items() if not name.startswith(("checkpoint", "result")))
        return memory, others + 3 * max(checkpoints) + result, data, result


def measure(daemon, path, lattice, law, size):
    with open(path, "w", encoding="ascii") as file:
        file.write(case_of(lattice, size))
    changes = [change for change in LAWS[law] if lattice in LATTICES or not change.startswith("plates")]
    case = [path] + [word for change in changes for word in ("--set", change)]
    check = daemon.call("check", *case)
    memory, disk, data, result = daemon.run(*case)
    numbers = [int(check["predicted_memory_bytes"]), memory, int(check["predicted_disk_bytes"]), disk, data,
               int(check["predicted_bytes"]), result]
    values = [lattice, law, size, check["element_count"]] + [f"{number / 1e6:.2f}" for number in numbers]
    return dict(zip(COLUMNS, map(str, values)))


class Record:
    """Rows that are measured again replace those of the same key in NAME.csv; evidence.csv has the figures of all."""

    def __init__(self, name, columns, key):
        self.name, self.columns, self.key = name, columns, key

    def replace(self, measured, figures_of):
        path = os.path.join(HERE, self.name + ".csv")
        rows = {}
        if os.path.exists(path):
            with open(path, encoding="ascii", newline="") as file:
                rows = {self.key(row): row for row in csv.DictReader(file)}
        rows.update({self.key(row): row for row in measured})
        kept = [rows[key] for key in sorted(rows)]
        with open(path, "w", encoding="ascii", newline="") as file:
            writer = csv.DictWriter(file, self.columns, lineterminator="\n")
            writer.writeheader()
            writer.writerows(kept)
        path = os.path.join(HERE, "evidence.csv")
        with open(path, encoding="ascii") as file:
            header, *lines = file.read().splitlines()
        lines = [line for line in lines if not line.startswith(self.name + ",")]
        lines += [f"{self.name},{name},{value}" for name, value in figures_of(kept)]
        with open(path, "w", encoding="ascii") as file:
            file.write("\n".join([header] + sorted(lines)) + "\n")


def figures_of(rows):
    """The extremes of each size."""
    for size in sorted({int(row["size"]) for row in rows}):
        of_size = [row for row in rows if int(row["size"]) == size]
        yield f"cases of {size} elements", len(of_size)
        used = [float(row["memory_mb"]) for row in of_size]
        yield f"least MB of {size} elements", f"{min(used):.0f}"
        yield f"most MB of {size} elements", f"{max(used):.0f}"
        for name in ("memory", "disk", "result"):
            ratios = [float(row[name + "_predicted_mb"]) / float(row[name + "_mb"]) for row in of_size]
            yield f"least ratio of {name} of {size} elements", f"{min(ratios):.2f}"
            yield f"most ratio of {name} of {size} elements", f"{max(ratios):.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", metavar="BIN", help="folder of cellcrushd and cellcrush")
    parser.add_argument("--sizes", nargs="+", type=int, choices=SIZES, default=list(SIZES), metavar="ELEMENTS")
    parser.add_argument("--lattices", nargs="+", choices=[*LATTICES, *FRAMES], default=[*LATTICES, *FRAMES])
    parser.add_argument("--laws", nargs="+", choices=LAWS, default=list(LAWS))
    parser.add_argument("--record", action="store_true")
    wanted = parser.parse_args()
    measured = []
    print(",".join(COLUMNS))
    for size in wanted.sizes:
        interval = ["--checkpoint-interval", str(SIZES[size][1])]
        with tempfile.TemporaryDirectory() as folder, Daemon(wanted.programs, folder, *interval) as daemon:
            for lattice, law in itertools.product(wanted.lattices, wanted.laws):
                if lattice in FRAMES and size > LARGEST_FRAME:
                    continue
                row = measure(daemon, os.path.join(folder, "case.txtpb"), lattice, law, size)
                print(",".join(row.values()), flush=True)
                measured.append(row)
    if wanted.record:
        record = Record("forecasts", COLUMNS, key=lambda row: (int(row["size"]), row["lattice"], row["law"]))
        record.replace(measured, figures_of)


if __name__ == "__main__":
    main()
