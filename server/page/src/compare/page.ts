// Up to six jobs: their curves in one chart, their pictures at equal strain.
import { errorText, isNotFound } from "../api/clients";
import { idOf, pathOf } from "../dom/format";
import { Chart } from "../charts/chart";
import { Later } from "../dom/calls";
import { h, replaceChildren, setText } from "../dom/element";
import { iconButton } from "../dom/icons";
import { JobData } from "../job/job_data";
import { sceneWords, titleOf } from "../jobs/states";
import { FrameView } from "../picture/frame_view";
import { colourLegend } from "../picture/colours";
import { placeIn, Player } from "../picture/player";
import { PlayerBar } from "../picture/player_bar";
import { go, keepInUrl, type View } from "../router";
import { saveChartButton } from "../take_away/menus";
import { comparisonChart, comparisonTable } from "./side_by_side";
import { urlOf } from "../dom/base";

const kMostJobs = 6;
const kDrawMs = 200;
const kUrlMs = 400;

// One of the jobs with its picture.
class Compared {
  readonly element: HTMLElement;
  readonly frames: FrameView;
  private readonly title = h("a", {});
  private readonly about = h("span", { class: "faint" });
  private readonly place = h("span", { class: "faint figure" });

  constructor(readonly data: JobData, index: number, remove: () => void) {
    this.frames = new FrameView(data.frames, (frame) => frame.strain, `Job ${idOf(data.name)} as it is crushed`);
    this.title.href = pathOf(data.name);
    const swatch = h("i", { class: "swatch" });
    swatch.style.setProperty("--colour", `var(--series-${index})`);
    this.element = h("section", { class: "card compared" },
      h("div", { class: "compared-head" }, swatch, h("h2", {}, this.title), h("span", { class: "spacer" }), this.place,
        iconButton("minus", `Remove job ${idOf(data.name)}`, remove)),
      this.about, h("div", { class: "picture-box" }, this.frames.picture.element));
  }

  update(): void {
    const { job, error } = this.data;
    setText(this.title, `Job ${idOf(this.data.name)}: ${job ? titleOf(job) : ""}`);
    if (error) setText(this.about, isNotFound(error) ? "This job does not exist, or was deleted." : errorText(error));
    if (job?.words) setText(this.about, sceneWords(job.words));
  }

  showAt(strain: number, isMoving: boolean): void {
    this.frames.showAt(strain, isMoving);
    setText(this.place, this.frames.shown ? `strain ${this.frames.shown.strain.toFixed(2)}` : "");
  }

  destroy(): void {
    this.data.destroy();
    this.frames.destroy();
  }
}

export class ComparePage implements View {
  readonly title = "Comparison";
  readonly element = h("div", { class: "page compare" });
  private readonly player = new Player();
  private readonly chart = new Chart("Stress and strain", (x) => this.player.seek(x));
  private readonly numbers = h("div", {});
  private readonly all = h("input", { type: "checkbox", change: () => this.showNumbers() });
  private readonly bar: PlayerBar;
  private readonly jobs: Compared[];
  private readonly drawing = new Later(() => this.draw(), kDrawMs);
  private readonly url = new Later(() => {
    if (this.player.wanted === undefined) keepInUrl({ strain: String(Number(this.player.value.toFixed(4))) });
  }, kUrlMs);

  constructor(query: URLSearchParams) {
    const ids = [...new Set((query.get("jobs") ?? "").split(",").filter((id) => /^\d+$/.test(id)))].slice(0, kMostJobs);
    this.player.wanted = placeIn(query) ?? 0.4;
    this.jobs = ids.map((id, i) => new Compared(new JobData(`jobs/${id}`), i, () =>
      go(urlOf(`/compare?jobs=${ids.filter((other) => other !== id).join(",")}`))));
    this.bar = new PlayerBar(this.player, {
      neighbour: (direction) => this.neighbour(direction),
      text: (value) => `strain ${value.toFixed(3)}`,
      fit: () => this.jobs.forEach((job) => job.frames.picture.fit()),
    });
    this.build();
    for (const job of this.jobs) {
      job.data.jobChanges.add(() => this.update(job));
      job.data.sampleChanges.add(() => this.drawing.soon());
      job.data.frames.changes.add(() => this.drawing.soon());
    }
    this.player.changes.add(() => this.showPlace());
    document.addEventListener("keydown", this.key);
  }

  private build(): void {
    this.chart.addTools(saveChartButton(this.chart, () => "Comparison", "comparison"));
    replaceChildren(this.element,
      h("header", { class: "job-header" }, h("div", { class: "title-row" }, h("h1", {}, this.title),
        h("span", { class: "spacer" }), colourLegend())),
      this.jobs.length === 0 ? h("p", { class: "empty" }, "Select jobs to compare in the ",
        h("a", { href: urlOf("/") }, "list of jobs"), ".") : null,
      h("div", { hidden: this.jobs.length === 0 },
        h("div", { class: "card compare-player" }, this.bar.element),
        h("div", { class: "compared-grid", "data-count": this.jobs.length }, ...this.jobs.map((job) => job.element))),
      h("div", { class: "compare-below", hidden: this.jobs.length === 0 },
        h("section", { class: "card" }, this.chart.element),
        h("div", { class: "toolbar table-head" }, h("h2", {}, "What differs"), h("span", { class: "spacer" }),
          h("label", {}, this.all, " all fields")), this.numbers));
  }

  private readonly key = (event: KeyboardEvent): void => void this.bar.key(event);

  // The nearest of the next frames of all jobs.
  private neighbour(direction: 1 | -1): number {
    const { value } = this.player;
    const found = this.jobs.map((job) => job.frames.neighbour(value, direction))
      .filter((place) => (direction === 1 ? place > value + 1e-9 : place < value - 1e-9));
    if (!found.length) return value;
    return direction === 1 ? Math.min(...found) : Math.max(...found);
  }

  private update(job: Compared): void {
    job.update();
    this.showNumbers();
    this.drawing.soon();
  }

  private showNumbers(): void {
    replaceChildren(this.numbers, comparisonTable(this.jobs.map((compared) => compared.data), this.all.checked));
  }

  private draw(): void {
    const datas = this.jobs.map((job) => job.data);
    const ends = datas.map((data) => data.job?.case?.loading?.endStrain ?? 0.8);
    const end = Math.max(0.01, ...ends);
    const names = datas.map((data) => `job ${idOf(data.name)}`);
    this.chart.setData(comparisonChart(datas, names, end));
    this.player.fullEnd = end;
    const reached = Math.max(0, ...datas.map((data) => data.samples[data.samples.length - 1]?.strain ?? 0));
    this.player.setEnd(reached);
    this.showPlace();
  }

  private showPlace(): void {
    const { value, playing } = this.player;
    for (const job of this.jobs) job.showAt(value, playing);
    this.chart.setHead(value);
    if (playing) this.url.stop();
    else this.url.afresh();
  }

  destroy(): void {
    document.removeEventListener("keydown", this.key);
    this.drawing.stop();
    this.url.stop();
    this.player.destroy();
    this.chart.destroy();
    for (const job of this.jobs) job.destroy();
  }
}
