// One field that a sweep varies, and its values: a list, or a range as "10:200:8" or "10:200:8:log".
import { create } from "@bufbuild/protobuf";
import { SweepAxisSchema, type SweepAxis } from "../../gen/cellcrush/v1/sweep_pb";
import { h, replaceChildren, setText } from "../dom/element";
import { fieldAt } from "./fields";
import { labelOf, unitOf } from "./words";

/** The axis that a text describes, or what is wrong with the text. */
export function axisOf(field: string, text: string): SweepAxis | string {
  const plain = text.trim();
  const seeds = plain.match(/^seeds:(\d+)$/);
  if (seeds) return create(SweepAxisSchema, { field, values: { case: "seedCount", value: Number(seeds[1]) } });
  const range = plain.match(/^([^:\s]+):([^:\s]+):(\d+)(:log)?$/);
  if (range) {
    const [first, last, count] = range.slice(1, 4).map(Number);
    if (!Number.isFinite(first + last) || count < 2) return "A range is first:last:count, with a count of 2 or more.";
    return create(SweepAxisSchema, { field, values: { case: range[4] ? "logarithmic" : "linear",
                                                      value: { first, last, count } } });
  }
  const values = plain.split(/[\s,;]+/).filter(Boolean).map(Number);
  if (!values.length) return "Give values such as 25, 50, 100 or a range such as 10:200:8.";
  if (values.some((value) => !Number.isFinite(value))) return "These are not all numbers.";
  return create(SweepAxisSchema, { field, values: { case: "list", value: { values } } });
}

export function jobCount(axis: SweepAxis): number {
  switch (axis.values.case) {
    case "list": return axis.values.value.values.length;
    case "seedCount": return axis.values.value;
    case "linear":
    case "logarithmic": return axis.values.value.count;
    default: return 0;
  }
}

export class SweepInput {
  readonly element: HTMLElement;
  private readonly field = h("select", { id: "axis-field" });
  private readonly values = h("input", { type: "text", id: "axis-values", autocomplete: "off", spellcheck: "false" });
  private readonly hint = h("div", { class: "limits" });

  constructor(changed: () => void) {
    this.field.addEventListener("change", () => {
      this.values.value = this.isSeed ? "seeds:5" : "";
      changed();
    });
    this.values.addEventListener("input", changed);
    this.values.value = "25, 50, 100, 200";
    this.element = h("div", { class: "fields sweep-input", hidden: true },
      h("div", { class: "field" }, h("label", { for: "axis-field" }, "Varied field"), this.field),
      h("div", { class: "field" }, h("label", { for: "axis-values" }, "Values"), this.values, this.hint));
  }

  private get isSeed(): boolean {
    return this.field.value.endsWith(".seed");
  }

  setPaths(paths: string[]): void {
    const chosen = this.field.value || "loading.speed_m_per_s";
    const numeric = paths.filter((path) => fieldAt(path).field.fieldKind === "scalar");
    replaceChildren(this.field, ...numeric.map((path) => {
      const unit = unitOf(path);
      return h("option", { value: path }, labelOf(path) + (unit ? ` (${unit})` : ""));
    }));
    this.field.value = numeric.includes(chosen) ? chosen : numeric[0];
  }

  /** The axis; undefined while the text describes none. */
  read(): SweepAxis | undefined {
    const axis = axisOf(this.field.value, this.values.value);
    const isAxis = typeof axis !== "string";
    setText(this.hint, isAxis ? "a list, first:last:count, first:last:count:log, or seeds:count" : axis);
    this.hint.parentElement!.dataset.kind = isAxis ? "" : "error";
    return isAxis ? axis : undefined;
  }
}
