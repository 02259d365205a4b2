// The columns of a table: a head that sorts its rows, and a menu of the columns to show, which the browser keeps.
import { h, replaceChildren } from "./element";
import { keep, kept } from "./preferences";

export interface Column<T> {
  key: string;
  name: string;
  /** A number, at the right. */
  figure?: boolean;
  /** What the rows are sorted by; without it the head is only read aloud. */
  value?(row: T): number | string | undefined;
  /** Whether it is shown until the user chooses; "always" leaves no choice. Default true. */
  shown?: boolean | "always";
}

type Value = number | string | undefined;

// Rows without a value come last in either direction.
function compare(a: Value, b: Value, direction: 1 | -1): number {
  if (a === undefined || b === undefined) return Number(a === undefined) - Number(b === undefined);
  if (typeof a === "string" || typeof b === "string") return direction * String(a).localeCompare(String(b));
  return direction * (a - b);
}

export class Columns<T> {
  readonly head = h("tr");
  private readonly choices = h("div", { class: "choices" });
  readonly menu = h("details", { class: "columns-menu", hidden: true }, h("summary", {}, "Columns"), this.choices);
  private columns: Column<T>[] = [];
  private order: { key: string; direction: 1 | -1 } | undefined;
  private shownKey = "";

  /** `place` names the table in what the browser keeps. */
  constructor(private readonly place: string, private readonly changed: () => void) {
    this.menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      this.menu.open = false;
      this.menu.querySelector("summary")!.focus();
    });
    this.menu.addEventListener("focusout", (event) => {
      const to = event.relatedTarget as Node | null;
      if (to && !this.menu.contains(to)) this.menu.open = false;
    });
  }

  set(columns: Column<T>[]): void {
    const key = columns.map((column) => `${column.key} ${column.name}`).join("\n");
    this.columns = columns;
    if (key === this.shownKey) return;
    this.shownKey = key;
    this.show();
  }

  private get chosen(): Record<string, boolean> {
    return kept<Record<string, boolean>>(`columns-${this.place}`, {});
  }

  isShown({ key, shown = true }: Column<T>): boolean {
    return shown === "always" || (this.chosen[key] ?? shown);
  }

  get shown(): Column<T>[] {
    const { chosen } = this;
    return this.columns.filter(({ key, shown = true }) => shown === "always" || (chosen[key] ?? shown));
  }

  /** The rows in the order that the user chose; as given, if none. */
  sorted(rows: T[]): T[] {
    const { order } = this;
    const column = this.columns.find(({ key }) => key === order?.key);
    if (!order || !column?.value) return rows;
    return [...rows].sort((a, b) => compare(column.value!(a), column.value!(b), order.direction));
  }

  private show(): void {
    replaceChildren(this.head, ...this.shown.map((column) => this.headOf(column)));
    const { chosen } = this;
    const optional = this.columns.filter(({ shown }) => shown !== "always");
    this.menu.hidden = optional.length === 0;
    replaceChildren(this.choices, ...optional.map(({ key, name, shown = true }) => {
      const box = h("input", { type: "checkbox", change: () => {
        keep(`columns-${this.place}`, { ...this.chosen, [key]: box.checked });
        replaceChildren(this.head, ...this.shown.map((column) => this.headOf(column)));
        this.changed();
      } });
      box.checked = chosen[key] ?? shown === true;
      return h("label", {}, box, ` ${name}`);
    }));
  }

  private headOf(column: Column<T>): HTMLElement {
    const { key, name, figure, value } = column;
    const direction = this.order?.key === key ? this.order.direction : 0;
    const cell = h("th", { scope: "col", class: figure ? "figure" : "", "data-column": key,
                           "aria-sort": direction === 1 ? "ascending" : direction === -1 ? "descending" : null });
    if (!value) {
      cell.append(h("span", { class: "unseen" }, name));
      return cell;
    }
    const sort = h("button", { type: "button", class: "sort", click: () => this.sortBy(key, direction) }, name,
                   h("span", { "aria-hidden": "true" }, direction === 1 ? "▲" : direction === -1 ? "▼" : ""));
    cell.append(sort);
    return cell;
  }

  // Up, then down, then the order of the table itself.
  private sortBy(key: string, direction: 0 | 1 | -1): void {
    this.order = direction === -1 ? undefined : { key, direction: direction === 1 ? -1 : 1 };
    replaceChildren(this.head, ...this.shown.map((column) => this.headOf(column)));
    this.head.querySelector<HTMLElement>(`[data-column="${CSS.escape(key)}"] button`)?.focus();
    this.changed();
  }
}
