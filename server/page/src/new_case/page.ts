// A new case: from a preset or another job, checked while it is typed, then started as a job or as a sweep.
import { clone, create } from "@bufbuild/protobuf";
import { CaseSchema, LatticeSchema, type Case, type Lattice_Network } from "../../gen/cellcrush/v1/case_pb";
import type { CheckCaseResponse } from "../../gen/cellcrush/v1/cases_service_pb";
import { SweepSchema, type Sweep, type SweepAxis } from "../../gen/cellcrush/v1/sweep_pb";
import { whyNot } from "../api/caller";
import { api, errorText, ifAny, problemsOf } from "../api/clients";
import { Later } from "../dom/calls";
import { h, labelled, replaceChildren, setBanner, setText } from "../dom/element";
import { duration, idOf, pathOf, plural } from "../dom/format";
import { go, keepInUrl, type View } from "../router";
import { DrawingInput } from "./drawing_input";
import { OrderInput } from "./order";
import { Forecast } from "./forecast";
import { CaseForm } from "./form";
import { NamedMaterials } from "./named_materials";
import { Preview } from "./preview";
import { jobCount, SweepInput } from "./sweep_axis";
import { helpOf, labelOf } from "./words";

const kFirstPreset = "hexagon-small";
const kTypingMs = 300;

// The executor of a new job or sweep, where the daemon has several.
class ExecutorInput {
  private readonly choice = h("select");
  readonly element = labelled("Executor", this.choice);

  constructor(changed: () => void) {
    this.choice.addEventListener("change", changed);
    this.element.hidden = true;
    void this.load();
  }

  // Without an answer the daemon decides.
  private async load(): Promise<void> {
    const capabilities = await ifAny(api.admin.getCapabilities({}));
    if (!capabilities) return;
    const { executors, defaultExecutor } = capabilities;
    replaceChildren(this.choice, ...executors.map(({ name }) => h("option", { value: name }, name)));
    this.choice.value = defaultExecutor;
    this.element.hidden = executors.length < 2;
  }

  /** Name of the chosen executor; empty for the daemon's default. */
  get value(): string {
    return this.element.hidden ? "" : this.choice.value;
  }
}

export class NewCasePage implements View {
  readonly title = "New case";
  readonly element = h("div", { class: "page new-case" });
  private readonly source = h("select", { "aria-label": "Start from" });
  private readonly about = h("p", { class: "faint about" });
  private readonly form = new CaseForm({ changed: () => this.checkSoon(), focused: (path) => this.showHelp(path) });
  private readonly preview = new Preview();
  private readonly forecast = new Forecast();
  private readonly help = h("p", { class: "faint" }, "Choose a field to read what it means.");
  private readonly sweepInput = new SweepInput(() => this.checkSoon());
  private readonly executor = new ExecutorInput(() => this.checkSoon());
  private readonly drawing = new DrawingInput((network, title) => this.setNetwork(network, title));
  private readonly order = new OrderInput(() => this.checkSoon());
  private readonly asJob = h("input", { type: "radio", name: "as", id: "as-job", checked: true });
  private readonly asSweep = h("input", { type: "radio", name: "as", id: "as-sweep" });
  private readonly start = h("button", { type: "submit", class: "primary", disabled: true }, "Start the job");
  private readonly cost = h("span", { class: "faint" });
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private readonly materials = ifAny(api.cases.listMaterials({})).then((answer) => answer?.materials ?? []);
  private value: Case = create(CaseSchema);
  private check: CheckCaseResponse | undefined;
  private abort = new AbortController();
  private readonly checking = new Later(() => void this.runCheck(), kTypingMs);
  private readonly requestId = crypto.randomUUID?.() ?? `page-${Date.now()}-${Math.random()}`;

  constructor(query: URLSearchParams) {
    for (const radio of [this.asJob, this.asSweep]) radio.addEventListener("change", () => {
      this.sweepInput.element.hidden = !this.asSweep.checked;
      this.checkSoon();
    });
    this.source.addEventListener("change", () => {
      keepInUrl({ from: this.source.value });
      void this.load(this.source.value);
    });
    const submit = (event: Event): void => {
      event.preventDefault();
      void this.submit();
    };
    replaceChildren(this.element,
      h("header", { class: "job-header" }, h("div", { class: "title-row" }, h("h1", {}, "New case"),
        h("label", { class: "faint" }, "from ", this.source)), this.about),
      h("form", { class: "new-grid", submit, novalidate: true },
        h("div", { class: "column" }, h("section", { class: "card" }, this.drawing.element, this.form.element)),
        h("div", { class: "column side" }, this.preview.element, this.forecast.element,
          h("section", { class: "card" },
            h("div", { class: "as-what" }, h("label", {}, this.asJob, " one job"),
              h("label", {}, this.asSweep, " a sweep")),
            this.sweepInput.element, this.executor.element, this.order.element, this.problem,
            h("div", { class: "start-row" }, this.start, this.cost)),
          h("section", { class: "card help-card" }, h("h2", {}, "The field"), this.help))));
    this.drawing.acceptDrops(this.element);
    const from = query.get("from") ?? `preset:${kFirstPreset}`;
    void this.listSources(from);
    void this.load(from);
  }

  private async listSources(from: string): Promise<void> {
    try {
      const { presets } = await api.cases.listPresets({});
      const options = presets.map((preset) => h("option", { value: `preset:${preset.name}`, title: preset.title },
                                                preset.name));
      replaceChildren(this.source, from.startsWith("jobs/") && h("option", { value: from }, `job ${idOf(from)}`),
                      ...options);
      this.source.value = from;
    } catch (error) {
      setBanner(this.problem, errorText(error));
    }
  }

  private async load(from: string): Promise<void> {
    try {
      if (from.startsWith("jobs/")) {
        const job = await api.jobs.getJob({ name: from });
        setText(this.about, `The case of job ${idOf(from)}`);
        await this.setCase(job.case);
      } else {
        const preset = await api.cases.getPreset({ name: from.replace("preset:", "") });
        setText(this.about, preset.title);
        this.about.title = preset.assumptions.join(" ");
        await this.setCase(preset.case);
      }
    } catch (error) {
      setBanner(this.problem, errorText(error));
    }
  }

  private async setCase(value: Case | undefined): Promise<void> {
    const materials = new NamedMaterials(await this.materials);
    this.value = clone(CaseSchema, value ?? create(CaseSchema));
    this.form.setCase(this.value, materials);
    this.sweepInput.setPaths(this.form.paths);
    void this.runCheck();
  }

  // In place of the lattice, with what only that had; all else stays.
  private setNetwork(network: Lattice_Network, title: string): void {
    const value = clone(CaseSchema, this.value);
    value.lattice ??= create(LatticeSchema);
    value.lattice.kind = { case: "network", value: network };
    value.lattice.inclusions = undefined;
    value.title = title;
    setText(this.about, "");
    void this.setCase(value);
  }

  private showHelp(path: string): void {
    replaceChildren(this.help, h("strong", {}, `${labelOf(path)}. `), helpOf(path));
  }

  private checkSoon(): void {
    this.start.disabled = true;
    this.checking.afresh();
  }

  private async runCheck(): Promise<void> {
    this.abort.abort();
    const abort = (this.abort = new AbortController());
    this.sweepInput.setPaths(this.form.paths);
    try {
      const check = await api.cases.checkCase({ case: this.value }, { signal: abort.signal });
      if (abort.signal.aborted) return;
      this.check = check;
      const isValid = check.problems.length === 0;
      const unplaced = this.form.showProblems(isValid ? check.notes : check.problems);
      this.forecast.show(check, unplaced);
      setBanner(this.problem, "");
      // Walls of a list that overlap can be drawn, where they do.
      const isListed = this.value.lattice?.kind.case === "network";
      if (isValid || isListed) void this.preview.show(this.value, Number(check.elementCount));
      await this.updateStart(abort.signal);
    } catch (error) {
      if (abort.signal.aborted) return;
      this.start.disabled = true;
      setBanner(this.problem, errorText(error));
    }
  }

  private get canStart(): boolean {
    return whyNot() === "" && this.check?.problems.length === 0 && this.form.unreadable.size === 0 &&
      this.order.read() !== undefined;
  }

  private async updateStart(signal: AbortSignal): Promise<void> {
    const axes = this.asSweep.checked ? this.sweepInput.read() : undefined;
    setBanner(this.problem, whyNot());
    if (!this.asSweep.checked) {
      setText(this.start, "Start the job");
      setText(this.cost, this.canStart ? `about ${duration(this.check?.predictedSeconds)} on one core` : "");
      this.start.disabled = !this.canStart;
      return;
    }
    setText(this.start, axes ? `Start ${plural(jobCount(axes), "job")}` : "Start the sweep");
    setText(this.cost, "");
    this.start.disabled = true;
    if (!axes || !this.canStart) return;
    const sweep = await api.sweeps.createSweep({ sweep: this.sweepOf(axes), validateOnly: true }, { signal });
    setText(this.cost, `about ${duration(sweep.predictedSeconds)} on one core`);
    this.start.disabled = false;
  }

  private sweepOf(axes: SweepAxis[]): Sweep {
    return create(SweepSchema, { case: this.value, axes, executor: this.executor.value, ...this.order.read() });
  }

  private async submit(): Promise<void> {
    if (this.start.disabled) return;
    this.start.disabled = true;
    const axes = this.asSweep.checked ? this.sweepInput.read() : undefined;
    const order = this.order.read();
    const executor = this.executor.value;
    const requestId = `${this.requestId}-${hashOf(this.value, axes, order, executor)}`;
    try {
      const created = axes ? await api.sweeps.createSweep({ sweep: this.sweepOf(axes), requestId })
        : await api.jobs.createJob({ case: this.value, requestId, executor, ...order });
      go(pathOf(created.name));
    } catch (error) {
      const problems = problemsOf(error);
      setBanner(this.problem, problems.length ? problems.map((p) => `${p.field} ${p.message} ${p.remedy}`).join(" ")
        : errorText(error));
      this.start.disabled = false;
    }
  }

  destroy(): void {
    this.checking.stop();
    this.abort.abort();
    this.drawing.destroy();
    this.preview.destroy();
  }
}

// Part of the request's id: a second click with the same case starts no second job.
function hashOf(...values: unknown[]): string {
  const text = JSON.stringify(values, (_, part) => (typeof part === "bigint" ? `${part}` : part));
  let hash = 5381;
  for (let i = 0; i < text.length; ++i) hash = ((hash * 33) ^ text.charCodeAt(i)) >>> 0;
  return hash.toString(36);
}
