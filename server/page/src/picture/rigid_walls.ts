// Plates and the rigid walls of a case: where their faces are, and their drawing.
import { Loading_Grip_Edge as Edge, type Case, type Frame_RigidWall } from "../../gen/cellcrush/v1/case_pb";
import type { Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";
import { indexBefore } from "../charts/curves";
import { wallThickness, type Box, type Lattice } from "../frames/lattice";
import type { Camera } from "./camera";
import { themeColour } from "./colours";

/** A point of the face in mm, and the unit normal out of the wall. */
export interface Face {
  x: number; y: number; normalX: number; normalY: number;
  /** The point is counted from the outermost surface of the lattice, where the wall touches it before loading. */
  atEdge?: boolean;
}

const kNormals: Partial<Record<Edge, [number, number]>> = {
  [Edge.LEFT]: [1, 0], [Edge.RIGHT]: [-1, 0], [Edge.BOTTOM]: [0, 1], [Edge.TOP]: [0, -1],
};

function faceOf(wall: Frame_RigidWall): Face {
  const normal = kNormals[wall.edge];
  if (normal) return { x: 0, y: 0, normalX: normal[0], normalY: normal[1], atEdge: true };
  const [x, y] = [wall.normalX ?? 0, wall.normalY ?? 0];
  const length = Math.hypot(x, y) || 1;
  return { x: wall.xMm ?? 0, y: wall.yMm ?? 0, normalX: x / length, normalY: y / length };
}

/** The face where it is in the picture of a lattice. */
export function placedFace(face: Face, { undeformed, ends, thickness }: Lattice): Face {
  if (!face.atEdge) return face;
  let outermost = Infinity;
  ends.forEach((particle, i) => {
    const place = undeformed[2 * particle] * face.normalX + undeformed[2 * particle + 1] * face.normalY;
    outermost = Math.min(outermost, place - 0.5 * thickness[i >> 1]);
  });
  return { ...face, x: face.x + outermost * face.normalX, y: face.y + outermost * face.normalY };
}

/** The faces of the plates at a strain and of the side walls, where there are any. */
export function platesOf(lattice: Lattice, strain: number): Face[] {
  const { plates, alongY, impactPlate, supportPlate, length, sideLow, sideHigh } = lattice;
  const face = (at: number, out: number, onY: boolean): Face => {
    const [x, y] = onY ? [0, 1] : [1, 0];
    return { x: at * x, y: at * y, normalX: out * x, normalY: out * y };
  };
  return [
    ...plates ? [face(impactPlate + strain * length, 1, alongY), face(supportPlate, -1, alongY)] : [],
    ...sideHigh > sideLow ? [face(sideLow, 1, !alongY), face(sideHigh, -1, !alongY)] : [],
  ];
}

/** The faces at the start, of the rigid walls of the loading or of the lattice. */
export function facesOf(submitted: Case | undefined): Face[] {
  const lattice = submitted?.lattice?.kind.value;
  const ofLattice = lattice && "rigidWalls" in lattice ? lattice.rigidWalls : [];
  return [...ofLattice, ...submitted?.loading?.rigidWalls ?? []].map(faceOf);
}

/** The rigid walls of a job, moved by the displacements of its samples. */
export class RigidWalls {
  constructor(private readonly data: { job: Job | undefined; samples: Sample[] }) {}

  /** The faces at a time in s; empty without rigid walls. */
  at(time: number): Face[] {
    const faces = facesOf(this.data.job?.case);
    const { samples } = this.data;
    if (faces.length === 0 || samples.length === 0) return faces;
    const before = indexBefore(samples, time, (sample) => sample.timeS);
    const after = Math.min(before + 1, samples.length - 1);
    const span = samples[after].timeS - samples[before].timeS;
    const mix = span > 0 ? Math.min(Math.max((time - samples[before].timeS) / span, 0), 1) : 0;
    return faces.map((face, i) => {
      const low = time < samples[0].timeS ? 0 : samples[before].rigidWalls[i]?.displacementMm ?? 0;
      const high = samples[after].rigidWalls[i]?.displacementMm ?? low;
      const moved = low + mix * (high - low);
      return { ...face, x: face.x + moved * face.normalX, y: face.y + moved * face.normalY };
    });
  }
}

/** Draws bands behind the faces, across the box. */
export function drawFaces(context: CanvasRenderingContext2D, camera: Camera, faces: Face[], box: Box): void {
  const [width, height] = [box.highX - box.lowX, box.highY - box.lowY];
  const [middleX, middleY] = [0.5 * (box.lowX + box.highX), 0.5 * (box.lowY + box.highY)];
  const depth = Math.max(wallThickness(box), 3 / camera.scale);
  context.fillStyle = themeColour("plate");
  for (const { x, y, normalX, normalY } of faces) {
    const [alongX, alongY] = [-normalY, normalX];
    const half = 0.5 * (Math.abs(alongX) * width + Math.abs(alongY) * height);
    const place = (middleX - x) * alongX + (middleY - y) * alongY;
    const corners = [[-half, 0], [half, 0], [half, depth], [-half, depth]].map(([along, behind]) => [
      camera.toScreenX(x + (place + along) * alongX - behind * normalX),
      camera.toScreenY(y + (place + along) * alongY - behind * normalY)]);
    context.fill(new Path2D(`M${corners.join("L")}Z`));
  }
}
