// A test of the reader's own, laid over the curve of the job: files that are chosen, or dropped on the curves.
import type { CompareTestResponse, CompareTestResponse_Numbers } from "../../gen/cellcrush/v1/jobs_service_pb";
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";
import { api, errorText } from "../api/clients";
import { Chart } from "../charts/chart";
import type { ChartData, Series } from "../charts/chart_data";
import { acceptDrops } from "../dom/drops";
import { h, labelled, replaceChildren, setBanner } from "../dom/element";
import { number, percent, unitBySize } from "../dom/format";

const kMostBytes = 3_900_000;

/** Rigid walls, grips and watched nodes, as CompareTestRequest.force_part names them. */
function partsOf(sample: Sample | undefined): string[] {
  const held = [...sample?.grips.map(({ grip }) => grip) ?? [], ...sample?.watched.map(({ node }) => node) ?? []];
  return [...sample?.rigidWalls.map(({ wall }) => wall) ?? [], ...held.flatMap((id) => [`${id}.x`, `${id}.y`])];
}

function chartOf(answer: CompareTestResponse, names: string[]): ChartData {
  const { isForce, x, measuredMean, measuredLeast, measuredMost, computedY } = answer;
  const values = [...measuredLeast, ...measuredMost, ...computedY];
  const [low, high] = values.reduce(([least, most], y) => [Math.min(least, y), Math.max(most, y)], [0, 0]);
  const unit = unitBySize(isForce ? "N" : "MPa", Math.max(high, -low));
  const isBand = names.length > 1;
  const series: Series[] = [
    { label: isBand ? `mean of ${names.length} tests` : names[0], colour: "ink", width: 2 },
    ...isBand ? [0, 1].map((): Series => ({ label: "", colour: "ink-2", width: 0.8, quiet: true })) : [],
    { label: "computed", colour: "support", width: 2 },
  ];
  const columns = [measuredMean, ...isBand ? [measuredLeast, measuredMost] : [], computedY];
  const room = 0.06 * (high - low || 1);
  return {
    series, columns: [x, ...columns.map((column) => column.map((y) => y * unit.factor))],
    xLabel: isForce ? "displacement (mm)" : "nominal strain",
    yLabel: `${isForce ? "force" : "nominal stress"} (${unit.name})`, xEnd: answer.to,
    yLow: low < 0 ? (low - room) * unit.factor : undefined, yTop: (high + room) * unit.factor,
  };
}

type Quantity = Exclude<keyof CompareTestResponse_Numbers, `$${string}`>;

function tableOf(answer: CompareTestResponse): HTMLElement {
  const [along, across] = answer.isForce ? [" mm", "N"] : ["", "MPa"];
  const rows: [string, Quantity][] = [
    [`elastic slope, ${across}${answer.isForce ? "/mm" : ""}`, "slope"], [`first peak, ${across}`, "peak"],
    [answer.isForce ? "displacement of the first peak, mm" : "strain of the first peak", "peakAt"],
    [`mean from ${number(answer.windowLow)} to ${number(answer.windowHigh)}${along}, ${across}`, "mean"],
    [`energy to ${number(answer.energyTo)}${along}, ${answer.isForce ? "mJ" : "mJ/mm³"}`, "energy"]];
  const cells = (value: number | undefined): string => value === undefined ? "–" : number(value);
  const row = (name: string, ...values: string[]): HTMLElement =>
    h("tr", {}, h("th", { scope: "row" }, name), ...values.map((value) => h("td", {}, value)));
  return h("table", { class: "own-test" },
    h("tr", {}, h("td", {}), ...["measured", "computed", "difference"].map((name) => h("th", { scope: "col" }, name))),
    ...rows.map(([name, field]) => {
      const [measured, computed] = [answer.measured?.[field], answer.computed?.[field]];
      const difference = measured && computed !== undefined ? computed / measured - 1 : undefined;
      return row(name, cells(measured), cells(computed),
                 difference === undefined ? "–" : `${difference < 0 ? "−" : "+"}${percent(Math.abs(difference))}`);
    }),
    row(`greatest difference, ${across}`, "", "",
        `${number(answer.greatestDifference)} at ${number(answer.greatestDifferenceAt)}${along}`),
    row(`rms difference, ${across}`, "", "", number(answer.rmsDifference)));
}

export class OwnTest {
  readonly element: HTMLElement;
  private readonly choice = h("input", { type: "file", multiple: true, accept: ".csv,.txt,.tsv",
                                         "aria-label": "Test" });
  private readonly columns = h("input", { type: "text", autocomplete: "off", placeholder: "as its header tells" });
  private readonly force = h("select", {});
  private readonly displacement = h("select", {});
  private readonly parts = h("div", { class: "fields", hidden: true }, labelled("Force of", this.force),
    labelled("over the displacement of", this.displacement));
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private readonly chart = new Chart("Test and computed curve", () => undefined);
  private readonly numbers = h("div", { "aria-live": "polite" });
  private files: File[] = [];
  private abort = new AbortController();

  constructor(private readonly job: string, private readonly hasPlates: () => boolean) {
    this.choice.addEventListener("change", () => this.take([...this.choice.files ?? []]));
    for (const input of [this.columns, this.force, this.displacement]) {
      input.addEventListener("change", () => void this.compare());
    }
    this.chart.element.hidden = true;
    this.element = h("details", { class: "drawing-input" }, h("summary", {}, "Lay a test over it"),
      h("p", { class: "faint" }, "Drop a CSV file of your own test on the curves, or choose it; several are repeats. " +
        "The header names columns and units, of strain or displacement and of stress or force."),
      this.choice,
      h("div", { class: "fields" }, labelled("Columns in order, such as: -, displacement mm, force N", this.columns)),
      this.parts, this.problem, this.chart.element, this.numbers);
  }

  acceptDrops(target: HTMLElement): void {
    acceptDrops(target, (files) => this.take(files));
  }

  /** The parts whose forces the samples have. */
  offer(sample: Sample | undefined): void {
    const parts = partsOf(sample);
    if (this.force.options.length > 0 || parts.length === 0) return;
    const options = (first: string): HTMLOptionElement[] =>
      [h("option", { value: "" }, first), ...parts.map((part) => h("option", { value: part }, part))];
    replaceChildren(this.force, ...options(this.hasPlates() ? "the support plate, as stress" : "…"));
    replaceChildren(this.displacement, ...options("the same"));
    this.parts.hidden = false;
  }

  private take(files: File[]): void {
    if (files.length === 0) return;
    this.files = files;
    (this.element as HTMLDetailsElement).open = true;
    void this.compare();
  }

  private async compare(): Promise<void> {
    if (this.files.length === 0) return;
    this.abort.abort();
    const abort = (this.abort = new AbortController());
    this.chart.element.hidden = true;
    replaceChildren(this.numbers);
    if (this.files.reduce((bytes, { size }) => bytes + size, 0) > kMostBytes) {
      return setBanner(this.problem, "The files are larger than 3.9 MB. Leave out rows, or columns that do not count.");
    }
    if (!this.hasPlates() && this.force.value === "") {
      return setBanner(this.problem, "Choose the part whose force was measured.");
    }
    try {
      const tests = await Promise.all(this.files.map(async (file) => ({ name: file.name, text: await file.text() })));
      const answer = await api.jobs.compareTest({
        name: this.job, tests, columns: this.columns.value.trim(), forcePart: this.force.value,
        displacementPart: this.force.value ? this.displacement.value : "",
      }, { signal: abort.signal });
      if (abort.signal.aborted) return;
      setBanner(this.problem, "");
      this.chart.element.hidden = false;
      this.chart.setData(chartOf(answer, this.files.map(({ name }) => name)));
      replaceChildren(this.numbers, tableOf(answer));
    } catch (error) {
      if (!abort.signal.aborted) setBanner(this.problem, errorText(error));
    }
  }

  destroy(): void {
    this.abort.abort();
    this.chart.destroy();
  }
}
