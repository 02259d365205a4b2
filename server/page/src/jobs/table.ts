// The table of jobs: those that have not ended first, in the order of the queue, then the others, newest first.
import type { Queue_Entry } from "../../gen/cellcrush/v1/admin_service_pb";
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import { Columns, type Column } from "../dom/columns";
import { byNumber, milliseconds } from "../dom/format";
import { h } from "../dom/element";
import { impactOf, JobRow, kMoreMeasures } from "./row";
import { hasEnded, secondsOf, titleOf } from "./states";
import type { JobStore } from "./store";

const kMostWaiting = 100;

const kColumns: Column<Job>[] = [
  { key: "select", name: "Selection", shown: "always" },
  { key: "what", name: "Job", shown: "always", value: titleOf },
  { key: "state", name: "State", shown: "always", value: ({ state }) => state },
  { key: "done", name: "Progress", value: (job) => (hasEnded(job) ? undefined : job.progress?.fraction) },
  { key: "time", name: "Time", figure: true, value: secondsOf },
  { key: "impact", name: "Impact plateau", figure: true, value: impactOf },
  { key: "support", name: "Support plateau", figure: true, value: ({ summary }) => summary?.plateauStressSupportMpa },
  ...kMoreMeasures.map((measure) => ({ key: measure.field, figure: true, shown: false,
    name: measure.words, value: ({ summary }: Job) => summary && measure.value(summary) })),
  { key: "owner", name: "Owner", value: ({ owner }) => owner || undefined },
  { key: "created", name: "Created", figure: true,
    value: ({ createTime }) => createTime && milliseconds(createTime) },
  { key: "actions", name: "Actions", shown: "always" },
];

export class JobTable {
  readonly element: HTMLElement;
  /** Number of waiting jobs that are left out. */
  hiddenCount = 0;
  private readonly columns = new Columns<Job>("jobs", () => this.show());
  /** The menu of the columns. */
  readonly menu = this.columns.menu;
  private readonly body = h("tbody");
  private show = (): void => undefined;
  private readonly rows = new Map<string, JobRow>();
  private readonly selected = new Set<string>();

  constructor(private readonly store: JobStore, private readonly selectionChanged: (names: string[]) => void) {
    this.columns.set(kColumns);
    this.element = h("table", { class: "jobs" }, h("thead", {}, this.columns.head), this.body);
  }

  update(queue: Map<string, Queue_Entry>, isShown: (job: Job) => boolean): void {
    this.show = () => this.update(queue, isShown);
    const jobs = this.columns.sorted(this.arrange(queue, isShown));
    const shown = new Set(this.columns.shown.map(({ key }) => key));
    const elements = jobs.map((job) => {
      const row = this.rowOf(job.name);
      row.update(job, queue.get(job.name), shown);
      row.element.classList.toggle("ended", hasEnded(job));
      return row.element;
    });
    this.place(elements);
    const kept = new Set(jobs.map((job) => job.name));
    for (const name of this.rows.keys()) {
      if (kept.has(name)) continue;
      this.rows.delete(name);
      if (this.selected.delete(name)) this.selectionChanged([...this.selected]);
    }
  }

  clearSelection(): void {
    this.selected.clear();
    for (const row of this.rows.values()) row.select.checked = false;
    this.selectionChanged([]);
  }

  private arrange(queue: Map<string, Queue_Entry>, isShown: (job: Job) => boolean): Job[] {
    const places = new Map([...queue.keys()].map((name, i) => [name, i]));
    const group = (job: Job): number =>
      hasEnded(job) ? 3 : job.state === Job_State.PENDING ? 2 : job.state === Job_State.SUSPENDED ? 1 : 0;
    const place = (job: Job): number => places.get(job.name) ?? places.size;
    const jobs = [...this.store.jobs.values()].filter(isShown);
    jobs.sort((a, b) => {
      if (group(a) !== group(b)) return group(a) - group(b);
      if (group(a) === 3) return byNumber(b.name, a.name);
      return place(a) - place(b) || byNumber(a.name, b.name);
    });
    const waiting = jobs.filter((job) => job.state === Job_State.PENDING);
    this.hiddenCount = Math.max(0, waiting.length - kMostWaiting);
    const hidden = new Set(waiting.slice(kMostWaiting));
    return hidden.size ? jobs.filter((job) => !hidden.has(job)) : jobs;
  }

  private rowOf(name: string): JobRow {
    let row = this.rows.get(name);
    if (row) return row;
    row = new JobRow(this.store);
    const { select } = row;
    select.addEventListener("change", () => {
      if (select.checked) this.selected.add(name);
      else this.selected.delete(name);
      this.selectionChanged([...this.selected]);
    });
    this.rows.set(name, row);
    return row;
  }

  // Moves only the rows that are out of place, so that focus and selection stay.
  private place(elements: HTMLElement[]): void {
    const wanted = new Set<Element>(elements);
    for (const child of [...this.body.children]) if (!wanted.has(child)) child.remove();
    let next = this.body.firstElementChild;
    for (const element of elements) {
      if (element === next) next = next.nextElementSibling;
      else this.body.insertBefore(element, next);
    }
  }
}
