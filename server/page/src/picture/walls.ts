// What draws walls: WebGL2 where the browser has it, otherwise Canvas2D.
import type { Camera } from "./camera";
import type { Segments } from "./segments";
import { CanvasWalls } from "./walls_2d";
import { GlWalls } from "./walls_gl";

export interface Walls {
  /** Takes new positions. */
  setSegments(segments: Segments): void;
  setDark(dark: boolean): void;
  /** Draws over a transparent canvas; `ratio` is device pixels per CSS pixel. */
  draw(camera: Camera, ratio: number): void;
  destroy(): void;
}

/** Thinner walls would vanish, in CSS pixels. */
export const kThinnest = 0.9;

export function createWalls(canvas: HTMLCanvasElement): Walls {
  const gl = canvas.getContext("webgl2", {
    antialias: false, premultipliedAlpha: true, alpha: true,
    failIfMajorPerformanceCaveat: true, // WebGL without a GPU is slower than Canvas2D
  });
  return gl ? new GlWalls(canvas, gl) : new CanvasWalls(canvas);
}
