// What fields are called and mean: from their names, and from the comments of the protos, which gen/help.json holds.
import help from "../gen/help.json";

const messages: Record<string, Record<string, string>> = help.messages;
const enums: Record<string, Record<string, string>> = help.enums;

/** Help of a field; `message` is its name without the package, such as "Lattice.Hexagon". */
export function fieldHelp(message: string, field: string): string {
  return messages[message]?.[field] ?? "";
}

export function valueHelp(enumName: string, value: string): string {
  return enums[enumName]?.[value] ?? "";
}

const kUnits: [RegExp, string][] = [[/_kg_per_m3$/, "kg/m³"], [/_n_per_mm$/, "N/mm"], [/_n_mm$/, "N mm"],
                                    [/_m_per_s2$/, "m/s²"], [/_m_per_s$/, "m/s"], [/_mpa$/, "MPa"], [/_mm$/, "mm"],
                                    [/_per_s$/, "1/s"], [/_s$/, "s"], [/_g$/, "g"], [/_n$/, "N"]];

/** The last name of a path in words, and its unit: "wall thickness" in "mm". The unit may be empty. */
export function nameOf(path: string): { words: string; unit: string } {
  const name = path.slice(path.lastIndexOf(".") + 1);
  const [pattern, unit] = kUnits.find(([ending]) => ending.test(name)) ?? [/$/, ""];
  return { words: name.replace(pattern, "").replaceAll("_", " "), unit };
}
