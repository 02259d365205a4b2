// What a user prefers, kept in the browser: the theme, the columns of tables, the scales of charts.

const key = (name: string): string => `cellcrush-${name}`;

/** What is kept under a name; the fallback where nothing is, or where the browser keeps nothing. */
export function kept<T>(name: string, fallback: T): T {
  try {
    const text = localStorage.getItem(key(name));
    return text === null ? fallback : JSON.parse(text) as T;
  } catch {
    return fallback;
  }
}

export function keep(name: string, value: unknown): void {
  try {
    localStorage.setItem(key(name), JSON.stringify(value));
  } catch {
    // A browser that keeps nothing forgets it with the tab.
  }
}

export const kThemes = ["auto", "light", "dark"] as const;
const kDark = "(prefers-color-scheme: dark)";
export type Theme = typeof kThemes[number];

const listeners = new Set<() => void>();

export function theme(): Theme {
  const name = kept<Theme>("theme", "auto");
  return kThemes.includes(name) ? name : "auto";
}

export const isDark = (): boolean => document.documentElement.dataset.theme === "dark";

// The style sheet reads the attribute.
function applyTheme(): void {
  const wanted = theme();
  const name = wanted === "auto" ? (matchMedia(kDark).matches ? "dark" : "light") : wanted;
  if (document.documentElement.dataset.theme === name) return;
  document.documentElement.dataset.theme = name;
  for (const call of [...listeners]) call();
}

export function chooseTheme(name: Theme): void {
  keep("theme", name);
  applyTheme();
}

/** Calls when the theme changes, until the returned function is called. */
export function onThemeChange(call: () => void): () => void {
  listeners.add(call);
  return () => listeners.delete(call);
}

/** Applies the theme, from now on. */
export function startTheme(): void {
  matchMedia(kDark).addEventListener("change", applyTheme);
  addEventListener("storage", applyTheme); // another tab has chosen
  applyTheme();
}
