// Numbers as people type them. The command line reads by the same rules (client-cli/case_file/typed_number.cpp), and
// tests/scenes/typed_numbers.csv holds both to them.

/** The number as programs write it, such as "1.5" of "1,5", or why the text is none, to follow it. */
export type TypedNumber = { plain: string; problem?: undefined } | { plain?: undefined; problem: string };

const kLongest = 64;

/** Reads a real number. A comma is a decimal sign, unless it may separate thousands: "1,200" is a problem. */
export function readReal(text: string): TypedNumber {
  const parts = text.length <= kLongest
    && text.match(/^[ \t]*([+-]?)(\d*)(?:([.,])(\d*))?(?:[eE]([+-]?\d+))?[ \t]*$/);
  if (!parts || !(parts[2] || parts[4])) {
    return { problem: "is not a number: write digits with a point, such as 0.35 or 2e-7" };
  }
  const sign = parts[1] === "-" ? "-" : "";
  const whole = parts[2] || "0";
  const fraction = parts[4] ?? "";
  const exponent = parts[5] ? `e${parts[5]}` : "";
  const digits = fraction.replace(/0+$/, "");
  const shortest = sign + whole + (digits && `.${digits}`) + exponent;
  if (parts[3] === "," && whole.length <= 3 && !whole.startsWith("0") && fraction.length === 3) {
    const thousands = sign + whole + fraction + exponent;
    return { problem: `could be ${shortest} or ${thousands}: write ${shortest} or ${thousands}` };
  }
  const value = Number(shortest);
  if (!Number.isFinite(value) || (value === 0 && /[1-9]/.test(whole + fraction))) {
    return { problem: "is beyond the range of numbers, 1e-308 to 1e308" };
  }
  return { plain: sign + whole + (fraction && `.${fraction}`) + exponent };
}

/** What stands between blanks, semicolons, or commas with a blank: a comma without one may be a decimal sign. */
export const entriesOf = (text: string): string[] => text.trim().split(/\s*;\s*|,?\s+/).filter(Boolean);

/** The shortest form of a plain number: "1.2" of "1.200". */
export function shortest(plain: string): string {
  return /^-?\d+$/.test(plain) ? String(BigInt(plain)) : String(Number(plain)).replace("e+", "e");
}

/** Reads a whole number of any size: digits only. */
export function readWhole(text: string): TypedNumber {
  const parts = text.length <= kLongest && text.match(/^[ \t]*([+-]?)(\d+)[ \t]*$/);
  if (!parts) return { problem: "is not a whole number: write digits only, such as 12" };
  return { plain: (parts[1] === "-" ? "-" : "") + parts[2] };
}
