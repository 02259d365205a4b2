import { h } from "../dom/element";
import { colourTable, isDark, kShades } from "./colours";

/** The colour map with its ends, which follows the theme. */
export function colourLegend(): HTMLElement {
  const canvas = h("canvas", { width: kShades, height: 1, class: "map", "aria-hidden": "true" });
  const paint = (): void => {
    const context = canvas.getContext("2d")!;
    context.putImageData(new ImageData(new Uint8ClampedArray(colourTable(isDark())), kShades, 1), 0, 0);
  };
  paint();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);
  return h("div", { class: "colour-legend", title: "Fraction of a wall's section that has yielded" },
    h("span", {}, "plastic fraction"), h("span", {}, "0"), canvas, h("span", {}, "1"));
}
