// Wheel, drag, pinch and keys that move the view of a picture.
import type { Camera } from "./camera";

export interface Gestures {
  /** The camera moved. */
  moved(): void;
  /** The pointer is over the picture without a button, or left it. */
  hover(point: [number, number] | undefined): void;
}

const kWheelStep = 0.0016;

export function addGestures(canvas: HTMLElement, camera: Camera, on: Gestures): void {
  const pointers = new Map<number, [number, number]>();
  const place = (event: MouseEvent): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const moved = (): void => {
    // A finger scrolls the page while the whole crush is in view, and moves the picture otherwise.
    canvas.style.touchAction = camera.zoom > 1 ? "none" : "pan-y";
    on.moved();
  };
  canvas.style.touchAction = "pan-y";
  canvas.addEventListener("wheel", (event) => {
    if (camera.zoom === 1 && event.deltaY > 0) return; // nothing to zoom out of: the page scrolls
    event.preventDefault();
    const pixels = event.deltaMode === 1 ? 18 * event.deltaY : event.deltaY;
    camera.zoomAt(...place(event), Math.exp(-kWheelStep * pixels * (event.ctrlKey ? 4 : 1)));
    moved();
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType !== "touch") on.hover(now);
      return;
    }
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const distance = (a: [number, number]): number => Math.hypot(a[0] - other[0], a[1] - other[1]);
      camera.zoomAt(0.5 * (now[0] + other[0]), 0.5 * (now[1] + other[1]), distance(now) / (distance(before) || 1));
      moved();
    } else if (camera.zoom > 1) {
      camera.pan(now[0] - before[0], now[1] - before[1]);
      moved();
    }
    pointers.set(event.pointerId, now);
  });
  const release = (event: PointerEvent): void => {
    if (event.pointerType === "touch" && pointers.size === 1) on.hover(place(event)); // a tap shows the wall's numbers
    pointers.delete(event.pointerId);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("pointerleave", (event) => {
    if (event.pointerType !== "touch") on.hover(undefined);
  });
  canvas.addEventListener("dblclick", (event) => {
    if (camera.zoom > 1) camera.fit();
    else camera.zoomAt(...place(event), 4);
    moved();
  });
}
