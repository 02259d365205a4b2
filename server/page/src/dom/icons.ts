// Icons of actions, 16 x 16, drawn in the colour of the text.
import { h, svg } from "./element";

const kPaths = {
  pause: "M5 3v10M11 3v10",
  play: "M4.500 2.500l8 5.500l-8 5.500z",
  stop: "M4 4h8v8H4z",
  trash: "M3 4.500h10M6 4.500v-2h4v2M4.500 4.500l.7 9h5.600l.7-9M7 7v4.500M9 7v4.500",
  fork: "M5 3v5.500a2 2 0 0 0 2 2h5M9.500 8l2.700 2.500L9.500 13M5 8.500V13",
  retry: "M12.500 8a4.500 4.500 0 1 1-1.500-3.300M11.500 1.800v3.200H8.300",
  previous: "M10.500 3l-6 5 6 5",
  next: "M5.500 3l6 5-6 5",
  fit: "M2.500 6v-3.500H6M10 2.500h3.500V6M13.500 10v3.500H10M6 13.500H2.500V10",
  minus: "M3 8h10",
} as const;

export type IconName = keyof typeof kPaths;

export function icon(name: IconName): SVGElement {
  return svg("svg", { viewBox: "0 0 16 16", class: "icon", "aria-hidden": "true" }, svg("path", { d: kPaths[name] }));
}

/** A button that shows an icon; the label is its tooltip and its name for screen readers. */
export function iconButton(name: IconName, label: string, click: () => void): HTMLButtonElement {
  return h("button", { type: "button", class: "icon-button", title: label, "aria-label": label, click }, icon(name));
}

export function setIcon(button: HTMLButtonElement, name: IconName, label: string): void {
  if (button.title === label) return;
  button.replaceChildren(icon(name));
  button.title = label;
  button.setAttribute("aria-label", label);
}
