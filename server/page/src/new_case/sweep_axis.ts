// The fields that a sweep varies, and their values: a list, or a range as "10:200:8" or "10:200:8:log".
import { create } from "@bufbuild/protobuf";
import { SweepAxisSchema, type SweepAxis } from "../../gen/cellcrush/v1/sweep_pb";
import { given, plural } from "../dom/format";
import { button, h, labelled, replaceChildren } from "../dom/element";
import { iconButton } from "../dom/icons";
import { showHint } from "./field_input";
import { readReal } from "./typed_number";
import { labelOf, unitOf } from "./words";

/** The axis that a text describes, or what is wrong with the text. */
export function axisOf(field: string, text: string): SweepAxis | string {
  const plain = text.trim();
  const seeds = plain.match(/^seeds:(\d+)$/);
  if (seeds) return create(SweepAxisSchema, { field, values: { case: "seedCount", value: Number(seeds[1]) } });
  const range = plain.match(/^([^:\s]+):([^:\s]+):(\d+)(:log)?$/);
  if (range) {
    const ends = numbersOf(range.slice(1, 3));
    if (typeof ends === "string") return ends;
    const [[first, last], count] = [ends, Number(range[3])];
    if (count < 2) return "A range is first:last:count, with a count of 2 or more.";
    return create(SweepAxisSchema, { field, values: { case: range[4] ? "logarithmic" : "linear",
                                                      value: { first, last, count } } });
  }
  // A comma between values, unless semicolons are.
  const values = numbersOf(plain.split(plain.includes(";") ? ";" : /[\s,]+/).filter((each) => each.trim()));
  if (typeof values === "string") return values;
  if (!values.length) return "Give values such as 25, 50, 100 or a range such as 10:200:8.";
  return create(SweepAxisSchema, { field, values: { case: "list", value: { values } } });
}

// What is wrong with the first text that is no number, or all numbers.
function numbersOf(texts: string[]): number[] | string {
  const typed = texts.map(readReal);
  const wrong = typed.findIndex(({ problem }) => problem !== undefined);
  return wrong < 0 ? typed.map(({ plain }) => Number(plain)) : `“${texts[wrong].trim()}” ${typed[wrong].problem}.`;
}

/** The values of an axis as they were read: "3 values: 25, 50, 100 m/s". */
export function axisText({ values }: SweepAxis, unit: string): string {
  const numbers = (all: number[]): string => `${all.map(given).join(", ")} ${unit}`.trim();
  switch (values.case) {
    case "list": {
      const all = values.value.values;
      return `${plural(all.length, "value")}: ${numbers(all.slice(0, 12))}${all.length > 12 ? " …" : ""}`;
    }
    case "seedCount": return `seeds 1 to ${values.value}`;
    case "linear":
    case "logarithmic": {
      const { first, last, count } = values.value;
      return `${plural(count, "value")}, ${numbers([first])} to ${numbers([last])}`;
    }
    default: return "";
  }
}

function valueCount(axis: SweepAxis): number {
  switch (axis.values.case) {
    case "list": return axis.values.value.values.length;
    case "seedCount": return axis.values.value;
    case "linear":
    case "logarithmic": return axis.values.value.count;
    default: return 0;
  }
}

/** Number of jobs of a grid over all axes. */
export function jobCount(axes: SweepAxis[]): number {
  return axes.reduce((product, axis) => product * valueCount(axis), 1);
}

class AxisInput {
  readonly element: HTMLElement;
  private readonly field = h("select");
  private readonly values = h("input", { type: "text", autocomplete: "off", spellcheck: "false",
    title: "a list, first:last:count, first:last:count:log, or seeds:count" });
  private readonly hint = h("div", { class: "limits" });
  readonly remove: HTMLButtonElement;

  constructor(changed: () => void, removed: () => void) {
    this.field.addEventListener("change", () => {
      this.values.value = this.isSeed ? "seeds:5" : "";
      changed();
    });
    this.values.addEventListener("input", changed);
    this.remove = iconButton("minus", "Remove field", removed);
    this.element = h("div", { class: "axis" }, labelled("Varied field", this.field),
      labelled("Values", this.values, this.hint), this.remove);
  }

  private get isSeed(): boolean {
    return this.field.value.endsWith(".seed");
  }

  get path(): string {
    return this.field.value;
  }

  /** Chooses a field with its first values. */
  choose(path: string, values: string): void {
    this.field.value = path;
    this.values.value = values;
  }

  setPaths(paths: string[]): void {
    const chosen = this.field.value;
    replaceChildren(this.field, ...paths.map((path) => {
      const unit = unitOf(path);
      return h("option", { value: path }, labelOf(path) + (unit ? ` (${unit})` : ""));
    }));
    this.field.value = paths.includes(chosen) ? chosen : paths[0];
  }

  focus(): void {
    this.field.focus();
  }

  /** `others` are the fields of the axes before. */
  read(others: string[]): SweepAxis | undefined {
    const axis = others.includes(this.path) ? "This field is already varied." : axisOf(this.path, this.values.value);
    const isAxis = typeof axis !== "string";
    showHint(this.hint, isAxis ? axisText(axis, unitOf(this.path)) : axis, isAxis);
    return isAxis ? axis : undefined;
  }
}

const kMostAxes = 4; // a sweep over more fields belongs into a script

/** The fields that a sweep varies: one job for each combination of their values. */
export class SweepInput {
  readonly element: HTMLElement;
  private readonly list = h("div", { class: "axes" });
  private readonly more = button("Vary another field", () => this.add(), { class: "quiet" });
  private axes: AxisInput[] = [];
  private paths: string[] = [];

  constructor(private readonly changed: () => void) {
    this.element = h("div", { class: "sweep-input", hidden: true }, this.list, this.more);
  }

  setPaths(paths: string[]): void {
    this.paths = paths;
    if (this.axes.length === 0 && this.paths.length > 0) {
      const first = this.append();
      const speed = "loading.speed_m_per_s";
      if (this.paths.includes(speed)) first.choose(speed, "25, 50, 100, 200");
    }
    for (const axis of this.axes) axis.setPaths(this.paths);
  }

  private append(): AxisInput {
    const axis = new AxisInput(this.changed, () => this.removeAxis(axis));
    axis.setPaths(this.paths);
    this.axes.push(axis);
    this.show();
    return axis;
  }

  // A further field is most often the seed, for the scatter between specimens.
  private add(): void {
    const taken = this.axes.map((axis) => axis.path);
    const free = this.paths.filter((path) => !taken.includes(path));
    const seed = free.find((path) => path.endsWith(".seed"));
    const axis = this.append();
    axis.choose(seed ?? free[0], seed ? "seeds:5" : "");
    axis.focus();
    this.changed();
  }

  private removeAxis(axis: AxisInput): void {
    this.axes = this.axes.filter((other) => other !== axis);
    this.show();
    this.more.focus();
    this.changed();
  }

  private show(): void {
    replaceChildren(this.list, ...this.axes.map((axis) => axis.element));
    for (const axis of this.axes) axis.remove.hidden = this.axes.length === 1;
    this.more.hidden = this.axes.length >= Math.min(kMostAxes, this.paths.length);
  }

  /** The axes; undefined while one of the texts describes none. */
  read(): SweepAxis[] | undefined {
    const read = this.axes.map((axis, i) => axis.read(this.axes.slice(0, i).map((other) => other.path)));
    return read.length > 0 && read.every((axis) => axis !== undefined) ? read : undefined;
  }
}
