// The walls of a frame as segments for drawing.
import type { Lattice } from "../frames/lattice";
import type { Fields } from "../frames/packed";

export interface Segments {
  count: number;
  /** Of each element: x0, y0, x1, y1 in mm, thickness in mm, plastic fraction, or kRigid. */
  values: Float32Array;
}

export const kSegmentFloats = 6;
/** In place of the plastic fraction of a rigid element. */
export const kRigid = -1;

/** Where the values of segments have the position of an end, by its place in Lattice.ends. */
export const placeOfEnd = (place: number): number => kSegmentFloats * (place >> 1) + 2 * (place & 1);

/** Fields between two frames. Only pictures that move use it. An end that breaks off between them comes from its
 *  particle of the mesh; `ends` are those of the lattice. */
export function mixFields(a: Fields, b: Fields, mix: number, ends: Uint32Array, into: Fields | undefined): Fields {
  const fits = into && into.position.length === b.position.length;
  const out = fits ? into : { position: b.position.slice(), plastic: b.plastic.slice(), broken: b.broken };
  out.broken = b.broken;
  for (const key of ["position", "plastic"] as const) {
    const [to, from, until] = [out[key], a[key], b[key]];
    const count = Math.min(from.length, until.length);
    for (let i = 0; i < count; ++i) to[i] = from[i] + mix * (until[i] - from[i]);
  }
  const particles = b.position.length / 2 - b.broken.length;
  for (let k = a.broken.length; k < b.broken.length; ++k) {
    const [to, from] = [2 * (particles + k), 2 * ends[b.broken[k]]];
    for (const axis of [0, 1]) {
      const start = a.position[from + axis];
      out.position[to + axis] = start + mix * (b.position[to + axis] - start);
    }
  }
  return out;
}

export function fillSegments(lattice: Lattice, fields: Fields, old: Segments | undefined): Segments {
  const count = lattice.thickness.length;
  const values = old?.count === count ? old.values : new Float32Array(kSegmentFloats * count);
  const { ends, thickness, firstRigid } = lattice;
  const { position, plastic, broken } = fields;
  for (let i = 0, at = 0; i < count; ++i) {
    const a = 2 * ends[2 * i];
    const b = 2 * ends[2 * i + 1];
    values[at++] = position[a];
    values[at++] = position[a + 1];
    values[at++] = position[b];
    values[at++] = position[b + 1];
    values[at++] = thickness[i];
    values[at++] = i < firstRigid ? plastic[i] ?? 0 : kRigid;
  }
  let own = position.length - 2 * broken.length; // place of the position of a broken end
  for (const place of broken) {
    const at = placeOfEnd(place);
    values[at] = position[own++];
    values[at + 1] = position[own++];
  }
  return { count, values };
}

/** The element nearest to a point within a distance, or -1. */
export function findNearest(segments: Segments, x: number, y: number, within: number): number {
  let nearest = -1;
  let least = within * within;
  const { values } = segments;
  for (let i = 0, at = 0; i < segments.count; ++i, at += kSegmentFloats) {
    const x0 = values[at];
    const y0 = values[at + 1];
    const dx = values[at + 2] - x0;
    const dy = values[at + 3] - y0;
    const along = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1);
    const t = along < 0 ? 0 : along > 1 ? 1 : along;
    const ex = x - x0 - t * dx;
    const ey = y - y0 - t * dy;
    const square = ex * ex + ey * ey;
    if (square < least) {
      least = square;
      nearest = i;
    }
  }
  return nearest;
}
