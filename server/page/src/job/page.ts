// The page of a job: the crush, its curves and its numbers, with one cursor through all.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sample, Summary, Theory } from "../../gen/cellcrush/v1/sample_pb";
import { errorText, isAway, isNotFound } from "../api/clients";
import { isExported } from "../api/exported";
import { idOf } from "../dom/format";
import { Chart } from "../charts/chart";
import { kEndStrain, strainAxis, timeAxis, type Axis } from "../charts/curves";
import { energyChart } from "../charts/energy";
import { kSampleColumns, sampleChart, wordsOfColumn } from "../charts/sample_chart";
import type { ChartData } from "../charts/chart_data";
import { closedBands, forceChart, stressChart } from "../charts/stress";
import { Later } from "../dom/calls";
import { h, replaceChildren, setBanner, setText } from "../dom/element";
import { QueuePanel } from "../jobs/queue";
import { hasEnded, isOverTime, sceneWords, titleOf, warningWords } from "../jobs/states";
import { JobStore } from "../jobs/store";
import { FrameView } from "../picture/frame_view";
import { colourLegend } from "../picture/colours";
import { placeIn, Player } from "../picture/player";
import { PlayerBar } from "../picture/player_bar";
import { RigidWalls } from "../picture/rigid_walls";
import { keepInUrl, setTitle, type View } from "../router";
import { addSaving, takeAwayOfPicture } from "../take_away/menus";
import { brokenWalls } from "./broken_walls";
import { JobHeader } from "./header";
import { JobData } from "./job_data";
import { OwnTest } from "./own_test";
import { resultsList } from "./results";
import { urlOf } from "../dom/base";

const kCurvesMs = 200; // at most five updates of the curves in a second
const kUrlMs = 400;

export class JobPage implements View {
  title: string;
  readonly element = h("div", { class: "page job-page" });
  private readonly data: JobData;
  private readonly store: JobStore;
  private readonly header: JobHeader;
  private readonly queue = new QueuePanel(() => this.update());
  private readonly player = new Player();
  private readonly rigidWalls: RigidWalls;
  private readonly frames: FrameView;
  private readonly bar: PlayerBar;
  private readonly stress = new Chart("Stress and strain", (x) => this.player.seek(x));
  private readonly energy = new Chart("Energy ledger", (x) => this.player.seek(x));
  // What the second chart has: the ledger, or a number of the samples.
  private readonly below = h("select", { "aria-label": "Measure of the chart", change: () => this.updateCurves() },
    h("option", { value: "" }, "Energy ledger"),
    ...kSampleColumns.map(({ name }) => h("option", { value: name }, wordsOfColumn(name))));
  private readonly ownTest: OwnTest;
  private readonly waiting = h("p", { class: "picture-note" }, "Loading the frames…");
  private readonly numbers = h("section", { class: "card", hidden: true });
  private readonly facts = h("section", { class: "card", hidden: true });
  private readonly modelled = h("section", { class: "card modelled", hidden: true });
  private readonly warnings = h("div", { class: "warnings" });
  private readonly broken = h("p", { class: "faint caption", hidden: true });
  private readonly thinned = h("p", { class: "faint caption", hidden: true });
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private readonly grid = h("div", { class: "job-grid" });
  private axis: Axis = strainAxis(0.8);
  private readonly curves = new Later(() => this.updateCurves(), kCurvesMs);
  private readonly url = new Later(() => this.keepUrl(), kUrlMs);
  private detailsKey = "";
  private wasLive = false;
  private isShown = false;
  private shownState = Job_State.JOB_STATE_UNSPECIFIED;

  constructor(name: string, query: URLSearchParams) {
    this.title = `Job ${idOf(name)}`;
    this.data = new JobData(name);
    this.store = new JobStore(() => false);
    this.header = new JobHeader(this.store);
    this.ownTest = new OwnTest(name, () => {
      const { words } = this.data.job ?? {};
      return words === undefined || words.plates || words.rigidWallPlates;
    });
    this.rigidWalls = new RigidWalls(this.data);
    this.frames = new FrameView(this.data.frames, (frame) => this.axis.frame(frame), "The lattice as it is crushed",
                                (time) => this.rigidWalls.at(time));
    this.frames.picture.camera.text = query.get("view") ?? "";
    this.player.wanted = placeIn(query);
    this.bar = new PlayerBar(this.player, {
      neighbour: (direction) => this.frames.neighbour(this.player.value, direction),
      text: (value) => this.axis.text(value),
      fit: () => this.frames.picture.fit(),
    });
    this.build();
    this.listen();
  }

  private build(): void {
    const { picture } = this.frames;
    picture.element.append(this.waiting);
    addSaving(this.stress, this.data, "stress");
    this.energy.addTools(this.below);
    addSaving(this.energy, this.data, "energy");
    replaceChildren(this.element, this.header.element, this.problem, this.warnings,
      this.grid);
    const curves = h("section", { class: "card" }, this.stress.element, this.energy.element);
    replaceChildren(this.grid,
      h("div", { class: "column" },
        h("section", { class: "card" },
          h("div", { class: "picture-head" }, colourLegend(), h("span", { class: "spacer" }),
            takeAwayOfPicture(picture, this.player, this.data)),
          this.bar.element, h("div", { class: "picture-box" }, picture.element), this.broken,
          this.thinned),
        this.numbers, this.facts),
      h("div", { class: "column" },
        curves, this.modelled));
    if (!isExported) {
      curves.append(this.ownTest.element);
      this.ownTest.acceptDrops(curves);
    }
  }

  private listen(): void {
    this.data.jobChanges.add(() => this.update());
    this.data.sampleChanges.add(() => this.curves.soon());
    this.data.frames.changes.add(() => this.updateFrames());
    this.player.changes.add(() => this.showPlace());
    this.frames.picture.moved.add(() => this.url.afresh());
    // The actions of the header change the job through the store.
    this.store.changes.add(() => {
      const job = this.store.jobs.get(this.data.name);
      if (job && job !== this.data.job) this.data.putJob(job);
    });
    document.addEventListener("keydown", this.key);
  }

  private readonly key = (event: KeyboardEvent): void => {
    const { picture } = this.frames;
    if (this.bar.key(event) || !(event.target as Element).matches("canvas, body")) return;
    if (event.key === "+" || event.key === "=") picture.zoomBy(1.5);
    else if (event.key === "-") picture.zoomBy(1 / 1.5);
  };

  private update(): void {
    const { job, error } = this.data;
    this.problem.hidden = !error;
    if (error) this.showError(error);
    if (!job) return;
    this.store.jobs.set(job.name, job);
    this.header.update(job, this.queue.entries.get(job.name));
    this.title = titleOf(job);
    setTitle(this.title);
    this.followState(job);
    this.updateDetails(job);
    if (job.state === Job_State.PENDING && this.shownState !== job.state) this.queue.refresh();
    this.shownState = job.state;
  }

  private showError(error: unknown): void {
    replaceChildren(this.problem, isNotFound(error) ? `${this.title} does not exist, or was deleted. ` : "",
      isNotFound(error) ? h("a", { href: urlOf("/") }, "All jobs") : errorText(error),
      isAway(error) ? " The page tries again." : "");
    this.header.element.hidden = this.grid.hidden = isNotFound(error);
  }

  private followState(job: Job): void {
    const { lattice, loading } = job.case ?? {};
    const walls = lattice?.kind.value;
    const ofWalls = walls && "endTimeS" in walls ? walls.endTimeS : undefined;
    if (!isOverTime(job)) this.setAxis(strainAxis(loading?.endStrain ?? this.reachedStrain(job)));
    else this.setAxis(timeAxis(loading?.endTimeS ?? ofWalls ?? 1));
    const isLive = !hasEnded(job);
    if (isLive && !this.wasLive && this.player.wanted === undefined) this.player.follow();
    // An ended crush opens half way, where there is something to see.
    if (!isLive && !this.isShown) this.player.wanted ??= 0.5 * this.axis.end;
    this.isShown = true;
    this.wasLive ||= isLive;
    this.bar.setLive(isLive);
    this.waiting.textContent = hasEnded(job) ? "This job has no frames." : "The first frame comes when the job runs.";
  }

  // Of rigid walls in place of plates, whose case has no end strain.
  private reachedStrain(job: Job): number {
    const last = this.data.samples[this.data.samples.length - 1];
    return job.words?.rigidWallPlates && hasEnded(job) && last?.strain > 0 ? last.strain : kEndStrain;
  }

  private setAxis(axis: Axis): void {
    if (axis.label === this.axis.label && axis.end === this.axis.end) return;
    this.axis = axis;
    this.player.fullEnd = axis.end;
    this.curves.soon();
  }

  private get theory(): Theory | undefined {
    const theory = this.summary?.theory ?? this.data.check?.theory;
    return theory?.gibsonAshbyMpa ? theory : undefined;
  }

  private get summary(): Summary | undefined {
    return this.data.job?.summary;
  }

  private updateCurves(): void {
    const { samples } = this.data;
    const { job } = this.data;
    const { words } = job ?? {};
    if (job && words?.rigidWallPlates && !isOverTime(job)) this.setAxis(strainAxis(this.reachedStrain(job)));
    this.player.fullEnd = this.axis.end;
    const isDriven = isOverTime(job);
    const stress = isDriven ? forceChart(samples, this.axis)
      : stressChart(samples, this.axis, this.summary, this.theory, words?.theoryNote ?? "");
    this.stress.setTitle(isDriven ? "Forces of the rigid walls" : "Stress and strain");
    this.stress.element.hidden = !stress;
    const closed = closedBands(samples, this.axis, this.summary);
    const withClosed = (data: ChartData): ChartData => ({ ...data, bands: [...data.bands ?? [], ...closed] });
    if (stress) this.stress.setData(withClosed(stress));
    this.ownTest.offer(samples[0]);
    const { value: column } = this.below;
    this.energy.setTitle(column ? wordsOfColumn(column) : "Energy ledger");
    this.energy.setData(withClosed(column ? sampleChart(samples, this.axis, column)
      : energyChart(samples, this.axis, words?.plates === false ? "work of all loads" : undefined)));
    this.updateBroken();
    this.setEnd();
  }

  private updateBroken(): void {
    const broken = brokenWalls(this.data.samples, this.axis);
    setBanner(this.broken, broken ? `Broken walls (diamonds): ${broken.count}, ${broken.first}` : "");
    if (this.data.job) this.updateDetails(this.data.job);
  }

  private updateFrames(): void {
    const { frames, lattice, jobCount } = this.data.frames;
    this.waiting.hidden ||= frames.length > 0 || lattice !== undefined;
    this.thinned.hidden = !isExported || frames.length >= jobCount;
    setText(this.thinned, `This file has ${frames.length} of the ${jobCount} frames of the job.`);
    this.setEnd();
  }

  // The end so far is that of the samples and the frames.
  private setEnd(): void {
    const { samples, frames } = this.data;
    const lastSample: Sample | undefined = samples[samples.length - 1];
    const lastFrame = frames.frames[frames.frames.length - 1];
    const end = Math.max(lastSample ? this.axis.sample(lastSample) : 0, lastFrame ? this.axis.frame(lastFrame) : 0);
    this.player.setEnd(Number.isFinite(end) ? end : 0, this.data.isComplete);
  }

  private showPlace(): void {
    const { value, playing } = this.player;
    this.frames.showAt(value, playing);
    this.stress.setHead(value);
    this.energy.setHead(value);
    this.url.afresh();
  }

  private keepUrl(): void {
    const { player } = this;
    if (player.playing || player.wanted !== undefined) return;
    const strain = player.following || player.value === 0 ? undefined : String(Number(player.value.toFixed(4)));
    keepInUrl({ strain, view: this.frames.picture.camera.text || undefined });
  }

  private updateDetails(job: Job): void {
    const { check } = this.data;
    const { summary } = job;
    const broken = summary && brokenWalls(this.data.samples, this.axis);
    const key = [job.state, summary !== undefined, check !== undefined, summary?.warnings.length, broken?.count,
                 broken?.first].join();
    if (key === this.detailsKey) return;
    this.detailsKey = key;
    this.curves.soon();
    replaceChildren(this.warnings, ...(summary?.warnings ?? []).map((warning) =>
      h("div", { class: "banner warning" }, h("strong", {}, `${warningWords(warning.kind)}. `),
        `${warning.message} ${warning.remedy}`)));
    this.numbers.hidden = !summary;
    const note = job.words?.theoryNote ?? "";
    if (summary) {
      replaceChildren(this.numbers, h("h2", {}, "Result"),
        resultsList(summary, note, job.words?.plates ?? true, broken));
    }
    const words = check?.words ?? job.words;
    this.facts.hidden = !words;
    if (words) {
      replaceChildren(this.facts, h("h2", {}, "Case"), h("p", {}, sceneWords(words)), h("dl", { class: "facts" },
        ...words.facts.map(({ heading, text }) => h("div", {}, h("dt", {}, heading), h("dd", {}, text)))));
    }
    this.modelled.hidden = !check?.modelled.length;
    replaceChildren(this.modelled, h("h2", {}, "What was modelled"),
      h("ul", {}, ...(check?.modelled ?? []).map((sentence) => h("li", {}, sentence))));
  }

  destroy(): void {
    document.removeEventListener("keydown", this.key);
    this.curves.stop();
    this.url.stop();
    this.queue.destroy();
    this.player.destroy();
    this.data.destroy();
    this.store.destroy();
    this.frames.destroy();
    this.stress.destroy();
    this.energy.destroy();
    this.ownTest.destroy();
  }
}
