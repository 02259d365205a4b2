// The table of a sweep: one row per job, with links, and the same as CSV.
import { Job_State } from "../../gen/cellcrush/v1/job_pb";
import type { Summary } from "../../gen/cellcrush/v1/sample_pb";
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { idOf, pathOf } from "../api/names";
import { csvBlob } from "../dom/download";
import { button, h, replaceChildren } from "../dom/element";
import { number, percent, strainText } from "../dom/format";
import { setChip, stateChip } from "../jobs/states";
import { axisName } from "./points";

interface Column { name: string; field: string; text(s: Summary): string; value(s: Summary): number | undefined }

const kColumns: Column[] = [
  { name: "Impact plateau, MPa", field: "plateau_stress_impact_mpa", text: (s) => number(s.plateauStressImpactMpa),
    value: (s) => s.plateauStressImpactMpa },
  { name: "Support plateau, MPa", field: "plateau_stress_support_mpa", text: (s) => number(s.plateauStressSupportMpa),
    value: (s) => s.plateauStressSupportMpa },
  { name: "Shock theory (Eq. 51), MPa", field: "theory.shock_mpa", text: (s) => number(s.theory?.shockMpa),
    value: (s) => s.theory?.shockMpa },
  { name: "Densification strain", field: "densification_strain",
    text: (s) => (s.densificationStrain === undefined ? "–" : strainText(s.densificationStrain)),
    value: (s) => s.densificationStrain },
  { name: "Absorbed energy, J", field: "absorbed_energy_mj", text: (s) => number(s.absorbedEnergyMj / 1000),
    value: (s) => s.absorbedEnergyMj },
  { name: "Ledger error", field: "energy_error_relative", text: (s) => percent(s.energyErrorRelative),
    value: (s) => s.energyErrorRelative },
];
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
    const head = [...fields.map(axisName), "Job", "State", ...kColumns.map((column) => column.name)];
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
      ...kColumns.map((column) => h("td", { class: "figure" }, summary ? column.text(summary) : "")));
  }

  csv(): Blob {
    return csvBlob([...this.fields, "job", "state", ...kColumns.map((column) => column.field)],
      this.rows.map((row) => [...row.values, row.job, row.result ? Job_State[row.result.state] : "",
                              ...kColumns.map((column) => row.result?.summary && column.value(row.result.summary))]));
  }
}
