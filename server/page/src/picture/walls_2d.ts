import type { Camera } from "./camera";
import { cssColour, kShades, wallColour } from "./colours";
import { kSegmentFloats, type Segments } from "./segments";
import { kThinnest, type Walls } from "./walls";

/** Walls as strokes: those of one shade and thickness share a path. */
export class CanvasWalls implements Walls {
  private readonly context: CanvasRenderingContext2D;
  private segments: Segments | undefined;
  private dark = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.context = canvas.getContext("2d")!;
  }

  setSegments(segments: Segments): void {
    this.segments = segments;
  }

  setDark(dark: boolean): void {
    this.dark = dark;
  }

  draw(camera: Camera, ratio: number): void {
    const { context, segments } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    if (!segments) return;
    context.scale(ratio, ratio);
    context.lineCap = "round";
    for (const [key, elements] of this.groups(segments)) {
      const [shade, thickness] = key.split(" ").map(Number);
      context.strokeStyle = cssColour(wallColour(shade / (kShades - 1), this.dark));
      context.lineWidth = Math.max(thickness * camera.scale, kThinnest);
      context.beginPath();
      for (const i of elements) {
        const at = kSegmentFloats * i;
        const { values } = segments;
        context.moveTo(camera.toScreenX(values[at]), camera.toScreenY(values[at + 1]));
        context.lineTo(camera.toScreenX(values[at + 2]), camera.toScreenY(values[at + 3]));
      }
      context.stroke();
    }
  }

  private groups(segments: Segments): Map<string, number[]> {
    const groups = new Map<string, number[]>();
    for (let i = 0; i < segments.count; ++i) {
      const at = kSegmentFloats * i;
      const key = `${Math.round(segments.values[at + 5] * (kShades - 1))} ${segments.values[at + 4]}`;
      const group = groups.get(key);
      if (group) group.push(i);
      else groups.set(key, [i]);
    }
    return groups;
  }

  destroy(): void {
    this.segments = undefined;
  }
}
