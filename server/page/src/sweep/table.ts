// The table of a sweep: one row per job; with links.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { SweepTable_Row, SweepTable_SeedMeans } from "../../gen/cellcrush/v1/sweep_pb";
import { clock, fullTime, given, idOf, milliseconds, number, pathOf, type Unit } from "../dom/format";
import { h, printable, type Child } from "../dom/element";
import { keep, kept } from "../dom/preferences";
import { TableView, type CellColumn } from "../dom/table_view";
import { kFirstMeasures, kMeasures, measureText, titleOfMeasure, unitFor, type Measure } from "../job/measures";
import { progressBar } from "../jobs/progress_bar";
import { hasEnded, setChip, stateChip, tookText } from "../jobs/states";
import { axisName } from "./points";
import { meanColumns } from "./seed_means";
import type { LoadedSweep } from "./sweep_data";

const kEachSeed = "sweep-each-seed";
const kImpact = "plateau_stress_impact_mpa";

type Row = SweepTable_Row;
type TableColumn = CellColumn<Row>;
/** `means` are those over the seeds, if the sweep varies them. */
export type TableData = Pick<LoadedSweep, "rows" | "fields" | "means">;

const startOf = ({ result }: Row): number | undefined => result?.startTime && milliseconds(result.startTime);

function stateCell({ result }: Row): Child {
  const chip = stateChip();
  setChip(chip, result?.state ?? Job_State.JOB_STATE_UNSPECIFIED);
  chip.title = printable(result?.causeMessage ?? "");
  return h("div", { class: "state-cell" }, chip, result && !hasEnded(result) && result.progress && progressBar(result));
}

function ofMeasure(measure: Measure, rows: Row[]): TableColumn {
  const numberOf = ({ result }: Row): number | undefined => {
    if (result?.summary) return measure.value(result.summary);
    return measure.field === kImpact ? result?.progress?.plateauSoFarMpa : undefined;
  };
  const unit: Unit = unitFor(measure, rows.map(numberOf));
  const cell = (row: Row): Child => {
    const { summary } = row.result ?? {};
    if (summary) return measureText(measure, summary, unit);
    const soFar = numberOf(row);
    return soFar !== undefined && h("span", { class: "so-far", title: "so far" }, number(soFar * unit.factor));
  };
  return { key: measure.field, name: titleOfMeasure(measure, unit), figure: true, value: numberOf, cell,
           shown: kFirstMeasures.includes(measure.field) };
}

function columnsOf(rows: Row[], fields: string[]): TableColumn[] {
  const job = ({ result }: Row): Job | undefined => result;
  return [
    ...fields.map((field, i): TableColumn => ({ key: field, name: axisName(field), figure: true, shown: "always",
      value: (row) => row.values[i], cell: (row) => given(row.values[i]) })),
    { key: "job", name: "Job", shown: "always", value: (row) => Number(idOf(row.job)),
      cell: (row) => h("a", { href: pathOf(row.job) }, `job ${idOf(row.job)}`) },
    { key: "state", name: "State", shown: "always", value: (row) => job(row)?.state, cell: stateCell },
    ...kMeasures.map((measure) => ofMeasure(measure, rows)),
    { key: "started", name: "Started", figure: true, shown: false, value: startOf,
      cell: (row) => h("span", { title: fullTime(job(row)?.startTime) }, clock(job(row)?.startTime)) },
    { key: "took", name: "Time", figure: true, shown: false, value: startOf,
      cell: (row) => row.result && hasEnded(row.result) && tookText(row.result) },
  ];
}

export class SweepTableView {
  private readonly jobs = new TableView<Row>("sweep");
  private readonly means = new TableView<SweepTable_SeedMeans>("sweep-means");
  private readonly eachSeed = h("input", { type: "checkbox", change: () => {
    keep(kEachSeed, this.eachSeed.checked);
    this.show();
  } });
  private readonly choice = h("label", { hidden: true }, this.eachSeed, " each seed");
  readonly element = h("div", {}, this.means.element, this.jobs.element);
  /** What the table shows: jobs or means, and the menus of the columns. */
  readonly menu = h("span", { class: "table-menu" }, this.choice, this.means.menu, this.jobs.menu);
  private data: TableData = { rows: [], fields: [], means: [] };

  constructor() {
    this.eachSeed.checked = kept(kEachSeed, false);
  }

  update(data: TableData): void {
    this.data = data;
    this.show();
  }

  private show(): void {
    const { rows, fields, means } = this.data;
    const areMeans = means.length > 0 && !this.eachSeed.checked;
    this.choice.hidden = means.length === 0;
    this.means.element.hidden = this.means.menu.hidden = !areMeans;
    this.jobs.element.hidden = this.jobs.menu.hidden = areMeans;
    if (areMeans) this.means.update(means, meanColumns(this.data));
    else this.jobs.update(rows, columnsOf(rows, fields));
  }
}
