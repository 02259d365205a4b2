// One field of the form: label, input, unit, and a line that holds its limits or its problem.
import type { Problem } from "../../gen/cellcrush/v1/problem_pb";
import { Problem_Kind } from "../../gen/cellcrush/v1/problem_pb";
import { h, labelled, setText } from "../dom/element";
import { plural } from "../dom/format";
import { fieldAt, isNumber, isTable, typedAt } from "./fields";
import type { Given } from "./named_materials";
import { columnsOf, rowsOf } from "./table_text";
import { shortest } from "./typed_number";
import { choicesOf, defaultOf, helpOf, labelOf, limitsOf, placeIn, unitOf } from "./words";

/** Shows below an input of a form what it may be, or why its text is no value. */
export function showHint(hint: HTMLElement, text: string, isValue: boolean): void {
  setText(hint, text);
  hint.parentElement!.dataset.kind = isValue ? "" : "error";
}

export class FieldInput {
  readonly element: HTMLElement;
  private readonly input: HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;
  private readonly line = h("div", { class: "limits" });
  private origin: Given | undefined;

  constructor(private readonly path: string, on: { changed(text: string): void; focused(path: string): void },
              choices = choicesOf(path)) {
    const asTyped = { autocomplete: "off", spellcheck: "false", placeholder: defaultOf(path) };
    if (choices.length) {
      this.input = h("select", {}, h("option", { value: "" }, `default: ${defaultOf(path)
        .toLowerCase().replaceAll("_", " ")}`),
        ...choices.map((choice) => h("option", { value: choice.value, title: choice.help }, choice.label)));
    } else if (isTable(path)) {
      this.input = h("textarea", { rows: 4, ...asTyped });
    } else {
      this.input = h("input", { type: "text", inputmode: isNumber(path) ? "decimal" : "text", ...asTyped });
    }
    this.input.addEventListener("input", () => on.changed(this.input.value));
    this.input.addEventListener("focus", () => on.focused(path));
    this.element = labelled(labelOf(path), this.input, this.line, unitOf(path));
    this.element.firstElementChild!.setAttribute("title", helpOf(path));
    this.showProblem(undefined);
  }

  get text(): string {
    return this.input.value;
  }

  set text(text: string) {
    this.input.value = text;
  }

  set isDisabled(isDisabled: boolean) {
    this.input.disabled = isDisabled;
  }

  /** What stands for an empty text, in place of the default. */
  set given(given: Given | undefined) {
    this.origin = given;
    if ("placeholder" in this.input) this.input.placeholder = given?.text ?? defaultOf(this.path);
    this.showProblem(undefined);
  }

  showUnreadable(): void {
    const text = this.text.trim();
    const problem = typedAt(this.path, text)?.problem;
    this.show("error", isTable(this.path) ? problem ?? "" : `“${text}” ${problem ?? "is out of range"}.`);
  }

  private get limits(): string {
    if (!this.origin) return limitsOf(this.path);
    const { by, text } = this.origin;
    const isOwn = this.text.trim() !== "";
    return limitsOf(this.path, !isOwn ? `From ${by}` : `${by} has ${isTable(this.path) ? "another table" : text}`);
  }

  // A number as it was read, where it is not written so; of a table, how far its rows go.
  private get reading(): string {
    const text = this.text.trim();
    if (isTable(this.path)) {
      const rows = rowsOf(text, columnsOf(fieldAt(this.path).field).length);
      return text && typeof rows !== "string" ? `${plural(rows.length, "row")} to ${rows.at(-1)!.join(", ")}` : "";
    }
    const plain = text && typedAt(this.path, text)?.plain;
    const shown = plain && shortest(plain);
    return shown && shown !== text ? `= ${shown} ${unitOf(this.path)}`.trim() : "";
  }

  showProblem(problem: Problem | undefined): void {
    if (!problem) return this.show("", [this.reading, this.limits].filter(Boolean).join(" · "));
    const message = `${placeIn(this.path, problem.field)} ${problem.message} ${problem.remedy}`.trim();
    this.show(problem.kind === Problem_Kind.IMPLAUSIBLE ? "warning" : "error",
              message.charAt(0).toUpperCase() + message.slice(1));
  }

  private show(kind: string, text: string): void {
    setText(this.line, text);
    this.line.title = text;
    this.element.dataset.kind = kind;
    this.input.setAttribute("aria-invalid", String(kind === "error"));
  }
}
