// A sweep and the rows of its table, kept up to date by the watch.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sweep, SweepTable_Row, SweepTable_SeedMeans } from "../../gen/cellcrush/v1/sweep_pb";
import { api, ifAny } from "../api/clients";
import { watch } from "../api/watch";
import { Later, Listeners } from "../dom/calls";
import { hasEnded } from "../jobs/states";
import { keepUntold } from "../jobs/store";
import { isSeed } from "./points";

const kCalmMs = 300;
const kMeansMs = 1000; // after the end of a job

/** A sweep with all rows of its table, and the means over the seeds if it varies them. */
export interface LoadedSweep {
  sweep: Sweep;
  rows: SweepTable_Row[];
  fields: string[];
  means: SweepTable_SeedMeans[];
}

async function loadMeans(name: string, signal?: AbortSignal): Promise<SweepTable_SeedMeans[]> {
  const means: SweepTable_SeedMeans[] = [];
  let pageToken = "";
  do {
    const page = await api.sweeps.getSweepTable({ name, pageToken, meanOverSeeds: true }, { signal });
    means.push(...page.means);
    pageToken = page.nextPageToken;
  } while (pageToken);
  return means;
}

export async function loadSweep(name: string, signal?: AbortSignal): Promise<LoadedSweep> {
  const sweep = await api.sweeps.getSweep({ name }, { signal });
  const rows: SweepTable_Row[] = [];
  let fields: string[] = [];
  let pageToken = "";
  do {
    const page = await api.sweeps.getSweepTable({ name, pageToken }, { signal });
    if (page.fields.length) fields = page.fields;
    rows.push(...page.rows);
    pageToken = page.nextPageToken;
  } while (pageToken);
  return { sweep, rows, fields, means: fields.some(isSeed) ? await loadMeans(name, signal) : [] };
}

export class SweepData {
  sweep: Sweep | undefined;
  rows: SweepTable_Row[] = [];
  fields: string[] = [];
  means: SweepTable_SeedMeans[] = [];
  error: unknown;
  /** Told when rows or the error have changed; several changes are told together. */
  readonly changes = new Listeners<void>();
  private byJob = new Map<string, SweepTable_Row>();
  private readonly telling = new Later(() => this.changes.tell(), kCalmMs);
  private readonly averaging = new Later(() => void this.average(), kMeansMs);
  private readonly abort = new AbortController();
  private readonly stops: (() => void)[];

  constructor(readonly name: string) {
    this.stops = [
      watch.jobs.add((job) => this.takeJob(job)),
      watch.progress.add(({ job, progress }) => {
        const result = this.byJob.get(job)?.result;
        if (!result || hasEnded(result)) return;
        result.progress = progress;
        this.telling.soon();
      }),
      watch.sweeps.add((sweep) => {
        if (sweep.name === this.name) void this.load();
      }),
      watch.freshStarts.add(() => void this.load()),
    ];
    void this.load();
  }

  async load(): Promise<void> {
    try {
      Object.assign(this, await loadSweep(this.name, this.abort.signal));
      this.byJob = new Map(this.rows.map((row) => [row.job, row]));
      this.error = undefined;
    } catch (error) {
      if (this.abort.signal.aborted) return;
      this.error = error;
    }
    this.changes.tell();
  }

  private takeJob(job: Job): void {
    const row = this.byJob.get(job.name);
    if (!row) return;
    keepUntold(job, row.result);
    row.result = job;
    if (job.state === Job_State.SUCCEEDED && !job.summary) void this.complete(row);
    this.telling.soon();
    if (hasEnded(job) && this.fields.some(isSeed)) this.averaging.soon();
  }

  private async average(): Promise<void> {
    this.means = await ifAny(loadMeans(this.name, this.abort.signal)) ?? this.means;
    this.telling.soon();
  }

  private async complete(row: SweepTable_Row): Promise<void> {
    row.result = await ifAny(api.jobs.getJob({ name: row.job }, { signal: this.abort.signal })) ?? row.result;
    this.telling.soon();
  }

  destroy(): void {
    this.abort.abort();
    this.telling.stop();
    this.averaging.stop();
    for (const stop of this.stops) stop();
  }
}
