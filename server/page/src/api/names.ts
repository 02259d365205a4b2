// Names of jobs and sweeps, "jobs/12", are the paths of their pages without the first slash.

export const pathOf = (name: string): string => `/${name}`;
export const idOf = (name: string): string => name.slice(name.indexOf("/") + 1);

/** The order of names by number. */
export function byNumber(a: string, b: string): number {
  return Number(idOf(a)) - Number(idOf(b));
}
