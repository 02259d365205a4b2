// The mesh of a job as arrays for drawing.
import type { Mesh } from "../../gen/cellcrush/v1/sample_pb";

export interface Box { lowX: number; highX: number; lowY: number; highY: number }

export interface Lattice {
  /** Indices of the particles at the ends of the elements, before any has broken off: start0, end0, ... */
  ends: Uint32Array;
  thickness: Float32Array;
  /** Elements from this one on are rigid. */
  firstRigid: number;
  /** Places in `ends` of the particles where walls overlapped before loading, each once. */
  overlaps: number[];
  undeformed: Float32Array;
  /** Plates across the crush, if any. */
  plates: boolean;
  alongY: boolean;
  length: number;
  impactPlate: number;
  supportPlate: number;
  /** Faces of the side walls across the crush; equal without any. */
  sideLow: number;
  sideHigh: number;
  /** Where gripped particles are: a place in `ends` for each. */
  gripped: number[];
}

// The first place of each particle in the ends of the elements.
function placesOf(particles: number[], ends: number[]): number[] {
  const sought = new Set(particles);
  const places: number[] = [];
  for (let i = 0; i < ends.length && sought.size > 0; ++i) {
    if (sought.delete(ends[i])) places.push(i);
  }
  return places;
}

export function latticeOf(mesh: Mesh): Lattice {
  return {
    ends: Uint32Array.from(mesh.elementNodes),
    thickness: Float32Array.from(mesh.thicknessMm),
    firstRigid: mesh.thicknessMm.length - mesh.rigidElementCount,
    overlaps: placesOf(mesh.overlapParticle, mesh.elementNodes),
    undeformed: Float32Array.from(mesh.positionMm),
    plates: mesh.supportPlateMm > mesh.impactPlateMm,
    alongY: mesh.alongY,
    length: mesh.supportPlateMm - mesh.impactPlateMm,
    impactPlate: mesh.impactPlateMm,
    supportPlate: mesh.supportPlateMm,
    sideLow: mesh.sideLowMm,
    sideHigh: mesh.sideHighMm,
    gripped: placesOf(mesh.gripped, mesh.elementNodes),
  };
}

export function boxOf(position: Float32Array): Box {
  const box = { lowX: Infinity, highX: -Infinity, lowY: Infinity, highY: -Infinity };
  for (let i = 0; i + 1 < position.length; i += 2) {
    const x = position[i];
    const y = position[i + 1];
    if (!Number.isFinite(x + y)) continue;
    if (x < box.lowX) box.lowX = x;
    if (x > box.highX) box.highX = x;
    if (y < box.lowY) box.lowY = y;
    if (y > box.highY) box.highY = y;
  }
  return box;
}

/** The box that shows the whole crush: the lattice before loading with room for its sides to bulge. */
export function viewBox(lattice: Lattice): Box {
  const box = boxOf(lattice.undeformed);
  const width = box.highX - box.lowX;
  const height = box.highY - box.lowY;
  const plate = wallThickness(box);
  const bulge = 0.04 * (lattice.alongY ? width : height);
  const along = lattice.plates ? 1.6 * plate : 0.04 * Math.max(width, height);
  const [dx, dy] = lattice.alongY ? [bulge + plate, along] : [along, bulge + plate];
  return { lowX: box.lowX - dx, highX: box.highX + dx, lowY: box.lowY - dy, highY: box.highY + dy };
}

/** The box of a frame with plates: as above, wider where the walls bulge; along y only up to the impact plate. */
export function frameBox(lattice: Lattice, position: Float32Array, strain: number): Box {
  const box = viewBox(lattice);
  const now = boxOf(position);
  const plate = wallThickness(box);
  if (!lattice.alongY) {
    return { ...box, lowY: Math.min(box.lowY, now.lowY - plate), highY: Math.max(box.highY, now.highY + plate) };
  }
  return { lowX: Math.min(box.lowX, now.lowX - plate), highX: Math.max(box.highX, now.highX + plate),
           lowY: box.lowY + strain * lattice.length, highY: box.highY };
}

/** Of plates and rigid walls across a box, in a picture. */
export function wallThickness(box: Box): number {
  return 0.009 * Math.hypot(box.highX - box.lowX, box.highY - box.lowY);
}
