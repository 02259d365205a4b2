// The executor of a new job or sweep, where the daemon has several.
import { api } from "../api/clients";
import { h, replaceChildren } from "../dom/element";

export class ExecutorInput {
  readonly element: HTMLElement;
  private readonly choice = h("select", { id: "executor" });

  constructor(changed: () => void) {
    this.choice.addEventListener("change", changed);
    this.element = h("div", { class: "field executor", hidden: true },
      h("label", { for: "executor" }, "Executor"), this.choice);
    void this.load();
  }

  // Without an answer the daemon decides.
  private async load(): Promise<void> {
    try {
      const { executors, defaultExecutor } = await api.admin.getCapabilities({});
      replaceChildren(this.choice, ...executors.map(({ name }) => h("option", { value: name }, name)));
      this.choice.value = defaultExecutor;
      this.element.hidden = executors.length < 2;
    } catch {
      this.element.hidden = true;
    }
  }

  /** Name of the chosen executor; empty for the daemon's default. */
  get value(): string {
    return this.element.hidden ? "" : this.choice.value;
  }
}
