// Views by path, without loading the page again.
import { isExported } from "./api/exported";
import { pathIn } from "./dom/base";
import { printable } from "./dom/element";

export interface View {
  readonly element: HTMLElement;
  readonly title: string;
  destroy(): void;
}

type Build = (match: RegExpMatchArray, query: URLSearchParams) => View;
const routes: { path: RegExp; build: Build }[] = [];
let current: View | undefined;
let main: HTMLElement;

export function route(path: RegExp, build: Build): void {
  routes.push({ path, build });
}

export function setTitle(title: string): void {
  document.title = title ? `${printable(title)} – cellcrush` : "cellcrush";
}

function show(): void {
  current?.destroy();
  current = undefined;
  for (const { path, build } of routes) {
    const match = pathIn(location.pathname).match(path);
    if (!match) continue;
    current = build(match, valuesOfUrl());
    break;
  }
  if (current) main.replaceChildren(current.element);
  setTitle(current?.title ?? "");
  for (const link of document.querySelectorAll<HTMLAnchorElement>("nav a")) {
    if (link.pathname === location.pathname) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

export function go(path: string): void {
  history.pushState(null, "", path);
  show();
  window.scrollTo(0, 0);
}

/** The values that the URL holds: in its query or, in a file on disk, behind its #. */
export function valuesOfUrl(): URLSearchParams {
  return new URLSearchParams(isExported ? location.hash.slice(1) : location.search);
}

/** Writes values into the URL, without a new entry in the history; undefined removes one. */
export function keepInUrl(values: Record<string, string | undefined>): void {
  const kept = valuesOfUrl();
  for (const [key, value] of Object.entries(values)) {
    if (value === undefined || value === "") kept.delete(key);
    else kept.set(key, value);
  }
  const query = String(kept).replaceAll("%2C", ",").replaceAll("%2F", "/").replaceAll("%3A", ":");
  const [before, mark] = isExported ? [location.hash, "#"] : [location.search, "?"];
  const text = query ? mark + query : "";
  if (text !== before) history.replaceState(null, "", text || (isExported ? "#" : location.pathname));
}

/** Shows this view alone, until the page is loaded again. Links load it. */
export function showOnly(view: View): void {
  routes.splice(0, routes.length, { path: /^/, build: () => view });
  document.removeEventListener("click", followLink);
  show();
}

// Links of the page, unless the user asks for a new tab or window.
function followLink(event: MouseEvent): void {
  const link = (event.target as Element).closest?.("a");
  if (!link || event.defaultPrevented || event.button !== 0) return;
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
  if (link.origin !== location.origin || link.hasAttribute("download") || link.target) return;
  event.preventDefault();
  go(link.pathname + link.search);
}

export function startRouter(place: HTMLElement): void {
  main = place;
  document.addEventListener("click", followLink);
  window.addEventListener("popstate", show);
  show();
}
