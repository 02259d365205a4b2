// The form of a case: groups of fields that read and write the message, and what else the case has.
import { create } from "@bufbuild/protobuf";
import { LatticeSchema, type Case } from "../../gen/cellcrush/v1/case_pb";
import type { Problem } from "../../gen/cellcrush/v1/problem_pb";
import { h, labelled, replaceChildren, setText } from "../dom/element";
import { iconButton } from "../dom/icons";
import { FieldInput } from "./field_input";
import { groupsOf, isListed, isNumber, isTable, kLatticeKinds, linesOf, pathsBeside, readField, writeField, type Group,
         type LatticeKind } from "./fields";
import { kNamed, NamedMaterials } from "./named_materials";
import { defaultOf, fieldHelp, helpOf, labelOf } from "./words";

export class CaseForm {
  readonly element = h("div", { class: "case-form" });
  /** Paths whose text is no value. */
  readonly unreadable = new Set<string>();
  private inputs = new Map<string, FieldInput>();
  private beside = new Map<string, HTMLElement>(); // where their problems are told
  private readonly title = h("input", { type: "text", maxlength: 200, autocomplete: "off" });
  private readonly kinds = kLatticeKinds.filter((kind) => !isListed(kind));
  private readonly kind = h("select", {}, ...this.kinds.map(({ name }) =>
    h("option", { value: name }, fieldHelp("Lattice", name).replace(/\.$/, "") || name)));
  private materials = new NamedMaterials([]);
  private readonly about = h("div", { class: "about-material", "aria-live": "polite" });
  private value!: Case;

  constructor(private readonly on: { changed(): void; focused(path: string): void }) {
    this.title.addEventListener("input", () => {
      this.value.title = this.title.value || undefined;
      on.changed();
    });
    this.kind.addEventListener("change", () => {
      this.changeKind(this.kinds[this.kind.selectedIndex]);
      this.build();
      on.changed();
    });
  }

  /** Shows a case, which the form then changes, and the materials that it may name. */
  setCase(value: Case, materials: NamedMaterials): void {
    this.value = value;
    this.materials = materials;
    this.title.value = value.title ?? "";
    this.build();
  }

  /** The fields of the form that the axis of a sweep may have. */
  get paths(): string[] {
    return [...this.inputs.keys()].filter(isNumber);
  }

  private build(): void {
    this.inputs = new Map();
    this.unreadable.clear();
    const known = kLatticeKinds.find(({ localName }) => localName === this.value.lattice?.kind.case);
    const isNewer = !known && this.value.lattice?.$unknown !== undefined;
    const kind = known ?? this.kinds[0];
    this.kind.value = kind.name;
    const groups = groupsOf(kind).map((group) => this.groupOf({ ...group, paths: group.paths.filter((path) =>
      !isNewer || !path.startsWith(`lattice.${kind.name}.`)) }));
    const beside = pathsBeside(this.value, [...this.inputs.keys()]);
    this.beside = new Map(beside.map((path) => [path, h("div", { class: "bad" })]));
    replaceChildren(this.element,
      labelled("Title", this.title), !isListed(kind) && !isNewer && labelled("Cells", this.kind),
      isNewer && h("p", { class: "banner warning" }, "The lattice is one of a newer server, and stays as it is."),
      beside.length > 0 && h("dl", { class: "facts beside" }, ...beside.map((path) => this.rowBeside(path))),
      ...groups);
    this.inputs.get(kNamed)!.element.after(this.about);
    this.showMaterial();
  }

  // What has no field is kept as it is, or removed.
  private rowBeside(path: string): HTMLElement {
    const label = labelOf(path);
    const remove = iconButton("minus", `Remove: ${label}`, () => {
      writeField(this.value, path, "");
      (row.parentElement?.childElementCount === 1 ? row.parentElement : row).remove();
      this.beside.delete(path);
      this.on.changed();
    });
    const lines = linesOf(this.value, path).map((line) => h("div", {}, line));
    const row = h("div", { title: helpOf(path) }, h("dt", {}, label),
      h("dd", {}, h("div", {}, ...lines, this.beside.get(path)), defaultOf(path) !== "required" && remove));
    return row;
  }

  private groupOf({ title, paths, isOpen }: Group): HTMLElement {
    const fields = h("div", { class: "fields" }, ...paths.map((path) => this.inputOf(path).element));
    const isDefault = (path: string): boolean => ["", defaultOf(path).split(" ")[0]].includes(
      readField(this.value, path));
    return h("details", { open: isOpen || !paths.every(isDefault) }, h("summary", {}, title), fields);
  }

  private inputOf(path: string): FieldInput {
    const input = new FieldInput(path, {
      changed: (text) => this.take(path, input, text),
      focused: (focused) => this.on.focused(focused),
    }, path === kNamed ? this.materials.choicesOf(this.value) : undefined);
    input.text = readField(this.value, path);
    this.inputs.set(path, input);
    return input;
  }

  private take(path: string, input: FieldInput, text: string): void {
    const isPick = path === kNamed && !this.materials.isEmpty;
    if (isPick) this.materials.pick(this.value, text);
    const isValue = isPick || writeField(this.value, path, text);
    if (isValue) this.unreadable.delete(path);
    else this.unreadable.add(path);
    if (isValue) input.showProblem(undefined);
    else input.showUnreadable();
    if (isPick) this.showMaterial();
    else if (isTable(path)) this.showWithRows(path);
    this.on.changed();
  }

  // The fields of the material, and what its name gives them.
  private showMaterial(): void {
    const named = this.materials.of(this.value);
    for (const [path, input] of this.inputs) {
      if (!path.startsWith("material.")) continue;
      const given = this.materials.givenAt(this.value, path);
      input.text = readField(this.value, path);
      input.given = given;
      this.unreadable.delete(path);
      if (given) input.element.closest("details")!.open = true;
    }
    for (const path of this.inputs.keys()) if (isTable(path)) this.showWithRows(path);
    this.about.hidden = this.materials.isEmpty;
    replaceChildren(this.about, named && h("strong", {}, `${named.title}. `), named?.sources.join(" "),
      !this.value.material?.named && "Without a name, the numbers are those of the fields.");
  }

  // What a table has beside its rows counts with them only.
  private showWithRows(table: string): void {
    const hasRows = readField(this.value, table) !== "";
    for (const [path, input] of this.inputs) {
      if (!path.startsWith(`${table}.`)) continue;
      input.isDisabled = !hasRows;
      if (hasRows) writeField(this.value, path, input.text);
    }
  }

  // Keeps the fields of the same names.
  private changeKind(kind: LatticeKind): void {
    const lattice = (this.value.lattice ??= create(LatticeSchema));
    const old = lattice.kind.value as Record<string, unknown> | undefined;
    const kept = kind.message.fields.map(({ localName }) => [localName, old?.[localName]]);
    const value = create(kind.message, Object.fromEntries(kept));
    lattice.kind = { case: kind.localName, value } as unknown as typeof lattice.kind;
  }

  /** Shows problems at what they are about; returns those that the form does not have. */
  showProblems(problems: Problem[]): Problem[] {
    const ofPath = (path: string, { field }: Problem): boolean => field === path || field.startsWith(`${path}.`)
      || field.startsWith(`${path}[`);
    for (const [path, input] of this.inputs) {
      if (this.unreadable.has(path)) continue;
      const problem = problems.find((each) => ofPath(path, each));
      input.showProblem(problem);
      if (problem) input.element.closest("details")!.open = true;
    }
    for (const [path, line] of this.beside) {
      const found = problems.filter((problem) => ofPath(path, problem));
      setText(line, found.map(({ field, message, remedy }) =>
        `${field.slice(path.length).replace(".", "")} ${message} ${remedy}`).join(" "));
    }
    const shown = [...this.inputs.keys(), ...this.beside.keys()];
    return problems.filter((problem) => !shown.some((path) => ofPath(path, problem)));
  }
}
