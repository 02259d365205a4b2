// The colour of a wall by its plastic fraction: plasma, which readers with colour-blindness can order, cut to the part
// that contrasts with the background. The pictures of the command line use the same map.
import { h } from "../dom/element";
import { isDark, onThemeChange } from "../dom/preferences";

type Rgb = [number, number, number];

// plasma at 0, 1/8, ..., 1
const kPlasma: Rgb[] = [[13, 8, 135], [84, 2, 163], [139, 10, 165], [185, 50, 137], [219, 92, 104], [244, 136, 73],
                        [254, 188, 43], [244, 228, 37], [240, 249, 33]];

function plasma(at: number): Rgb {
  const place = Math.min(Math.max(at, 0), 1) * (kPlasma.length - 1);
  const low = Math.min(Math.floor(place), kPlasma.length - 2);
  const mix = place - low;
  return kPlasma[low].map((value, i) => value + mix * (kPlasma[low + 1][i] - value)) as Rgb;
}

/** The colour of a plastic fraction, 0 to 255. */
export function wallColour(fraction: number, dark: boolean): Rgb {
  const colour = dark ? plasma(0.12 + 0.78 * fraction) : plasma(0.72 * fraction);
  // On a dark background the low end is lifted, or the undeformed lattice would vanish.
  const lift = dark ? 62 * (1 - fraction) ** 2 : 0;
  return colour.map((value) => Math.min(255, Math.round(value + lift))) as Rgb;
}

/** The colour of a rigid element: that of plates in theme.css. */
export function rigidColour(dark: boolean): Rgb {
  return dark ? [139, 148, 161] : [91, 97, 108];
}

export const kShades = 64;

/** The map as RGBA bytes, kShades of them. */
export function colourTable(dark: boolean): Uint8Array {
  const table = new Uint8Array(4 * kShades);
  for (let i = 0; i < kShades; ++i) table.set([...wallColour(i / (kShades - 1), dark), 255], 4 * i);
  return table;
}

export function cssColour([r, g, b]: Rgb): string {
  return `rgb(${r} ${g} ${b})`;
}

/** A colour of the style sheet, by the name of its variable. */
export function themeColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** The colour map with its ends, which follows the theme. */
export function colourLegend(): HTMLElement {
  const canvas = h("canvas", { width: kShades, height: 1, class: "map", "aria-hidden": "true" });
  const paint = (): void => {
    const context = canvas.getContext("2d")!;
    context.putImageData(new ImageData(new Uint8ClampedArray(colourTable(isDark())), kShades, 1), 0, 0);
  };
  paint();
  onThemeChange(paint);
  return h("div", { class: "colour-legend", title: "Fraction of a wall's section that has yielded" },
    h("span", {}, "plastic fraction"), h("span", {}, "0"), canvas, h("span", {}, "1"));
}
