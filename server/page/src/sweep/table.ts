// The table of a sweep: one row per job, with links, and the same as CSV.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { Columns, type Column } from "../dom/columns";
import { clock, fullTime, given, idOf, milliseconds, number, pathOf, type Unit } from "../dom/format";
import { button, h, replaceChildren, type Child } from "../dom/element";
import { kFirstMeasures, kMeasures, measureText, titleOfMeasure, unitFor, type Measure } from "../job/measures";
import { progressBar } from "../jobs/progress_bar";
import { hasEnded, setChip, stateChip, tookText } from "../jobs/states";
import { csvBlob } from "../take_away/menus";
import { axisName } from "./points";

const kRowsAtFirst = 300;
const kImpact = "plateau_stress_impact_mpa";

type Row = SweepTable_Row;
interface TableColumn extends Column<Row> { cell(row: Row): Child }

const startOf = ({ result }: Row): number | undefined => result?.startTime && milliseconds(result.startTime);

function stateCell({ result }: Row): Child {
  const chip = stateChip();
  setChip(chip, result?.state ?? Job_State.JOB_STATE_UNSPECIFIED);
  chip.title = result?.causeMessage ?? "";
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
  readonly element = h("div", { class: "table-scroll" });
  private readonly columns = new Columns<Row>("sweep", () => this.show());
  /** The menu of the columns. */
  readonly menu = this.columns.menu;
  private readonly body = h("tbody");
  private readonly all = button("", () => {
    this.showsAll = true;
    this.show();
  }, { class: "quiet", hidden: true });
  private rows: Row[] = [];
  private fields: string[] = [];
  private showsAll = false;

  constructor() {
    this.element.append(h("table", { class: "rows" }, h("thead", {}, this.columns.head), this.body), this.all);
  }

  update(rows: Row[], fields: string[]): void {
    this.rows = rows;
    this.fields = fields;
    this.show();
  }

  private show(): void {
    const { rows, columns } = this;
    columns.set(columnsOf(rows, this.fields));
    const shown = columns.sorted(rows).slice(0, this.showsAll ? undefined : kRowsAtFirst);
    const cells = columns.shown as TableColumn[];
    replaceChildren(this.body, ...shown.map((row) =>
      h("tr", {}, ...cells.map(({ figure, cell }) => h("td", { class: figure ? "figure" : "" }, cell(row))))));
    this.all.hidden = shown.length === rows.length;
    this.all.textContent = `All ${rows.length} rows`;
  }

  csv(): Blob {
    const measures = kMeasures.filter(({ field }) => kFirstMeasures.includes(field));
    return csvBlob([...this.fields, "job", "state", ...measures.map(({ field }) => field)],
      this.rows.map(({ values, job, result }) =>
        [...values, job, result ? Job_State[result.state] : "",
         ...measures.map(({ value }) => result?.summary && value(result.summary))]));
  }
}
