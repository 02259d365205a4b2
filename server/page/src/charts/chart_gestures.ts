// Pointer, wheel and keys on a chart: a drag zooms to its box, the wheel about the pointer, a double click shows all
// again; a click, or a drag of the playhead or of a finger, moves the playhead.
import type uPlot from "uplot";
import { h } from "../dom/element";
import type { Range } from "./chart_view";

export interface ChartGestures {
  /** Shows a part; an undefined range is left as it is. */
  zoom(x: Range | undefined, y: Range | undefined): void;
  isZoomed(): boolean;
  reset(): void;
  /** Pixels of the playhead from the left, if there is one. */
  playhead(): number | undefined;
  scrub?: (x: number) => void;
  click(left: number, top: number): void;
}

const kReach = 9; // pixels about the playhead
const kLeast = 8; // pixels that a drag has at least
const kWheelStep = 0.0016;
const kKeyFactor = 1.4;

export function addChartGestures(plot: uPlot, on: ChartGestures): void {
  const { over } = plot;
  const box = h("div", { class: "zoom-box", hidden: true });
  over.append(box);
  const place = (event: MouseEvent): [number, number] => {
    const { left, top, width, height } = over.getBoundingClientRect();
    return [Math.min(Math.max(event.clientX - left, 0), width), Math.min(Math.max(event.clientY - top, 0), height)];
  };
  // From pixels of the plot; y points down there.
  const xRange = (a: number, b: number): Range =>
    ({ low: plot.posToVal(Math.min(a, b), "x"), high: plot.posToVal(Math.max(a, b), "x") });
  const yRange = (a: number, b: number): Range =>
    ({ low: plot.posToVal(Math.max(a, b), "y"), high: plot.posToVal(Math.min(a, b), "y") });
  const zoomAt = (x: number, y: number, factor: number): void => {
    const { clientWidth: width, clientHeight: height } = over;
    on.zoom(xRange(x - x / factor, x + (width - x) / factor), yRange(y - y / factor, y + (height - y) / factor));
  };
  let start: [number, number] | undefined;
  let isScrubbing = false;
  const seek = (x: number): void => on.scrub?.(plot.posToVal(x, "x"));
  over.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    const at = place(event);
    over.setPointerCapture(event.pointerId);
    const head = on.playhead();
    isScrubbing = on.scrub !== undefined &&
      (event.pointerType === "touch" || (head !== undefined && Math.abs(head - at[0]) < kReach));
    start = at;
    if (isScrubbing) seek(at[0]);
  });
  over.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    if (!start) {
      const head = on.playhead();
      over.classList.toggle("on-playhead", on.scrub !== undefined && head !== undefined && Math.abs(head - x) < kReach);
      return;
    }
    if (isScrubbing) return seek(x);
    const [dx, dy] = [Math.abs(x - start[0]), Math.abs(y - start[1])];
    box.hidden = dx < kLeast && dy < kLeast;
    // A narrow box spans the other axis.
    const [left, width] = dx < kLeast ? [0, over.clientWidth] : [Math.min(x, start[0]), dx];
    const [top, height] = dy < kLeast ? [0, over.clientHeight] : [Math.min(y, start[1]), dy];
    Object.assign(box.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
  });
  over.addEventListener("pointerup", (event) => {
    if (!start) return;
    const [from, [x, y]] = [start, place(event)];
    const [wasScrubbing, isDrag] = [isScrubbing, !box.hidden];
    start = undefined;
    isScrubbing = false;
    box.hidden = true;
    if (wasScrubbing) return;
    if (isDrag) {
      const [dx, dy] = [Math.abs(x - from[0]), Math.abs(y - from[1])];
      return on.zoom(dx < kLeast ? undefined : xRange(from[0], x), dy < kLeast ? undefined : yRange(from[1], y));
    }
    seek(x);
    on.click(x, y);
  });
  over.addEventListener("pointercancel", () => {
    start = undefined;
    box.hidden = true;
  });
  over.addEventListener("dblclick", () => on.reset());
  over.addEventListener("wheel", (event) => {
    if (!on.isZoomed() && event.deltaY > 0) return; // nothing to zoom out of: the page scrolls
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? 18 * event.deltaY : event.deltaY;
    zoomAt(...place(event), Math.exp(-kWheelStep * pixels * (event.ctrlKey ? 4 : 1)));
  }, { passive: false });
  over.tabIndex = 0;
  over.addEventListener("keydown", (event) => {
    const factor = { "+": kKeyFactor, "=": kKeyFactor, "-": 1 / kKeyFactor }[event.key];
    if (factor) zoomAt(0.5 * over.clientWidth, 0.5 * over.clientHeight, factor);
    else if (event.key === "0") on.reset();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
}
