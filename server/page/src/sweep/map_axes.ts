// The two fields of a map and, of a sweep over more, the values at which it holds the others.
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { Listeners } from "../dom/calls";
import { h, replaceChildren } from "../dom/element";
import { given } from "../dom/format";
import { axisName, isSeed } from "./points";

/** The values of a field in some rows, ascending. */
export const valuesOf = (rows: SweepTable_Row[], field: number): number[] =>
  [...new Set(rows.map((row) => row.values[field]))].sort((a, b) => a - b);

export class MapAxes {
  /** Empty where there is no choice. */
  readonly element = h("div", { class: "map-axes" });
  readonly changes = new Listeners<void>();
  /** Places of the fields across and up. */
  x = 0;
  y = 1;
  private varied: number[] = [];
  private names: string[] = [];
  private values = new Map<number, number[]>();
  private held = new Map<number, number>();
  private key = "";

  /** Whether the sweep varies two fields or more besides the seed. */
  get areTwo(): boolean {
    return this.varied.length >= 2;
  }

  /** Whether a row has the values at which other fields are held. */
  shows(row: SweepTable_Row): boolean {
    return this.others.every((field) => row.values[field] === this.held.get(field));
  }

  private get others(): number[] {
    return this.varied.filter((field) => field !== this.x && field !== this.y);
  }

  update(rows: SweepTable_Row[], fields: string[]): void {
    const places = fields.map((_, i) => i).filter((i) => !isSeed(fields[i]));
    this.values = new Map(places.map((i) => [i, valuesOf(rows, i)]));
    const key = JSON.stringify([fields, ...this.values]);
    if (key === this.key) return;
    this.key = key;
    this.names = fields.map(axisName);
    this.varied = places.filter((i) => this.values.get(i)!.length > 1);
    [this.x, this.y] = this.varied;
    this.held = new Map(this.varied.map((field) => [field, this.values.get(field)![0]]));
    this.show();
  }

  // The field that gives way takes the place of the chosen one.
  private choose(x: number, y: number): void {
    [this.x, this.y] = x !== y ? [x, y] : x === this.x ? [this.y, x] : [x, this.x];
    this.show();
    this.changes.tell();
  }

  private show(): void {
    const axis = (name: string, chosen: number, choose: (field: number) => void): HTMLElement =>
      this.choice(name, this.varied.map((field) => [field, this.names[field]]), chosen, choose);
    const selects = this.element.getElementsByTagName("select");
    const focused = [...selects].findIndex((select) => select === document.activeElement);
    replaceChildren(this.element, ...(this.varied.length < 3 ? [] : [
      axis("across", this.x, (field) => this.choose(field, this.y)),
      axis("up", this.y, (field) => this.choose(this.x, field)),
      ...this.others.map((other) => this.choice(this.names[other],
        this.values.get(other)!.map((value) => [value, given(value)]), this.held.get(other)!, (value) => {
          this.held.set(other, value);
          this.changes.tell();
        })),
    ]));
    selects[focused]?.focus();
  }

  private choice(name: string, options: [number, string][], chosen: number,
                 choose: (value: number) => void): HTMLElement {
    const select = h("select", { "aria-label": name, change: () => choose(Number(select.value)) },
      ...options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)));
    return h("span", {}, name, " ", select);
  }
}
