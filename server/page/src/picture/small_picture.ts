// A small picture of a lattice and its plates, without gestures. It draws pixel by pixel, as browsers limit the
// number of WebGL contexts.
import { frameBox, viewBox, type Lattice } from "../frames/lattice";
import type { Fields } from "../frames/packed";
import { h } from "../dom/element";
import { Camera } from "./camera";
import { isDark, onThemeChange } from "../dom/preferences";
import { drawFaces, platesOf } from "./rigid_walls";
import { fillSegments } from "./segments";
import { PixelWalls } from "./walls_pixels";

export class SmallPicture {
  readonly element: HTMLCanvasElement;
  private readonly camera = new Camera();
  private readonly walls: PixelWalls;
  private readonly observer = new ResizeObserver(() => this.draw());
  private readonly ignoreTheme = onThemeChange(() => this.draw());
  private shown: { lattice: Lattice; fields: Fields; strain: number } | undefined;

  constructor(label: string) {
    this.element = h("canvas", { role: "img", "aria-label": label });
    this.walls = new PixelWalls(this.element);
    this.observer.observe(this.element);
  }

  show(lattice: Lattice, fields: Fields, strain: number): void {
    this.shown = { lattice, fields, strain };
    this.walls.setSegments(fillSegments(lattice, fields, undefined));
    this.draw();
  }

  private draw(): void {
    const { element, camera, shown } = this;
    const { clientWidth, clientHeight } = element;
    if (!clientWidth || !clientHeight || !shown) return;
    const ratio = devicePixelRatio;
    element.width = Math.round(clientWidth * ratio);
    element.height = Math.round(clientHeight * ratio);
    const { lattice, fields, strain } = shown;
    const box = lattice.plates ? frameBox(lattice, fields.position, strain) : viewBox(lattice);
    camera.setSize(clientWidth, clientHeight);
    camera.setBox(box);
    this.walls.setDark(isDark());
    this.walls.draw(camera, ratio);
    const context = element.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawFaces(context, camera, platesOf(lattice, strain), box);
  }

  destroy(): void {
    this.observer.disconnect();
    this.ignoreTheme();
    this.walls.destroy();
  }
}
