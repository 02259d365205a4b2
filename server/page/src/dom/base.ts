// Where the page lies on its site: behind some proxies below a path, such as that of a notebook server.
//
// Links of the page begin with urlOf, and views see paths as the daemon does, without what is before them.

/** The path before those of the daemon, such as "/node/host/8080"; empty at the top of the site. */
export const base = baseOf(import.meta.url);

/** The same by the address of the script, which the daemon serves at its top. */
export function baseOf(script: string): string {
  return new URL(".", script).pathname.replace(/\/$/, "");
}

/** The address of a path of the daemon, such as "/jobs/7". */
export const urlOf = (path: string): string => base + path;

/** The path of the daemon that an address of the site leads to. */
export function pathIn(url: string, below = base): string {
  const isBelow = url === below || url.startsWith(`${below}/`);
  return (isBelow ? url.slice(below.length) : url) || "/";
}
