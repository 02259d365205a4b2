// The jobs that a view shows, kept up to date by the watch.
import type { Job, Progress } from "../../gen/cellcrush/v1/job_pb";
import { Listeners } from "../dom/calls";
import { watch } from "../api/watch";
import { hasEnded } from "./states";

/** Keeps what the watch does not tell of a job: its case and labels, which do not change, title, progress and place. */
export function keepUntold(job: Job, old: Job | undefined): void {
  if (!old) return;
  if (!job.case && old.case) [job.case, job.words] = [old.case, old.words];
  if (Object.keys(job.labels).length === 0) job.labels = old.labels;
  job.title ||= old.title;
  if (!hasEnded(job)) job.progress ??= old.progress;
  if (job.state === old.state) job.place ||= old.place;
}

export class JobStore {
  readonly jobs = new Map<string, Job>();
  /** Told at most once per picture of the screen. */
  readonly changes = new Listeners<void>();
  /** Told when a job changes its state, appears or disappears. */
  readonly stateChanges = new Listeners<void>();
  private readonly stops: (() => void)[];
  private scheduled = false;

  /** `wants` decides which jobs of the watch the store takes. */
  constructor(private readonly wants: (job: Job) => boolean) {
    this.stops = [
      watch.jobs.add((job) => {
        if (this.jobs.has(job.name) || this.wants(job)) this.put(job);
      }),
      watch.progress.add(({ job, progress }) => this.setProgress(job, progress)),
      watch.deletedJobs.add((name) => this.remove(name)),
    ];
  }

  /** Adds or replaces a job. */
  put(job: Job): void {
    const old = this.jobs.get(job.name);
    keepUntold(job, old);
    this.jobs.set(job.name, job);
    this.schedule();
    if (old?.state !== job.state) this.stateChanges.tell();
  }

  setProgress(name: string, progress: Progress): void {
    const job = this.jobs.get(name);
    if (!job || hasEnded(job)) return;
    job.progress = progress;
    this.schedule();
  }

  remove(name: string): void {
    if (!this.jobs.delete(name)) return;
    this.schedule();
    this.stateChanges.tell();
  }

  clear(): void {
    this.jobs.clear();
    this.schedule();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.changes.tell();
    });
  }

  destroy(): void {
    for (const stop of this.stops) stop();
  }
}
