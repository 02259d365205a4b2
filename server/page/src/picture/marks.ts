// Places of a lattice that may be faults: rings over the walls, and what they mean.
import { LatticeMarks_Kind, type LatticeMarks } from "../../gen/cellcrush/v1/cases_service_pb";
import { h } from "../dom/element";
import type { Camera } from "./camera";

const kRadius = 6; // pixels
const kIslandRadius = 10; // round the loose end that is often there

// Readable beside each other with any colour vision, as in the pictures of the command line.
const kColours: Record<number, string> = {
  [LatticeMarks_Kind.LOOSE_END]: "#e69e00",
  [LatticeMarks_Kind.ISLAND]: "#57b5e8",
  [LatticeMarks_Kind.DUPLICATE]: "#cc78a6",
  [LatticeMarks_Kind.COVERED]: "#8c5729",
  [LatticeMarks_Kind.CROSSING]: "#0073b3",
  [LatticeMarks_Kind.OVERLAP]: "#d61a1c",
  [LatticeMarks_Kind.SLOWEST_WALL]: "#009e73",
  [LatticeMarks_Kind.RIGID_LINK]: "#734db3",
  [LatticeMarks_Kind.BOND]: "#666",
};

const colourOf = ({ kind }: LatticeMarks): string => kColours[kind] ?? "#000";

export function drawMarks(context: CanvasRenderingContext2D, camera: Camera, marks: LatticeMarks[]): void {
  for (const of of marks) {
    for (let i = 0; i + 1 < of.placesMm.length; i += 2) {
      const [x, y] = [camera.toScreenX(of.placesMm[i]), camera.toScreenY(of.placesMm[i + 1])];
      const ring = new Path2D();
      ring.arc(x, y, of.kind === LatticeMarks_Kind.ISLAND ? kIslandRadius : kRadius, 0, 2 * Math.PI);
      for (const [colour, width] of [["#fff", 4], [colourOf(of), 2]] as const) {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.stroke(ring);
      }
    }
  }
}

export function legendOf(marks: LatticeMarks[]): HTMLElement[] {
  return marks.map((of) => {
    const ring = h("span", { class: "ring" });
    ring.style.borderColor = colourOf(of);
    return h("li", {}, ring, of.words);
  });
}
