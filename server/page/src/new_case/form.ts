// The form of a case: groups of fields that read and write the message.
import type { Case } from "../../gen/cellcrush/v1/case_pb";
import { create } from "@bufbuild/protobuf";
import { LatticeSchema } from "../../gen/cellcrush/v1/case_pb";
import type { Problem } from "../../gen/cellcrush/v1/problem_pb";
import { h, replaceChildren } from "../dom/element";
import { FieldInput } from "./field_input";
import { groupsOf, kLatticeKinds, readField, writeField, type LatticeKind } from "./fields";

export class CaseForm {
  readonly element = h("div", { class: "case-form" });
  /** Paths whose text is no value. */
  readonly unreadable = new Set<string>();
  private inputs = new Map<string, FieldInput>();
  private readonly title = h("input", { type: "text", id: "case-title", maxlength: 200, autocomplete: "off" });
  private readonly kind = h("select", { id: "case-kind" }, ...kLatticeKinds.map((kind) =>
    h("option", { value: kind.localName }, `${kind.name.replaceAll("_", " ")}s`)));
  private value!: Case;

  constructor(private readonly on: { changed(): void; focused(path: string): void }) {
    this.title.addEventListener("input", () => {
      this.value.title = this.title.value || undefined;
      on.changed();
    });
    this.kind.addEventListener("change", () => {
      this.changeKind(kLatticeKinds[this.kind.selectedIndex]);
      this.build();
      on.changed();
    });
  }

  /** Shows a case, which the form then changes. */
  setCase(value: Case): void {
    this.value = value;
    this.title.value = value.title ?? "";
    this.build();
  }

  /** The numeric fields of the form, for the axis of a sweep. */
  get paths(): string[] {
    return [...this.inputs.keys()];
  }

  private build(): void {
    this.inputs = new Map();
    this.unreadable.clear();
    const kind = kLatticeKinds.find(({ localName }) => localName === this.value.lattice?.kind.case);
    const isOwnGeometry = this.value.lattice && !kind; // a frame, or a lattice of a newer server
    if (kind) this.kind.value = kind.localName;
    const groups = groupsOf(kind ?? kLatticeKinds[0]).filter((group) =>
      !isOwnGeometry || !["Lattice", "Crush", "Imperfection"].includes(group.title));
    replaceChildren(this.element,
      h("div", { class: "field wide" }, h("label", { for: "case-title" }, "Title"), this.title),
      isOwnGeometry ? h("p", { class: "banner warning" },
        "This form does not show the lattice of this case. Its geometry, loads and motions stay as they are.")
        : h("div", { class: "field wide" }, h("label", { for: "case-kind" }, "Cells"), this.kind),
      ...groups.map((group) => this.groupOf(group.title, group.paths, group.isOpen)));
  }

  private groupOf(title: string, paths: string[], isOpen: boolean): HTMLElement {
    const fields = h("div", { class: "fields" }, ...paths.map((path) => this.inputOf(path).element));
    const isGiven = paths.some((path) => readField(this.value, path) !== "");
    return h("details", { open: isOpen || (isGiven && title === "Imperfection") }, h("summary", {}, title), fields);
  }

  private inputOf(path: string): FieldInput {
    const input = new FieldInput(path, {
      changed: (text) => this.take(path, input, text),
      focused: (focused) => this.on.focused(focused),
    });
    input.text = readField(this.value, path);
    this.inputs.set(path, input);
    return input;
  }

  private take(path: string, input: FieldInput, text: string): void {
    const isValue = writeField(this.value, path, text);
    if (isValue) this.unreadable.delete(path);
    else this.unreadable.add(path);
    input.showProblem(undefined);
    input.showUnreadable(!isValue);
    this.on.changed();
  }

  // Keeps the sizes, which all regular lattices have.
  private changeKind(kind: LatticeKind): void {
    const old = this.value.lattice?.kind;
    const { columns, rows, sideMm, wallThicknessMm } = old?.case && old.case !== "frame" ? old.value
      : { columns: 20, rows: 10, sideMm: 4, wallThicknessMm: 0.3 };
    const value = create(kind.message, { columns, rows, sideMm, wallThicknessMm });
    this.value.lattice ??= create(LatticeSchema);
    this.value.lattice.kind = { case: kind.localName, value } as unknown as typeof this.value.lattice.kind;
    this.value.lattice.inclusions = undefined;
  }

  /** Shows problems at their fields; returns those without a field of the form. */
  showProblems(problems: Problem[]): Problem[] {
    const byPath = new Map(problems.map((problem) => [problem.field, problem]));
    for (const [path, input] of this.inputs) {
      if (this.unreadable.has(path)) continue;
      input.showProblem(byPath.get(path));
      if (byPath.has(path)) input.element.closest("details")!.open = true;
    }
    return problems.filter((problem) => !this.inputs.has(problem.field));
  }
}
