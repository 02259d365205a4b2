// The table of a sweep: one row per job, with links.
import { Job_State } from "../../gen/cellcrush/v1/job_pb";
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { idOf, pathOf } from "../dom/format";
import { button, h, replaceChildren } from "../dom/element";
import { kSummaryNumbers, summaryText } from "../job/results";
import { setChip, stateChip } from "../jobs/states";
import { axisName } from "./points";

const kRowsAtFirst = 300;

export class SweepTableView {
  readonly element = h("div", { class: "table-scroll" });
  private rows: SweepTable_Row[] = [];
  private fields: string[] = [];
  private showsAll = false;

  update(rows: SweepTable_Row[], fields: string[]): void {
    this.rows = rows;
    this.fields = fields;
    const shown = this.showsAll ? rows : rows.slice(0, kRowsAtFirst);
    const head = [...fields.map(axisName), "Job", "State", ...kSummaryNumbers.map((column) => column.name)];
    const jobPlace = fields.length;
    replaceChildren(this.element, h("table", { class: "rows" },
      h("thead", {}, h("tr", {}, ...head.map((text, i) =>
        h("th", { scope: "col", class: i === jobPlace || i === jobPlace + 1 ? "" : "figure" }, text)))),
      h("tbody", {}, ...shown.map((row) => this.rowOf(row)))));
    if (shown.length < rows.length) {
      this.element.append(button(`All ${rows.length} rows`, () => {
        this.showsAll = true;
        this.update(this.rows, this.fields);
      }, { class: "quiet" }));
    }
  }

  private rowOf(row: SweepTable_Row): HTMLElement {
    const chip = stateChip();
    setChip(chip, row.result?.state ?? Job_State.JOB_STATE_UNSPECIFIED);
    chip.title = row.result?.causeMessage ?? "";
    const { summary } = row.result ?? {};
    return h("tr", {}, ...row.values.map((value) => h("td", { class: "figure" }, Number(value.toPrecision(6)))),
      h("td", {}, h("a", { href: pathOf(row.job) }, `job ${idOf(row.job)}`)), h("td", {}, chip),
      ...kSummaryNumbers.map((column) => h("td", { class: "figure" }, summary && summaryText(column, summary))));
  }
}
