// A table of numbers as text: one row a point, as a spreadsheet copies it.
import { ScalarType, type DescField } from "@bufbuild/protobuf";
import type { ReflectMessage } from "@bufbuild/protobuf/reflect";
import { plural } from "../dom/format";
import { entriesOf, readReal } from "./typed_number";

export type Column = DescField & { fieldKind: "list" };

const isColumn = (field: DescField): field is Column =>
  field.fieldKind === "list" && field.listKind === "scalar" && field.scalar === ScalarType.DOUBLE;

/** The columns of a field that is a table, such as strains and stresses; none of another field. */
export const columnsOf = (field: DescField): Column[] =>
  field.fieldKind === "message" ? field.message.fields.filter(isColumn) : [];

/** The rows of a text, or what is wrong with the first one that is none. */
export function rowsOf(text: string, columnCount: number): number[][] | string {
  const rows: number[][] = [];
  const lines = text.split("\n").filter((line) => line.trim());
  // A comma separates where nothing else does in any row; beside another separator it is a decimal sign.
  const areByComma = lines.every((line) => entriesOf(line).length === 1);
  for (const line of lines) {
    const row = `Row ${rows.length + 1}`;
    const cells = areByComma ? line.split(",") : entriesOf(line);
    const typed = cells.map(readReal);
    const faulty = typed.findIndex(({ problem }) => problem);
    if (faulty >= 0) return `${row}: “${cells[faulty].trim()}” ${typed[faulty].problem}.`;
    if (cells.length !== columnCount) {
      return `${row} has ${plural(cells.length, "number")}, not ${columnCount}. Separate them by a tab, semicolon, ` +
        "comma or blank.";
    }
    rows.push(typed.map(({ plain }) => Number(plain)));
  }
  return rows;
}

/** The rows of a table as text, which a spreadsheet takes too. */
export function tableText(table: ReflectMessage, columns: Column[]): string {
  const lists = columns.map((column) => [...table.get(column)]);
  const rowCount = Math.max(...lists.map(({ length }) => length));
  return Array.from({ length: rowCount }, (_, row) => lists.map((list) => list[row] ?? "").join("\t")).join("\n");
}

/** Puts rows into a table, in place of those that it has. */
export function setRows(table: ReflectMessage, columns: Column[], rows: number[][]): void {
  for (const [i, column] of columns.entries()) {
    const list = table.get(column);
    list.clear();
    for (const row of rows) list.add(row[i]);
  }
}
