// What draws walls: WebGL2 where a GPU draws it, otherwise pixel by pixel into a Canvas2D.
import type { Camera } from "./camera";
import type { Segments } from "./segments";
import { GlWalls } from "./walls_gl";
import { PixelWalls } from "./walls_pixels";

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

const kSoftware = /swiftshader|llvmpipe|software|basic render/i;

let isFast: boolean | undefined;

// Asked of a canvas of its own: a canvas that has had one kind of context has no other.
function hasFastGl(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  if (!gl) return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !kSoftware.test(renderer);
}

export function createWalls(canvas: HTMLCanvasElement): Walls {
  isFast ??= hasFastGl();
  const gl = isFast && canvas.getContext("webgl2", { antialias: false, premultipliedAlpha: true, alpha: true });
  return gl ? new GlWalls(canvas, gl) : new PixelWalls(canvas);
}
