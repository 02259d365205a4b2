// Note, labels and priority of a new job or sweep.
import { h, labelled } from "../dom/element";
import { showHint } from "./field_input";

/** The labels that a text such as "series=a, batch=2" gives, or what is wrong with the text. */
export function labelsOf(text: string): Record<string, string> | string {
  const labels: Record<string, string> = {};
  for (const part of text.split(",").map((each) => each.trim()).filter(Boolean)) {
    const at = part.indexOf("=");
    if (at < 1) return `“${part}” is not key=value.`;
    const key = part.slice(0, at).trim();
    if (key in labels) return `The key “${key}” is given twice.`;
    labels[key] = part.slice(at + 1).trim();
  }
  return labels;
}

export interface Order { note: string; labels: Record<string, string>; priority: number }

export class OrderInput {
  readonly element: HTMLElement;
  private readonly note = h("input", { type: "text", autocomplete: "off" });
  private readonly labels = h("input", { type: "text", autocomplete: "off", spellcheck: "false",
                                         placeholder: "series=a, batch=2" });
  private readonly priority = h("input", { type: "number", min: -100, max: 100, step: 1, value: 0 });
  private readonly labelsHint = h("div", { class: "limits" });
  private readonly priorityHint = h("div", { class: "limits" });

  constructor(changed: () => void) {
    for (const input of [this.note, this.labels, this.priority]) input.addEventListener("input", changed);
    this.element = h("details", { class: "order" }, h("summary", {}, "Note, labels and priority"),
      h("div", { class: "fields" }, labelled("Note", this.note, h("div", { class: "limits" },
        "shown below the title; can be changed later")), labelled("Labels", this.labels, this.labelsHint),
        labelled("Priority", this.priority, this.priorityHint)));
    this.read();
  }

  /** Undefined while a text cannot be read. */
  read(): Order | undefined {
    const labels = labelsOf(this.labels.value);
    const areLabels = typeof labels !== "string";
    showHint(this.labelsHint, areLabels ? "key=value, to filter the job list" : labels, areLabels);
    const priority = Number(this.priority.value);
    const isPriority = Number.isInteger(priority) && Math.abs(priority) <= 100;
    showHint(this.priorityHint, isPriority ? "-100 to 100; higher starts first." : "A whole number, -100 to 100.",
             isPriority);
    return areLabels && isPriority ? { note: this.note.value.trim(), labels, priority } : undefined;
  }
}
