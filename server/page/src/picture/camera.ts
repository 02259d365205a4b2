// From millimetres of the lattice to pixels of the canvas; y points up in the lattice and down on the canvas.
import type { Box } from "../frames/lattice";

const kMostZoom = 400;

export class Camera {
  /** CSS pixels per millimetre with the whole box in view. */
  private fitScale = 1;
  zoom = 1;
  /** Centre of the view in mm. */
  x = 0;
  y = 0;
  width = 1;
  height = 1;
  private box: Box = { lowX: 0, highX: 1, lowY: 0, highY: 1 };
  /** Whether the box stands at the top where it is lower than the canvas. */
  private atTop = false;
  private isSized = false;

  get scale(): number {
    return this.fitScale * this.zoom;
  }

  setSize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    this.rescale();
  }

  /** Sets what `fit` shows; a view that was zoomed in stays. */
  setBox(box: Box, atTop = false): void {
    Object.assign(this, { box, atTop });
    if (this.zoom === 1 || !this.isSized) this.rescale();
    this.isSized = true;
  }

  private rescale(): void {
    const { box } = this;
    const fits = Math.min(this.width / (box.highX - box.lowX), this.height / (box.highY - box.lowY));
    this.fitScale = Math.max(fits, 1e-12);
    if (this.zoom === 1) this.centre();
  }

  fit(): void {
    this.zoom = 1;
    this.rescale();
  }

  private centre(): void {
    this.x = 0.5 * (this.box.lowX + this.box.highX);
    const { lowY, highY } = this.box;
    this.y = this.atTop ? highY - 0.5 * this.height / this.scale : 0.5 * (lowY + highY);
  }

  toScreenX(x: number): number {
    return 0.5 * this.width + (x - this.x) * this.scale;
  }

  toScreenY(y: number): number {
    return 0.5 * this.height - (y - this.y) * this.scale;
  }

  toWorld(sx: number, sy: number): [number, number] {
    return [this.x + (sx - 0.5 * this.width) / this.scale, this.y - (sy - 0.5 * this.height) / this.scale];
  }

  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** Zooms so that the point under the pointer stays. */
  zoomAt(sx: number, sy: number, factor: number): void {
    const [x, y] = this.toWorld(sx, sy);
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), kMostZoom);
    if (this.zoom === 1) return this.rescale();
    this.x = x - (sx - 0.5 * this.width) / this.scale;
    this.y = y + (sy - 0.5 * this.height) / this.scale;
  }

  /** For the URL: "zoom,x,y", or empty when the whole crush is in view. */
  get text(): string {
    if (this.zoom === 1) return "";
    return [this.zoom.toFixed(2), this.x.toPrecision(5), this.y.toPrecision(5)].map(Number).join(",");
  }

  set text(text: string) {
    const [zoom, x, y] = text.split(",").map(Number);
    if (!(zoom > 1 && zoom <= kMostZoom && Number.isFinite(x + y))) return;
    Object.assign(this, { zoom, x, y });
  }
}
