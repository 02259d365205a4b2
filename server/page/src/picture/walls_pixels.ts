// Walls drawn pixel by pixel into a Canvas2D. Without a GPU this is faster than WebGL2 and than strokes, by far.
import type { Camera } from "./camera";
import { kShades, rigidColour, wallColour } from "./colours";
import { kRigid, kSegmentFloats, type Segments } from "./segments";
import { kThinnest, type Walls } from "./walls";

/** Where a picture shows a lattice, in its pixels. */
export interface View {
  width: number;
  height: number;
  /** The point at the centre, mm. */
  x: number;
  y: number;
  /** Pixels per millimetre. */
  scale: number;
  /** Least thickness of a wall, pixels. */
  thinnest: number;
}

/** Colours of plastic fractions as 0x00BBGGRR, kShades of them, then that of rigid elements. */
export function shadesOf(dark: boolean): Uint32Array {
  return Uint32Array.from({ length: kShades + 1 }, (_, i) => {
    const [r, g, b] = i < kShades ? wallColour(i / (kShades - 1), dark) : rigidColour(dark);
    return r | (g << 8) | (b << 16);
  });
}

function shadeOf(plastic: number): number {
  return plastic === kRigid ? kShades : (Math.min(Math.max(plastic, 0), 1) * (kShades - 1) + 0.5) | 0;
}

/** Draws segments with round ends over transparent pixels, which are RGBA in the order of their bytes. The parts of a
 *  pixel that walls cover add up; it has the colour of the one that covers most of it. */
export function drawSegments(pixels: Uint32Array, view: View, segments: Segments, shades: Uint32Array): void {
  const { width, height, scale } = view;
  // Centres of pixels have whole numbers.
  const left = 0.5 * width - 0.5 - view.x * scale;
  const top = 0.5 * height - 0.5 + view.y * scale;
  const { values } = segments;
  for (let i = 0, at = 0; i < segments.count; ++i, at += kSegmentFloats) {
    const x0 = left + values[at] * scale;
    const y0 = top - values[at + 1] * scale;
    const x1 = left + values[at + 2] * scale;
    const y1 = top - values[at + 3] * scale;
    drawSegment(pixels, width, height, x0, y0, x1, y1,
                0.5 * Math.max(values[at + 4] * scale, view.thinnest) + 0.5,
                shades[shadeOf(values[at + 5])]);
  }
}

// `reach` is the distance from the middle line at which a pixel is no longer covered.
function drawSegment(pixels: Uint32Array, width: number, height: number, x0: number, y0: number, x1: number,
                     y1: number, reach: number, colour: number): void {
  const dx = x1 - x0;
  const dy = y1 - y0;
  const square = dx * dx + dy * dy;
  if (!Number.isFinite(square)) return;
  const inverse = square > 1e-12 ? 1 / square : 0;
  const perRow = Math.abs(dy) > 1e-6 ? 1 / dy : 0;
  const first = Math.max(0, Math.ceil(Math.min(y0, y1) - reach));
  const last = Math.min(height - 1, Math.floor(Math.max(y0, y1) + reach));
  for (let y = first; y <= last; ++y) {
    // The part of the segment that reaches this row.
    let from = 0;
    let to = 1;
    if (perRow !== 0) {
      const a = (y - reach - y0) * perRow;
      const b = (y + reach - y0) * perRow;
      from = Math.max(0, Math.min(a, b));
      to = Math.min(1, Math.max(a, b));
    }
    const xa = x0 + from * dx;
    const xb = x0 + to * dx;
    const begin = Math.max(0, Math.ceil(Math.min(xa, xb) - reach));
    const end = Math.min(width - 1, Math.floor(Math.max(xa, xb) + reach));
    const wy = y - y0;
    for (let x = begin; x <= end; ++x) {
      const wx = x - x0;
      const along = (wx * dx + wy * dy) * inverse;
      const t = along < 0 ? 0 : along > 1 ? 1 : along;
      const ex = wx - t * dx;
      const ey = wy - t * dy;
      // An end is half a pixel smaller, or the soft edges of two elements would add up to a knot.
      const cover = (along < 0 || along > 1 ? reach - 0.5 : reach) - Math.sqrt(ex * ex + ey * ey);
      if (cover <= 0) continue;
      const pixel = y * width + x;
      const before = pixels[pixel];
      const under = before >>> 24;
      const alpha = cover >= 1 ? 255 : (255 * cover) | 0;
      const both = alpha + under - ((alpha * under + 254) / 255 | 0);
      pixels[pixel] = (alpha >= under ? colour : before & 0xffffff) | (both << 24);
    }
  }
}

export class PixelWalls implements Walls {
  private readonly context: CanvasRenderingContext2D;
  private image: ImageData | undefined;
  private segments: Segments | undefined;
  private shades = shadesOf(false);

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.context = canvas.getContext("2d")!;
  }

  setSegments(segments: Segments): void {
    this.segments = segments;
  }

  setDark(dark: boolean): void {
    this.shades = shadesOf(dark);
  }

  draw(camera: Camera, ratio: number): void {
    const { width, height } = this.canvas;
    if (width === 0 || height === 0) return;
    if (this.image?.width !== width || this.image.height !== height) {
      this.image = this.context.createImageData(width, height);
    }
    const pixels = new Uint32Array(this.image.data.buffer);
    pixels.fill(0);
    const view = { width, height, x: camera.x, y: camera.y, scale: camera.scale * ratio, thinnest: kThinnest * ratio };
    if (this.segments) drawSegments(pixels, view, this.segments, this.shades);
    this.context.putImageData(this.image, 0, 0);
  }

  destroy(): void {
    this.segments = undefined;
    this.image = undefined;
  }
}
