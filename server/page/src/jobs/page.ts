// The page of all jobs and sweeps, live.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import { api, errorText } from "../api/clients";
import { watch } from "../api/watch";
import { Later } from "../dom/calls";
import { button, h, setText } from "../dom/element";
import { idOf, plural } from "../dom/format";
import { go, keepInUrl, type View } from "../router";
import { QueuePanel } from "./queue";
import { kActiveStates, kStates, stateWord, titleOf } from "./states";
import { JobStore } from "./store";
import { SweepsList } from "./sweeps_list";
import { JobTable } from "./table";
import { urlOf } from "../dom/base";

const kPage = 50;
const kMostPagesAtOnce = 6; // while few of the jobs on a page pass the filter
const kMostCompared = 6;
const kTypingMs = 250;

const withState = (filter: string, state: string): string =>
  [filter, `state = ${state}`].filter(Boolean).join(" AND ");

// Jobs that count in the words above the list, and in the progress of their sweep.
const isBusy = ({ state }: Job): boolean => state === Job_State.RUNNING || state === Job_State.CANCELLING;

export class JobsPage implements View {
  readonly title = "Jobs";
  readonly element = h("div", { class: "page jobs-page" });
  private readonly store = new JobStore((job) => isBusy(job) || this.passes(job));
  private readonly queue = new QueuePanel(() => this.show());
  private readonly sweeps = new SweepsList((sweep) => [...this.store.jobs.values()].filter((job) =>
    job.sweep === sweep && job.state === Job_State.RUNNING));
  private readonly table = new JobTable(this.store, (names) => this.showSelection(names));
  private readonly text = h("input", { type: "search", placeholder: "Title, or owner = \"name\"",
                                       "aria-label": "Filter of sweeps and jobs" });
  private readonly state = h("select", { "aria-label": "State" }, h("option", { value: "" }, "any state"),
    ...kStates.map((state) => h("option", { value: Job_State[state] }, stateWord(state))));
  private readonly withSweeps = h("input", { type: "checkbox" });
  private readonly counts = h("p", { class: "faint counts" });
  private readonly compare = button("Compare", () => this.openComparison(), { class: "primary", hidden: true });
  private readonly unselect = button("Clear selection", () => this.table.clearSelection(), { hidden: true });
  private readonly more = button("Earlier jobs", () => void this.load(false), { class: "quiet", hidden: true });
  private readonly empty = h("p", { class: "empty", hidden: true });
  private readonly stops: (() => void)[];
  private selected: string[] = [];
  private token = "";
  private generation = 0;
  private readonly filtering = new Later(() => {
    keepInUrl({ q: this.text.value, state: this.state.value, all: this.withSweeps.checked ? "1" : "" });
    void this.load(true);
  }, kTypingMs);
  private isLoaded = false;

  constructor(query: URLSearchParams) {
    this.text.value = query.get("q") ?? "";
    this.state.value = query.get("state") ?? "";
    this.withSweeps.checked = query.get("all") === "1";
    this.text.addEventListener("input", () => this.filtering.afresh());
    this.state.addEventListener("change", () => this.filtering.afresh(0));
    this.withSweeps.addEventListener("change", () => this.filtering.afresh(0));
    this.element.append(
      h("h1", { class: "unseen" }, "Jobs and sweeps"), this.queue.element,
      h("div", { class: "toolbar" }, this.text, this.counts), this.sweeps.element,
      h("section", {},
        h("div", { class: "toolbar" }, h("h2", {}, "Jobs"), this.state,
          h("label", {}, this.withSweeps, " also those of sweeps"), h("span", { class: "spacer" }), this.unselect,
          this.compare, this.table.menu),
        this.table.element, this.empty, this.more));
    this.stops = [
      this.store.changes.add(() => this.show()),
      this.store.stateChanges.add(() => this.queue.refresh()),
      watch.freshStarts.add(() => void this.load(true)),
    ];
    void this.load(true);
    this.queue.refresh();
    // The jobs stand below the sweeps, and would jump when these come.
    this.element.classList.add("invisible");
    void this.sweeps.firstLoad.then(() => this.element.classList.remove("invisible"));
  }

  // The filter of ListJobs: plain text is looked for in titles.
  private filterText(): string {
    const text = this.text.value.trim();
    if (!text || /[=:]/.test(text)) return text;
    return `title : "${text.replaceAll("\\", "\\\\").replaceAll('"', '\\"')}"`;
  }

  private passes(job: Job): boolean {
    const text = this.text.value.trim().toLowerCase();
    if (/[=:]/.test(text)) return false; // the daemon decides; the next list has it
    if (text && !titleOf(job).toLowerCase().includes(text)) return false;
    return this.isShown(job);
  }

  // Jobs of sweeps stand in their sweep, and here too if the user wants all.
  private isShown(job: Job): boolean {
    if (this.state.value && Job_State[job.state] !== this.state.value) return false;
    return !job.sweep || this.withSweeps.checked;
  }

  private async load(fromStart: boolean): Promise<void> {
    const generation = ++this.generation;
    const filter = this.filterText();
    this.sweeps.filter(this.text.value);
    try {
      const active = fromStart ? await this.listActive(filter) : [];
      if (generation !== this.generation) return;
      if (fromStart) {
        this.store.clear();
        this.token = "";
        active.forEach((job) => this.store.put(job));
      }
      await this.loadPages(generation, filter);
      if (generation !== this.generation) return;
      this.isLoaded = true;
      this.showEmpty("");
    } catch (error) {
      if (generation === this.generation) this.showEmpty(errorText(error));
    }
  }

  private async loadPages(generation: number, filter: string): Promise<void> {
    const state = this.state.value ? withState(filter, this.state.value) : filter;
    let shown = 0;
    for (let i = 0; i < kMostPagesAtOnce && shown < kPage / 2; ++i) {
      const page = await api.jobs.listJobs({ pageSize: kPage, pageToken: this.token, filter: state });
      if (generation !== this.generation) return;
      page.jobs.forEach((job) => this.store.put(job));
      shown += page.jobs.filter((job) => this.isShown(job)).length;
      this.token = page.nextPageToken;
      if (!this.token) break;
    }
    this.more.hidden = !this.token;
  }

  private async listActive(filter: string): Promise<Job[]> {
    const lists = await Promise.all(kActiveStates.map((state) =>
      api.jobs.listJobs({ pageSize: 200, filter: withState(filter, Job_State[state]) })));
    return lists.flatMap((list) => list.jobs);
  }

  private show(): void {
    this.table.update(this.queue.entries, (job) => this.isShown(job));
    this.sweeps.show();
    const jobs = [...this.store.jobs.values()];
    const countOf = (state: Job_State): number =>
      state === Job_State.PENDING ? this.queue.waitingCount : jobs.filter((job) => job.state === state).length;
    const words = kActiveStates.map((state) => ({ state, n: countOf(state) }))
      .filter(({ n }) => n > 0).map(({ state, n }) => `${n} ${stateWord(state)}`);
    if (this.table.hiddenCount) words.push("the first 100 waiting are listed");
    setText(this.counts, words.join(" · ") || (this.isLoaded ? "no job is running or waiting" : ""));
    this.empty.hidden = this.empty.textContent === "" || jobs.some((job) => this.isShown(job));
  }

  private showEmpty(error: string): void {
    const none = this.text.value || this.state.value ? "No job matches the filter." : "No job outside of sweeps.";
    setText(this.empty, error || none);
    this.show();
    this.empty.hidden = !error && [...this.store.jobs.values()].some((job) => this.isShown(job));
    if (!error && !this.text.value && !this.state.value && !this.empty.hidden) {
      this.empty.append(" ", h("a", { href: urlOf("/new") }, "Start from a preset."));
    }
  }

  private showSelection(names: string[]): void {
    this.selected = names;
    this.compare.hidden = this.unselect.hidden = names.length === 0;
    this.compare.disabled = names.length < 2 || names.length > kMostCompared;
    setText(this.compare, names.length > kMostCompared ? `At most ${kMostCompared} jobs`
      : `Compare ${plural(names.length, "job")}`);
  }

  private openComparison(): void {
    go(urlOf(`/compare?jobs=${this.selected.map(idOf).join(",")}`));
  }

  destroy(): void {
    this.filtering.stop();
    ++this.generation;
    for (const stop of this.stops) stop();
    this.store.destroy();
    this.queue.destroy();
    this.sweeps.destroy();
  }
}
