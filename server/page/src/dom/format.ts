// Numbers, times, sizes, and names of jobs and sweeps as text.
import { urlOf } from "./base";

const kMissing = "–";

/** A number with the given significant digits, without an exponent in the range that engineers read. */
export function number(value: number | undefined, digits = 3): string {
  if (value === undefined || !Number.isFinite(value)) return kMissing;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(digits - 1).replace("e+", "e");
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return value.toFixed(Math.min(decimals, 6));
}

/** A number as it was given, in at most six significant digits: a value of a case or of an axis. */
export const given = (value: number): string => String(Number(value.toPrecision(6))).replace("e+", "e");

export interface Unit { name: string; factor: number }

// From a size on: the unit, and the factor to it.
const kBySize: Record<string, [number, string, number][]> = {
  MPa: [[0.1, "MPa", 1], [0, "kPa", 1e3]],
  mJ: [[1e6, "kJ", 1e-6], [1e3, "J", 1e-3], [0, "mJ", 1]],
  N: [[1e3, "kN", 1e-3], [0, "N", 1]],
};

/** The unit for numbers of a size: kPa below 0.1 MPa; J from 1000 mJ, kJ from 1000 J; kN from 1000 N. */
export function unitBySize(unit: string, size: number): Unit {
  const found = size > 0 ? kBySize[unit]?.find(([from]) => size >= from) : undefined;
  return found ? { name: found[1], factor: found[2] } : { name: unit, factor: 1 };
}

/** A number with its unit, by its size. */
export function quantity(value: number | undefined, unit: string, digits = 3): string {
  if (value === undefined) return kMissing;
  const { name, factor } = unitBySize(unit, Math.abs(value));
  return `${number(value * factor, digits)} ${name}`;
}

export function percent(fraction: number | undefined, digits = 2): string {
  if (fraction === undefined || !Number.isFinite(fraction)) return kMissing;
  if (fraction !== 0 && Math.abs(fraction) < 1e-4) return "under 0.01 %";
  return `${number(100 * fraction, digits)} %`;
}

/** Nominal strain, always with two decimals so that columns align. */
export function strainText(strain: number | undefined): string {
  return strain?.toFixed(2) ?? kMissing;
}

export function count(value: number | bigint): string {
  return Number(value).toLocaleString("en").replaceAll(",", "\u202f");
}

export function duration(seconds: number | undefined): string {
  if (seconds === undefined || !Number.isFinite(seconds) || seconds < 0) return kMissing;
  if (seconds < 1) return seconds < 0.095 ? `${Math.max(1, Math.round(1000 * seconds))} ms` : `${seconds.toFixed(1)} s`;
  if (seconds < 100) return `${Math.round(seconds)} s`;
  if (seconds < 6000) return `${Math.round(seconds / 60)} min`;
  if (seconds < 2 * 86400) return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
  return `${number(seconds / 86400, 2)} days`;
}

export function bytes(size: number | bigint): string {
  const value = Number(size);
  if (value < 1e3) return `${value} B`;
  if (value < 1e6) return `${number(value / 1e3)} kB`;
  return value < 1e9 ? `${number(value / 1e6)} MB` : `${number(value / 1e9)} GB`;
}

const kSameDay = new Intl.DateTimeFormat("en-GB", { hour: "2-digit", minute: "2-digit" });
const kOtherDay = new Intl.DateTimeFormat("en-GB", { day: "numeric", month: "short", hour: "2-digit",
                                                     minute: "2-digit" });
const kOtherYear = new Intl.DateTimeFormat("en-GB", { dateStyle: "medium" });
const kFull = new Intl.DateTimeFormat("en-GB", { dateStyle: "medium", timeStyle: "medium" });

export interface Instant { seconds: bigint; nanos: number }

export function milliseconds(time: Instant): number {
  return Number(time.seconds) * 1000 + time.nanos / 1e6;
}

/** Time of day, with the date if it is not today. */
export function clock(time: Instant | undefined): string {
  if (!time) return kMissing;
  const date = new Date(milliseconds(time));
  const today = new Date();
  if (date.getFullYear() !== today.getFullYear()) return kOtherYear.format(date);
  return (date.toDateString() === today.toDateString() ? kSameDay : kOtherDay).format(date);
}

export function fullTime(time: Instant | undefined): string {
  return time ? kFull.format(new Date(milliseconds(time))) : "";
}

export function plural(value: number, noun: string): string {
  return `${count(value)} ${noun}${value === 1 ? "" : "s"}`;
}

// Names, such as "jobs/12", are the paths of their pages without the first slash.
export const pathOf = (name: string): string => urlOf(`/${name}`);
export const idOf = (name: string): string => name.slice(name.indexOf("/") + 1);

/** The order of names by number. */
export function byNumber(a: string, b: string): number {
  return Number(idOf(a)) - Number(idOf(b));
}
