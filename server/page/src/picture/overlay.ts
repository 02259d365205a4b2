// What is drawn over the walls: plates, side walls and grips, the place where the impact plate started, rings where
// walls overlapped before loading, diamonds where walls have broken, a scale bar, the wall under the pointer.
import type { Box, Lattice } from "../frames/lattice";
import type { LatticeMarks } from "../../gen/cellcrush/v1/cases_service_pb";
import type { Camera } from "./camera";
import { themeColour } from "./colours";
import { drawMarks } from "./marks";
import { drawFaces, platesOf, type Face } from "./rigid_walls";
import { kSegmentFloats, placeOfEnd, type Segments } from "./segments";

export interface OverlayState {
  lattice: Lattice;
  /** What the view shows as a whole: plates reach across it. */
  box: Box;
  strain: number;
  segments: Segments | undefined;
  /** Places in the lattice's ends of those that have broken off. */
  broken: number[];
  /** Of rigid walls. */
  faces: Face[];
  marks: LatticeMarks[];
  hovered: number;
}

// Between two points of the lattice.
function line(context: CanvasRenderingContext2D, camera: Camera, x0: number, y0: number, x1: number, y1: number): void {
  const [a, b] = [`${camera.toScreenX(x0)},${camera.toScreenY(y0)}`, `${camera.toScreenX(x1)},${camera.toScreenY(y1)}`];
  context.stroke(new Path2D(`M${a}L${b}`));
}

function startLine(context: CanvasRenderingContext2D, camera: Camera, { lattice, box }: OverlayState): void {
  const at = lattice.impactPlate;
  const [x0, y0, x1, y1] = lattice.alongY ? [box.lowX, at, box.highX, at] : [at, box.lowY, at, box.highY];
  context.setLineDash([4, 4]);
  line(context, camera, x0, y0, x1, y1);
  context.setLineDash([]);
}

// The greatest of 1, 2, 5 times a power of ten that is shorter than a quarter of the view.
function scaleBar(context: CanvasRenderingContext2D, camera: Camera): void {
  const longest = Math.min(0.22 * camera.width, 160) / camera.scale;
  const power = 10 ** Math.floor(Math.log10(longest));
  const length = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
  const x1 = camera.width - 14;
  const x0 = x1 - length * camera.scale;
  const y = camera.height - 14;
  const text = `${Number(length.toPrecision(1))} mm`;
  const ink = context.fillStyle;
  context.globalAlpha = 0.8;
  context.fillStyle = themeColour("canvas");
  const left = x0 - context.measureText(text).width - 14;
  context.fillRect(left, y - 11, x1 - left + 8, 22);
  context.globalAlpha = 1;
  context.fillStyle = ink;
  context.stroke(new Path2D(`M${x0},${y - 4}v8m0,-4H${x1}m0,-4v8`));
  context.textAlign = "right";
  context.fillText(text, x0 - 7, y + 4);
  context.textAlign = "left";
}

// x and y of an end, by its place in the lattice's ends.
function endAt(camera: Camera, { values }: Segments, place: number): [number, number] {
  const at = placeOfEnd(place);
  return [camera.toScreenX(values[at]), camera.toScreenY(values[at + 1])];
}

// Of a mark at an end; it shows however thin the wall is.
function radiusAt(camera: Camera, lattice: Lattice, place: number): number {
  return Math.max(lattice.thickness[place >> 1] * camera.scale, 3);
}

// Rings where walls overlapped before loading.
function startOverlaps(context: CanvasRenderingContext2D, camera: Camera, lattice: Lattice, segments: Segments): void {
  context.lineWidth = 1;
  context.strokeStyle = themeColour("accent");
  for (const place of lattice.overlaps) {
    const ring = new Path2D();
    ring.arc(...endAt(camera, segments, place), radiusAt(camera, lattice, place), 0, 2 * Math.PI);
    context.stroke(ring);
  }
}

// Diamonds where walls have broken.
function brokenEnds(context: CanvasRenderingContext2D, camera: Camera, lattice: Lattice, segments: Segments,
                    broken: number[]): void {
  const diamonds = new Path2D();
  for (const place of broken) {
    const [x, y] = endAt(camera, segments, place);
    const radius = 1.5 * radiusAt(camera, lattice, place); // so that it is as large as a ring
    diamonds.moveTo(x, y - radius);
    diamonds.lineTo(x + radius, y);
    diamonds.lineTo(x, y + radius);
    diamonds.lineTo(x - radius, y);
    diamonds.closePath();
  }
  context.lineWidth = 1;
  context.strokeStyle = themeColour("accent");
  context.stroke(diamonds);
}

// A square on each point that a grip holds.
function grips(context: CanvasRenderingContext2D, camera: Camera, lattice: Lattice, segments: Segments): void {
  const half = Math.max(0.5 * lattice.thickness[0] * camera.scale, 2);
  context.fillStyle = themeColour("plate");
  for (const place of lattice.gripped) {
    const [x, y] = endAt(camera, segments, place);
    context.fillRect(x - half, y - half, 2 * half, 2 * half);
  }
}

function hoveredWall(context: CanvasRenderingContext2D, camera: Camera, segments: Segments, element: number): void {
  const at = kSegmentFloats * element;
  const { values } = segments;
  context.lineCap = "round";
  context.lineWidth = Math.max(values[at + 4] * camera.scale, 1) + 3;
  context.globalAlpha = 0.75;
  context.strokeStyle = themeColour("accent");
  line(context, camera, values[at], values[at + 1], values[at + 2], values[at + 3]);
  context.globalAlpha = 1;
}

export function drawOverlay(context: CanvasRenderingContext2D, camera: Camera, state: OverlayState): void {
  const { lattice } = state;
  if (lattice.plates) {
    context.strokeStyle = themeColour("line-strong");
    context.lineWidth = 1;
    if (state.strain > 0.005) startLine(context, camera, state);
  }
  if (state.segments) startOverlaps(context, camera, lattice, state.segments);
  if (state.segments) brokenEnds(context, camera, lattice, state.segments, state.broken);
  drawFaces(context, camera, [...platesOf(lattice, state.strain), ...state.faces], state.box);
  drawMarks(context, camera, state.marks);
  if (state.segments) grips(context, camera, lattice, state.segments);
  context.strokeStyle = context.fillStyle = themeColour("ink-2");
  context.lineWidth = 1.5;
  context.font = `12px ${themeColour("font")}`;
  scaleBar(context, camera);
  if (state.hovered >= 0 && state.segments) hoveredWall(context, camera, state.segments, state.hovered);
}
