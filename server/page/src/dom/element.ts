// Elements from TypeScript. Text always becomes a text node, so that titles and labels of jobs cannot inject markup,
// and is printable, so that they cannot reorder the text beside them.

export type Child = Node | string | number | null | undefined | false;
type Listener = (event: never) => void;
export type Attributes = Record<string, string | number | boolean | null | undefined | Listener>;

/** The text with characters that change the direction of text, such as U+202E, as escapes. */
export function printable(text: string): string {
  return text.replace(/[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]/g,
                      (character) => `\\u${character.charCodeAt(0).toString(16).padStart(4, "0")}`);
}

const kShownAttributes = ["title", "aria-label"];

function setAttributes(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      element.addEventListener(name, value as EventListener);
    } else if (value !== null && value !== undefined && value !== false) {
      const text = value === true ? "" : String(value);
      element.setAttribute(name, kShownAttributes.includes(name) ? printable(text) : text);
    }
  }
}

export function append(parent: Node, children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    parent.appendChild(child instanceof Node ? child : document.createTextNode(printable(String(child))));
  }
}

/** A new element: attributes by name, listeners where the value is a function. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

/** Replaces the text of an element only if it differs, which keeps selections and avoids layout. */
export function setText(element: Element, text: string): void {
  const shown = printable(text);
  if (element.textContent !== shown) element.textContent = shown;
}

/** Shows a text in a banner, or no banner. */
export function setBanner(banner: HTMLElement, text: string): void {
  banner.hidden = !text;
  setText(banner, text);
}

export function replaceChildren(element: Element, ...children: Child[]): void {
  element.replaceChildren();
  append(element, children);
}

let inputs = 0;

/** An input with its label; `hint` below it tells its limits or what is wrong. */
export function labelled(label: string, input: HTMLElement, hint?: HTMLElement, unit = ""): HTMLElement {
  input.id ||= `field-${++inputs}`;
  if (hint) {
    hint.id = `${input.id}-hint`;
    input.setAttribute("aria-describedby", hint.id);
  }
  return h("div", { class: "field" }, h("label", { for: input.id }, label),
    h("div", { class: "with-unit" }, input, unit ? h("span", { class: "unit" }, unit) : null), hint);
}

export function button(label: string, click: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return h("button", { type: "button", click, ...attributes }, label);
}
