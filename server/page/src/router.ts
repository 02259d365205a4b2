// Views by path, without loading the page again.

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
  document.title = title ? `${title} – cellcrush` : "cellcrush";
}

function show(): void {
  current?.destroy();
  current = undefined;
  for (const { path, build } of routes) {
    const match = location.pathname.match(path);
    if (!match) continue;
    current = build(match, new URLSearchParams(location.search));
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

/** Writes values into the query of the URL, without a new entry in the history; undefined removes one. */
export function keepInUrl(values: Record<string, string | undefined>): void {
  const url = new URL(location.href);
  for (const [key, value] of Object.entries(values)) {
    if (value === undefined || value === "") url.searchParams.delete(key);
    else url.searchParams.set(key, value);
  }
  const text = url.pathname + url.search.replaceAll("%2C", ",").replaceAll("%2F", "/").replaceAll("%3A", ":");
  if (text !== location.pathname + location.search) history.replaceState(null, "", text);
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
