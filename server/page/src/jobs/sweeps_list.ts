// The sweeps, newest first, each with the states of its jobs as a bar.
import { Job_State } from "../../gen/cellcrush/v1/job_pb";
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { api, errorText, ifAny } from "../api/clients";
import { watch } from "../api/watch";
import { Later } from "../dom/calls";
import { button, h, replaceChildren } from "../dom/element";
import { byNumber, clock, fullTime, idOf, pathOf, plural } from "../dom/format";
import { stateBar, titleOfSweep, variedFields } from "./states";

const kPage = 6;
const kCalmMs = 600;

export class SweepsList {
  readonly element = h("section", { class: "sweeps", hidden: true });
  private readonly list = h("div", { class: "sweep-rows" });
  private readonly more = button("Earlier sweeps", () => void this.load(true), { class: "quiet" });
  /** Ends when the first sweeps are shown, or could not be fetched. */
  readonly firstLoad: Promise<void>;
  private readonly pending = new Set<string>();
  private sweeps = new Map<string, Sweep>();
  private token = "";
  private readonly refreshing = new Later(() => void this.refresh(), kCalmMs);
  private readonly stops: (() => void)[];

  constructor() {
    this.element.append(h("h2", {}, "Sweeps"), this.list, this.more);
    this.stops = [
      watch.sweeps.add((sweep) => {
        this.sweeps.set(sweep.name, sweep);
        this.show();
      }),
      watch.deletedSweeps.add((name) => {
        this.sweeps.delete(name);
        this.show();
      }),
      watch.jobs.add((job) => {
        if (job.sweep || job.state !== Job_State.PENDING) this.refreshSoon(job.sweep);
      }),
      watch.freshStarts.add(() => void this.load(false)),
    ];
    this.firstLoad = this.load(false);
  }

  // Asks for the counts of the sweeps whose jobs changed.
  private refreshSoon(name: string): void {
    if (!name || !this.sweeps.has(name)) return;
    this.pending.add(name);
    this.refreshing.soon();
  }

  private async refresh(): Promise<void> {
    const names = [...this.pending];
    this.pending.clear();
    for (const sweep of await Promise.all(names.map((name) => ifAny(api.sweeps.getSweep({ name }))))) {
      if (sweep) this.sweeps.set(sweep.name, sweep);
    }
    this.show();
  }

  private async load(isMore: boolean): Promise<void> {
    try {
      const page = await api.sweeps.listSweeps({ pageSize: kPage, pageToken: isMore ? this.token : "" });
      if (!isMore) this.sweeps.clear();
      for (const sweep of page.sweeps) this.sweeps.set(sweep.name, sweep);
      this.token = page.nextPageToken;
      this.show();
    } catch (error) {
      if (isMore) replaceChildren(this.more, errorText(error));
    }
  }

  private show(): void {
    const sweeps = [...this.sweeps.values()].sort((a, b) => byNumber(b.name, a.name));
    this.element.hidden = sweeps.length === 0;
    this.more.hidden = !this.token;
    replaceChildren(this.list, ...sweeps.map((sweep) =>
      h("div", { class: "sweep-row" },
        h("a", { href: pathOf(sweep.name), class: "job-title" }, titleOfSweep(sweep)),
        h("span", { class: "faint" }, `sweep ${idOf(sweep.name)} over ${variedFields(sweep).join(", ") || "points"}`),
        stateBar(sweep.stateCounts),
        h("span", { class: "faint figure", title: fullTime(sweep.createTime) },
          `${plural(sweep.jobs.length, "job")}, ${clock(sweep.createTime)}`))));
  }

  destroy(): void {
    this.refreshing.stop();
    for (const stop of this.stops) stop();
  }
}
