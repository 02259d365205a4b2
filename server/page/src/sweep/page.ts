// The page of a sweep: plateau stresses against the varied field, filling in as jobs end.
import { Job_State } from "../../gen/cellcrush/v1/job_pb";
import { api, errorText, isNotFound } from "../api/clients";
import { allowed } from "../api/caller";
import { get } from "../api/token";
import { watch } from "../api/watch";
import { kEndStrain } from "../charts/curves";
import { Chart } from "../charts/chart";
import { ask } from "../dom/dialog";
import { button, h, replaceChildren, setBanner, setText } from "../dom/element";
import { clock, idOf, plural } from "../dom/format";
import { icon, type IconName } from "../dom/icons";
import { kMeasures } from "../job/measures";
import { attempt } from "../jobs/actions";
import { NoteEditor } from "../jobs/note";
import { hasEnded, hasStrain, kStates, stateBar, stateWord, titleOfSweep, variedFields } from "../jobs/states";
import { placeIn } from "../picture/player";
import { go, keepInUrl, setTitle, type View } from "../router";
import { download, saveButton, saveChartButton } from "../take_away/menus";
import { CrushGrid } from "./crush_grid";
import { axisName, isSeed, sweepChart } from "./points";
import { SweepOverlay } from "./overlay";
import { SweepData } from "./sweep_data";
import { SweepMap } from "./sweep_map";
import { SweepTableView } from "./table";
import { urlOf } from "../dom/base";


export class SweepPage implements View {
  title: string;
  readonly element = h("div", { class: "page sweep-page" });
  private readonly heading = h("h1");
  private readonly about = h("p", { class: "faint about" });
  private readonly note = new NoteEditor(async (note, previousNote) => {
    await api.sweeps.updateSweep({ sweep: { name: this.name, note }, updateMask: { paths: ["note"] }, previousNote });
    await this.data.load();
  });
  private readonly states = h("div", { class: "sweep-states" });
  private readonly actions = h("div", { class: "buttons" });
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private readonly chart = new Chart("Plateau stress");
  private readonly axisChoice = h("select", { "aria-label": "Field of the axis" });
  private readonly measureChoice = h("select", { "aria-label": "Measure of the chart" },
    h("option", { value: "" }, "Plateau stress"),
    ...kMeasures.map(({ field, words }) => h("option", { value: field }, words)));
  private readonly map = new SweepMap();
  private readonly table = new SweepTableView();
  private readonly stops: (() => void)[];
  private readonly overlay: SweepOverlay;
  private readonly crushes: CrushGrid;
  private readonly data: SweepData;

  constructor(private readonly name: string, query: URLSearchParams) {
    this.data = new SweepData(name);
    this.overlay = new SweepOverlay(name, (query.get("with") ?? "").split(","));
    this.crushes = new CrushGrid(placeIn(query));
    this.title = `Sweep ${idOf(name)}`;
    for (const choice of [this.axisChoice, this.measureChoice]) choice.addEventListener("change", () => this.draw());
    this.chart.addTools(this.measureChoice, this.axisChoice,
                        saveChartButton(this.chart, () => this.title, `sweep-${idOf(name)}`));
    replaceChildren(this.element,
      h("header", { class: "job-header" },
        h("div", { class: "title-row" }, this.heading, h("span", { class: "spacer" }), this.actions),
        this.note.element, this.about, this.states),
      this.problem, h("section", { class: "card" }, this.chart.element, this.overlay.element),
      this.map.element, this.crushes.element,
      h("div", { class: "toolbar table-head" }, h("h2", {}, "Jobs"), h("span", { class: "spacer" }), this.table.menu,
        h("span", { class: "take-away" }, saveButton("CSV", "Save the table as a CSV file", async () =>
          download(await (await get(urlOf(`/sweeps/${idOf(name)}.csv`))).blob(), `sweep-${idOf(name)}.csv`)))),
      this.table.element);
    this.stops = [
      this.overlay.changes.add(() => {
        keepInUrl({ with: this.overlay.ids.join(",") });
        this.draw();
      }),
      this.data.changes.add(() => this.update()),
      watch.deletedSweeps.add((deleted) => {
        if (deleted === this.name) setBanner(this.problem, "This sweep was deleted.");
      }),
    ];
  }

  private update(): void {
    const { error } = this.data;
    const isGone = isNotFound(error);
    setBanner(this.problem, !error ? "" : isGone ? `${this.title} does not exist, or was deleted.` : errorText(error));
    this.showHead();
    this.draw();
  }

  private showHead(): void {
    const { sweep, fields } = this.data;
    if (!sweep) return;
    this.title = titleOfSweep(sweep);
    setText(this.heading, this.title);
    setTitle(this.title);
    this.note.update(sweep.note, sweep.owner);
    setText(this.about, [`Sweep ${idOf(sweep.name)} over ${variedFields(sweep).join(", ")}`,
      plural(sweep.jobs.length, "job"), sweep.words?.lattice ?? "",
      `created ${clock(sweep.createTime)}${sweep.owner ? ` by ${sweep.owner}` : ""}`].filter(Boolean).join(", "));
    const places = fields.map((_, i) => i).filter((i) => !isSeed(fields[i]));
    if (!places.length) places.push(0);
    if (this.axisChoice.options.length !== places.length) {
      replaceChildren(this.axisChoice, ...places.map((i) => h("option", { value: i }, axisName(fields[i]))));
    }
    this.axisChoice.hidden = places.length < 2;
  }

  private draw(): void {
    const { sweep, rows, fields, means } = this.data;
    if (!sweep) return;
    const path = fields[Number(this.axisChoice.value) || 0] ?? "";
    this.overlay.setPath(path);
    const others = this.overlay.swept;
    const label = others.length ? this.overlay.labelOf(sweep) : "";
    const measure = kMeasures.find(({ field }) => field === this.measureChoice.value);
    const data = sweepChart([{ label, rows, fields, means }, ...others], path, measure);
    this.chart.setTitle(measure?.words ?? "Plateau stress");
    const note = measure ? "" : sweep.words?.theoryNote;
    this.chart.setData(note ? { ...data, note: `${data.note}. ${note}` } : data);
    this.map.update(this.data, measure ?? kMeasures[0]);
    this.table.update(this.data);
    const { loading } = sweep.case ?? {};
    this.crushes.update(hasStrain(sweep.words) ? rows : [], fields, loading?.endStrain ?? kEndStrain);
    const counts: Record<string, number> = {};
    for (const row of rows) {
      const name = Job_State[row.result?.state ?? 0];
      counts[name] = (counts[name] ?? 0) + 1;
    }
    const words = kStates.filter((state) => counts[Job_State[state]])
      .map((state) => `${counts[Job_State[state]]} ${stateWord(state)}`);
    replaceChildren(this.states, stateBar(counts), h("span", { class: "faint" }, words.join(" · ")));
    this.showActions(counts[Job_State[Job_State.FAILED]] ?? 0);
  }

  private showActions(failed: number): void {
    const { rows } = this.data;
    const isOver = rows.every((row) => row.result && hasEnded(row.result));
    const action = (name: IconName, label: string, run: () => Promise<void>, attributes = {}): HTMLElement => {
      const element = button("", () => void attempt(run), attributes);
      element.append(icon(name), label);
      return element;
    };
    const { name } = this;
    const may = allowed(this.data.sweep?.owner);
    replaceChildren(this.actions,
      rows.length > 0 && action("fork", "New case from this one", async () => go(urlOf(`/new?from=${rows[0].job}`))),
      failed > 0 && action("retry", `Retry ${plural(failed, "failed job")}`, async () => {
        await api.sweeps.retryFailedJobs({ name });
        await this.data.load();
      }, may),
      !isOver && action("stop", "Cancel", async () => {
        if (!await ask(`Cancel sweep ${idOf(name)}?`, "Every job that has not ended stops. Results so far are kept.",
                       "Cancel the sweep")) return;
        await api.sweeps.cancelSweep({ name });
        await this.data.load();
      }, { class: "danger-quiet", ...may }),
      isOver && action("trash", "Delete", async () => {
        const detail = `Its ${plural(rows.length, "job")} disappear with their results. This cannot be undone.`;
        if (!await ask(`Delete sweep ${idOf(name)}?`, detail, "Delete the sweep")) return;
        await api.sweeps.deleteSweep({ name });
        go(urlOf("/"));
      }, { class: "danger-quiet", ...may }));
  }

  destroy(): void {
    this.data.destroy();
    this.overlay.destroy();
    this.crushes.destroy();
    for (const stop of this.stops) stop();
    this.map.destroy();
    this.chart.destroy();
  }
}
