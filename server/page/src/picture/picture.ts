// The drawing of a lattice: walls on one canvas, plates and marks on another over it.
import { boxOf, frameBox, viewBox, type Box, type Lattice } from "../frames/lattice";
import type { Fields } from "../frames/packed";
import type { LatticeMarks } from "../../gen/cellcrush/v1/cases_service_pb";
import { Later, Listeners } from "../dom/calls";
import { h, replaceChildren, setText } from "../dom/element";
import { number, percent } from "../dom/format";
import { Camera } from "./camera";
import { themeColour } from "./colours";
import { isDark, onThemeChange } from "../dom/preferences";
import { addGestures } from "./gestures";
import { drawOverlay } from "./overlay";
import { placedFace, type Face } from "./rigid_walls";
import { fillSegments, findNearest, kRigid, kSegmentFloats, type Segments } from "./segments";
import { createWalls, type Walls } from "./walls";

const kScaleRoom = 40; // pixels
const kRestMs = 500;
const kReach = 14; // pixels from the pointer within which a wall is found

export class Picture {
  readonly camera = new Camera();
  readonly moved = new Listeners<void>();
  readonly element: HTMLElement;
  private readonly wallCanvas = h("canvas", { "aria-hidden": "true" });
  private readonly topCanvas = h("canvas", { tabindex: 0, role: "img" });
  private readonly tip = h("div", { class: "tip", hidden: true });
  private readonly noted = h("div", { class: "noted" });
  // Height over width that the frame needs, and that the element is limited to.
  private needed = 0;
  private limit = 0;
  private readonly shrinking = new Later(() => this.limitHeight(this.needed), kRestMs);
  private readonly walls: Walls;
  private readonly observer = new ResizeObserver(() => this.resize());
  private readonly ignoreTheme: () => void;
  private lattice: Lattice | undefined;
  private box: Box | undefined;
  private segments: Segments | undefined;
  private broken: number[] = [];
  private strain = 0;
  private faces: Face[] = [];
  private marks: LatticeMarks[] = [];
  private hovered = -1;
  private scheduled = 0;

  constructor(label: string) {
    this.element = h("div", { class: "picture" }, this.wallCanvas, this.topCanvas, this.noted, this.tip);
    this.topCanvas.setAttribute("aria-label", label);
    this.walls = createWalls(this.wallCanvas);
    this.walls.setDark(isDark());
    this.ignoreTheme = onThemeChange(() => {
      this.walls.setDark(isDark());
      this.drawSoon();
    });
    addGestures(this.topCanvas, this.camera, {
      moved: () => this.move(),
      hover: (point) => this.hover(point),
    });
    this.observer.observe(this.element);
  }

  setLattice(lattice: Lattice): void {
    if (this.lattice === lattice) return;
    this.lattice = lattice;
    this.box = viewBox(lattice);
    this.needed = 0;
    this.camera.setBox(this.box, lattice.plates);
    this.segments = undefined;
    this.drawSoon();
  }

  // Fits the view to a frame between plates. The element grows at once and shrinks when the picture rests.
  private fitTo(lattice: Lattice, position: Float32Array, strain: number): void {
    const box = this.box = frameBox(lattice, position, strain);
    this.camera.setBox(box, true);
    const needed = (box.highY - box.lowY) / (box.highX - box.lowX);
    this.shrinking.stop();
    if (needed > this.limit || this.needed === 0) this.limitHeight(needed);
    else if (needed < this.limit) this.shrinking.afresh();
    this.needed = needed;
  }

  // No higher than a box of this height over width needs, with room for the scale.
  private limitHeight(needed: number): void {
    this.limit = needed;
    this.element.style.maxHeight = `calc(${(100 * needed).toFixed(2)}cqw + ${kScaleRoom}px)`;
  }

  /** Widens what `fit` shows, for a frame of beams that moves beyond its undeformed box. */
  include(position: Float32Array): void {
    const { box } = this;
    if (!box) return;
    const more = boxOf(position);
    const margin = 0.03 * Math.max(more.highX - more.lowX, more.highY - more.lowY);
    this.box = {
      lowX: Math.min(box.lowX, more.lowX - margin), highX: Math.max(box.highX, more.highX + margin),
      lowY: Math.min(box.lowY, more.lowY - margin), highY: Math.max(box.highY, more.highY + margin),
    };
    this.camera.setBox(this.box);
    this.drawSoon();
  }

  /** `faces` are those of rigid walls. */
  show(fields: Fields, strain: number, faces: Face[] = []): void {
    const { lattice } = this;
    if (!lattice) return;
    this.faces = faces.map((face) => placedFace(face, lattice));
    if (lattice.plates) this.fitTo(lattice, fields.position, strain);
    this.segments = fillSegments(lattice, fields, this.segments);
    this.walls.setSegments(this.segments);
    this.broken = fields.broken;
    this.strain = strain;
    this.drawSoon();
  }

  showUndeformed(faces: Face[], marks: LatticeMarks[] = []): void {
    const { lattice } = this;
    if (!lattice) return;
    this.marks = marks;
    const plastic = new Float32Array(lattice.thickness.length);
    this.show({ position: lattice.undeformed, plastic, broken: [] }, 0, faces);
  }

  /** A line of text over the picture. */
  note(text: string): void {
    setText(this.noted, text);
  }

  fit(): void {
    this.camera.fit();
    this.move();
  }

  zoomBy(factor: number): void {
    this.camera.zoomAt(0.5 * this.camera.width, 0.5 * this.camera.height, factor);
    this.move();
  }

  private move(): void {
    this.moved.tell();
    this.drawSoon();
  }

  private resize(): void {
    const ratio = devicePixelRatio;
    const { clientWidth, clientHeight } = this.element;
    if (!clientWidth || !clientHeight) return;
    for (const canvas of [this.wallCanvas, this.topCanvas]) {
      canvas.width = Math.round(clientWidth * ratio);
      canvas.height = Math.round(clientHeight * ratio);
    }
    this.camera.setSize(clientWidth, clientHeight);
    this.draw(); // at once, as a new size clears the canvas
  }

  private drawSoon(): void {
    if (!this.scheduled) this.scheduled = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    cancelAnimationFrame(this.scheduled);
    this.scheduled = 0;
    this.drawAt(this.camera, devicePixelRatio, this.hovered);
  }

  private drawAt(camera: Camera, ratio: number, hovered: number): void {
    this.walls.draw(camera, ratio);
    const context = this.topCanvas.getContext("2d")!;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.topCanvas.width, this.topCanvas.height);
    context.scale(ratio, ratio);
    const { lattice, box, strain, segments, broken, faces, marks } = this;
    if (lattice && box) drawOverlay(context, camera, { lattice, box, strain, segments, broken, faces, marks, hovered });
  }

  /** Draws the picture as it is, with its background, into the corner of a context; both in the given size. */
  paint(context: CanvasRenderingContext2D, x: number, y: number, width: number, height: number): void {
    const camera = Object.assign(new Camera(), this.camera);
    camera.setSize(this.camera.width, this.camera.height);
    const ratio = width / camera.width;
    const size: [number, number] = [this.wallCanvas.width, this.wallCanvas.height];
    for (const canvas of [this.wallCanvas, this.topCanvas]) {
      canvas.width = Math.round(width);
      canvas.height = Math.round(height);
    }
    this.drawAt(camera, ratio, -1);
    context.fillStyle = themeColour("canvas");
    context.fillRect(x, y, width, height);
    context.drawImage(this.wallCanvas, x, y);
    context.drawImage(this.topCanvas, x, y);
    for (const canvas of [this.wallCanvas, this.topCanvas]) [canvas.width, canvas.height] = size;
    this.draw();
  }

  private hover(point: [number, number] | undefined): void {
    const { segments, camera } = this;
    let found = -1;
    if (point && segments) found = findNearest(segments, ...camera.toWorld(...point), kReach / camera.scale);
    if (found !== this.hovered) {
      this.hovered = found;
      this.drawSoon();
    }
    this.tip.hidden = found < 0;
    if (found >= 0 && point) this.showTip(found, point);
  }

  private showTip(element: number, [x, y]: [number, number]): void {
    const { lattice, segments } = this;
    if (!lattice || !segments) return;
    const at = kSegmentFloats * element;
    const [x0, y0, x1, y1, thickness, plastic] = segments.values.subarray(at, at + kSegmentFloats);
    const [a, b] = [2 * lattice.ends[2 * element], 2 * lattice.ends[2 * element + 1]];
    const before = Math.hypot(lattice.undeformed[b] - lattice.undeformed[a],
                              lattice.undeformed[b + 1] - lattice.undeformed[a + 1]);
    const row = (label: string, value: string): HTMLElement =>
      h("div", {}, h("span", {}, label), h("b", {}, value));
    replaceChildren(this.tip, h("div", {}, `wall element ${element}`),
      row("plastic fraction", plastic === kRigid ? "rigid" : plastic.toFixed(2)),
      row("thickness", `${number(thickness)} mm`),
      row("length", `${number(Math.hypot(x1 - x0, y1 - y0))} mm`),
      row("of undeformed", percent(Math.hypot(x1 - x0, y1 - y0) / before, 3)),
      row("middle", `${number(0.5 * (x0 + x1))}, ${number(0.5 * (y0 + y1))} mm`));
    this.tip.hidden = false;
    const { offsetWidth, offsetHeight } = this.tip;
    const left = x + offsetWidth + 20 > this.camera.width ? x - offsetWidth - 10 : x + 16;
    const top = Math.min(y + 14, Math.max(0, this.camera.height - offsetHeight - 4));
    this.tip.style.transform = `translate(${Math.max(0, left)}px, ${top}px)`;
  }

  destroy(): void {
    this.ignoreTheme();
    this.shrinking.stop();
    this.observer.disconnect();
    cancelAnimationFrame(this.scheduled);
    this.walls.destroy();
  }
}
