// The sweeps, newest first, as a table; each unfolds the jobs in it.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { api, errorText, ifAny } from "../api/clients";
import { watch } from "../api/watch";
import { Later } from "../dom/calls";
import { Columns, type Column } from "../dom/columns";
import { button, h, setText } from "../dom/element";
import { byNumber, milliseconds } from "../dom/format";
import { sweepFraction } from "./progress_bar";
import { titleOfSweep } from "./states";
import { SweepRow } from "./sweep_row";

const kPage = 10;
const kCalmMs = 600;

const kColumns: Column<Sweep>[] = [
  { key: "what", name: "Sweep", shown: "always", value: titleOfSweep },
  { key: "states", name: "Jobs", shown: "always", value: (sweep) => sweep.jobs.length },
  { key: "done", name: "Progress", value: (sweep) => sweepFraction(sweep, []) },
  { key: "owner", name: "Owner", value: ({ owner }) => owner || undefined },
  { key: "created", name: "Created", figure: true,
    value: ({ createTime }) => createTime && milliseconds(createTime) },
];

export class SweepsList {
  readonly element = h("section", { class: "sweeps", hidden: true });
  private readonly columns = new Columns<Sweep>("sweeps", () => this.show());
  private readonly table = h("table", { class: "jobs sweep-table" }, h("thead", {}, this.columns.head));
  private readonly more = button("Earlier sweeps", () => void this.load(true), { class: "quiet" });
  private readonly none = h("p", { class: "empty", hidden: true }, "No sweep matches the filter.");
  /** Ends when the first sweeps are shown, or could not be fetched. */
  readonly firstLoad: Promise<void>;
  private readonly pending = new Set<string>();
  private sweeps = new Map<string, Sweep>();
  private readonly rows = new Map<string, SweepRow>();
  private token = "";
  private wanted = "";
  private readonly refreshing = new Later(() => void this.refresh(), kCalmMs);
  private readonly stops: (() => void)[];

  /** `runningOf` gives the jobs of a sweep that run. */
  constructor(private readonly runningOf: (sweep: string) => Job[]) {
    this.columns.set(kColumns);
    this.element.append(h("div", { class: "toolbar" }, h("h2", {}, "Sweeps"), h("span", { class: "spacer" }),
                          this.columns.menu), this.table, this.none, this.more);
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

  /** Shows the sweeps with a text in their title or owner. */
  filter(text: string): void {
    this.wanted = text.trim().toLowerCase();
    this.show();
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
      if (isMore) setText(this.more, errorText(error));
    }
  }

  private matches(sweep: Sweep): boolean {
    const { wanted } = this;
    if (/[=:]/.test(wanted)) return true; // a filter of jobs
    return titleOfSweep(sweep).toLowerCase().includes(wanted) || sweep.owner.toLowerCase().includes(wanted);
  }

  /** Shows what has changed; called also for the progress of running jobs. */
  show(): void {
    const newest = [...this.sweeps.values()].filter((sweep) => this.matches(sweep))
      .sort((a, b) => byNumber(b.name, a.name));
    this.element.hidden = this.sweeps.size === 0;
    this.none.hidden = newest.length > 0;
    this.table.hidden = newest.length === 0;
    this.more.hidden = !this.token;
    for (const [name, row] of this.rows) {
      if (this.sweeps.has(name)) continue;
      row.destroy();
      this.rows.delete(name);
    }
    const isShown = new Set(this.columns.shown.map(({ key }) => key));
    const bodies = this.columns.sorted(newest).map((sweep) => {
      let row = this.rows.get(sweep.name);
      if (!row) this.rows.set(sweep.name, row = new SweepRow(sweep.name));
      row.update(sweep, this.runningOf(sweep.name), isShown);
      return row.element;
    });
    // Only if they have moved, so that the focus stays.
    const old = [...this.table.tBodies];
    if (old.length === bodies.length && old.every((body, i) => body === bodies[i])) return;
    for (const body of old) if (!bodies.includes(body)) body.remove();
    this.table.append(...bodies);
  }

  destroy(): void {
    this.refreshing.stop();
    for (const row of this.rows.values()) row.destroy();
    for (const stop of this.stops) stop();
  }
}
