// The comments of the protos, which gen/help.json holds.
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
