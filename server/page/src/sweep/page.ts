// The page of a sweep: plateau stresses against the varied field, filling in as jobs end.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sweep, SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { api, errorText, ifAny, isNotFound } from "../api/clients";
import { get } from "../api/token";
import { watch } from "../api/watch";
import { Chart } from "../charts/chart";
import { Later } from "../dom/calls";
import { ask } from "../dom/dialog";
import { button, h, replaceChildren, setBanner, setText } from "../dom/element";
import { clock, idOf, plural } from "../dom/format";
import { icon, type IconName } from "../dom/icons";
import { attempt } from "../jobs/actions";
import { hasEnded, kStates, stateBar, stateWord, titleOfSweep, variedFields } from "../jobs/states";
import { placeIn } from "../picture/player";
import { go, keepInUrl, setTitle, type View } from "../router";
import { download, saveButton, saveChartButton } from "../take_away/menus";
import { CrushGrid } from "./crush_grid";
import { axisName, isSeed, sweepChart } from "./points";
import { loadSweep, SweepOverlay } from "./overlay";
import { SweepTableView } from "./table";

const kDrawMs = 300;
const kEndStrain = 0.8; // the default

export class SweepPage implements View {
  title: string;
  readonly element = h("div", { class: "page sweep-page" });
  private readonly heading = h("h1");
  private readonly about = h("p", { class: "faint about" });
  private readonly states = h("div", { class: "sweep-states" });
  private readonly actions = h("div", { class: "buttons" });
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private readonly chart = new Chart("Plateau stress");
  private readonly axisChoice = h("select", { "aria-label": "Field of the axis" });
  private readonly table = new SweepTableView();
  private readonly stops: (() => void)[];
  private readonly overlay: SweepOverlay;
  private readonly crushes: CrushGrid;
  private sweep: Sweep | undefined;
  private rows: SweepTable_Row[] = [];
  private fields: string[] = [];
  private readonly drawing = new Later(() => this.draw(), kDrawMs);
  private readonly abort = new AbortController();

  constructor(private readonly name: string, query: URLSearchParams) {
    this.overlay = new SweepOverlay(name, (query.get("with") ?? "").split(","));
    this.crushes = new CrushGrid(placeIn(query));
    this.title = `Sweep ${idOf(name)}`;
    this.axisChoice.addEventListener("change", () => this.draw());
    this.chart.addTools(this.axisChoice, saveChartButton(this.chart, () => this.title, `sweep-${idOf(name)}`));
    replaceChildren(this.element,
      h("header", { class: "job-header" },
        h("div", { class: "title-row" }, this.heading, h("span", { class: "spacer" }), this.actions), this.about,
        this.states),
      this.problem, h("section", { class: "card" }, this.chart.element, this.overlay.element), this.crushes.element,
      h("div", { class: "toolbar table-head" }, h("h2", {}, "Jobs"), h("span", { class: "spacer" }),
        h("span", { class: "take-away" }, saveButton("CSV", "Save the table as a CSV file", async () =>
          download(await (await get(`/sweeps/${idOf(name)}.csv`)).blob(), `sweep-${idOf(name)}.csv`)))),
      this.table.element);
    this.stops = [
      this.overlay.changes.add(() => {
        keepInUrl({ with: this.overlay.ids.join(",") });
        this.draw();
      }),
      watch.jobs.add((job) => this.takeJob(job)),
      watch.sweeps.add((sweep) => {
        if (sweep.name === this.name) void this.load();
      }),
      watch.deletedSweeps.add((deleted) => {
        if (deleted === this.name) setBanner(this.problem, "This sweep was deleted.");
      }),
      watch.freshStarts.add(() => void this.load()),
    ];
    void this.load();
  }

  private async load(): Promise<void> {
    try {
      const { sweep, rows, fields } = await loadSweep(this.name, this.abort.signal);
      this.sweep = sweep;
      this.rows = rows;
      this.fields = fields;
      setBanner(this.problem, "");
      this.showHead();
      this.draw();
    } catch (error) {
      if (this.abort.signal.aborted) return;
      setBanner(this.problem, isNotFound(error) ? `${this.title} does not exist, or was deleted.` : errorText(error));
    }
  }

  private takeJob(job: Job): void {
    const row = this.rows.find((candidate) => candidate.job === job.name);
    if (!row) return;
    row.result = job;
    if (job.state === Job_State.SUCCEEDED && !job.summary) void this.completeRow(row);
    this.drawing.soon();
  }

  private async completeRow(row: SweepTable_Row): Promise<void> {
    row.result = await ifAny(api.jobs.getJob({ name: row.job })) ?? row.result;
    this.drawing.soon();
  }

  private showHead(): void {
    const { sweep } = this;
    if (!sweep) return;
    this.title = titleOfSweep(sweep);
    setText(this.heading, this.title);
    setTitle(this.title);
    setText(this.about, [`Sweep ${idOf(sweep.name)} over ${variedFields(sweep).join(", ")}`,
      plural(sweep.jobs.length, "job"), sweep.words?.lattice ?? "",
      `created ${clock(sweep.createTime)}${sweep.owner ? ` by ${sweep.owner}` : ""}`].filter(Boolean).join(", "));
    const places = this.fields.map((_, i) => i).filter((i) => !isSeed(this.fields[i]));
    if (!places.length) places.push(0);
    if (this.axisChoice.options.length !== places.length) {
      replaceChildren(this.axisChoice, ...places.map((i) => h("option", { value: i }, axisName(this.fields[i]))));
    }
    this.axisChoice.hidden = places.length < 2;
  }

  private draw(): void {
    if (!this.sweep) return;
    const path = this.fields[Number(this.axisChoice.value) || 0] ?? "";
    this.overlay.setPath(path);
    const others = this.overlay.swept;
    const label = others.length ? this.overlay.labelOf(this.sweep) : "";
    const data = sweepChart([{ label, rows: this.rows, fields: this.fields }, ...others], path);
    const note = this.sweep?.words?.theoryNote;
    this.chart.setData(note ? { ...data, note: `${data.note}. ${note}` } : data);
    this.table.update(this.rows, this.fields);
    const { loading } = this.sweep.case ?? {};
    const isCrush = this.sweep.words?.plates ?? true;
    this.crushes.update(isCrush ? this.rows : [], this.fields, loading?.endStrain ?? kEndStrain);
    const counts: Record<string, number> = {};
    for (const row of this.rows) {
      const name = Job_State[row.result?.state ?? 0];
      counts[name] = (counts[name] ?? 0) + 1;
    }
    const words = kStates.filter((state) => counts[Job_State[state]])
      .map((state) => `${counts[Job_State[state]]} ${stateWord(state)}`);
    replaceChildren(this.states, stateBar(counts), h("span", { class: "faint" }, words.join(" · ")));
    this.showActions(counts[Job_State[Job_State.FAILED]] ?? 0);
  }

  private showActions(failed: number): void {
    const isOver = this.rows.every((row) => row.result && hasEnded(row.result));
    const action = (name: IconName, label: string, run: () => Promise<void>, attributes = {}): HTMLElement => {
      const element = button("", () => void attempt(run), attributes);
      element.append(icon(name), label);
      return element;
    };
    const { name } = this;
    replaceChildren(this.actions,
      this.rows.length > 0 && action("fork", "New case from this one", async () => go(`/new?from=${this.rows[0].job}`)),
      failed > 0 && action("retry", `Retry ${plural(failed, "failed job")}`, async () => {
        await api.sweeps.retryFailedJobs({ name });
        await this.load();
      }),
      !isOver && action("stop", "Cancel", async () => {
        if (!await ask(`Cancel sweep ${idOf(name)}?`, "Every job that has not ended stops. Results so far are kept.",
                       "Cancel the sweep")) return;
        await api.sweeps.cancelSweep({ name });
        await this.load();
      }, { class: "danger-quiet" }),
      isOver && action("trash", "Delete", async () => {
        const detail = `Its ${plural(this.rows.length, "job")} disappear with their results. This cannot be undone.`;
        if (!await ask(`Delete sweep ${idOf(name)}?`, detail, "Delete the sweep")) return;
        await api.sweeps.deleteSweep({ name });
        go("/");
      }, { class: "danger-quiet" }));
  }

  destroy(): void {
    this.abort.abort();
    this.overlay.destroy();
    this.crushes.destroy();
    this.drawing.stop();
    for (const stop of this.stops) stop();
    this.chart.destroy();
  }
}
