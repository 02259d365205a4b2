// All that the page knows of one job: the job, its samples and its frames, from the past and the present.
import { Code, ConnectError } from "@connectrpc/connect";
import type { CheckCaseResponse } from "../../gen/cellcrush/v1/cases_service_pb";
import type { JobEvent } from "../../gen/cellcrush/v1/event_pb";
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import { FieldFrame_Encoding, type Sample } from "../../gen/cellcrush/v1/sample_pb";
import { api, ifAny, isAway } from "../api/clients";
import { Later, Listeners } from "../dom/calls";
import { watch, type WatchedJob } from "../api/watch";
import { FrameStore } from "../frames/frame_store";
import { FrameReader } from "../frames/parts";
import { elsewhere, hasEnded } from "../jobs/states";
import { keepUntold } from "../jobs/store";

const kAgainMs = 2500;
const kPlaceMs = 10_000; // between questions for the place of a job on a cluster

/** Streams frames of a job into a store: all from `from` on, unless there is more to say. */
export async function streamFrames(store: FrameStore, signal: AbortSignal,
                                   range: { name: string; from: number; to?: number; stride?: number }): Promise<void> {
  const reader = new FrameReader(store);
  const request = { ...range, encoding: FieldFrame_Encoding.PACKED };
  for await (const { content } of api.jobs.streamFrames(request, { signal })) {
    if (content.case === "times") store.jobCount = content.value.timeS.length;
    else if (content.case === "mesh" && !store.lattice) reader.addMesh(content.value);
    else if (content.case === "frame") reader.addFrame(content.value);
  }
}

export class JobData implements WatchedJob {
  job: Job | undefined;
  check: CheckCaseResponse | undefined;
  samples: Sample[] = [];
  readonly frames = new FrameStore();
  sequence = 0n;
  error: unknown;
  /** All samples and frames of an ended job are here. */
  isComplete = false;
  readonly jobChanges = new Listeners<void>();
  readonly sampleChanges = new Listeners<void>();
  private readonly reader = new FrameReader(this.frames);
  private readonly abort = new AbortController();
  private stopWatch: (() => void) | undefined;
  private readonly stops: (() => void)[];
  private isLoadingFrames = false;
  private readonly place = new Later(() => void this.loadPlace(), kPlaceMs);

  constructor(readonly name: string) {
    this.stops = [
      watch.jobs.add((job) => {
        if (job.name === this.name) this.putJob(job);
      }),
      watch.deletedJobs.add((deleted) => {
        if (deleted === this.name) this.fail(new ConnectError("This job was deleted.", Code.NotFound));
      }),
    ];
    void this.load();
  }

  private async load(): Promise<void> {
    const { signal } = this.abort;
    try {
      const job = await api.jobs.getJob({ name: this.name }, { signal });
      this.error = undefined;
      this.putJob(job);
      if (hasEnded(job)) await this.loadPast();
      else this.follow();
      if (job.state === Job_State.PENDING) await this.loadPreview(job);
      await this.loadCheck();
    } catch (error) {
      if (signal.aborted) return;
      this.fail(error);
      if (isAway(error)) setTimeout(() => void (signal.aborted || this.load()), kAgainMs);
    }
  }

  private async loadPast(): Promise<void> {
    await Promise.all([this.loadHistory(), this.loadFrames()]);
    this.isComplete = true;
    this.sampleChanges.tell();
  }

  private fail(error: unknown): void {
    this.error = error;
    this.jobChanges.tell();
  }

  // Events do not tell the place.
  private async loadPlace(): Promise<void> {
    const { signal } = this.abort;
    const told = await ifAny(api.jobs.getJob({ name: this.name }, { signal }));
    if (signal.aborted || !this.job || hasEnded(this.job)) return;
    if (told) this.job.place = told.place;
    this.jobChanges.tell();
    this.place.afresh();
  }

  putJob(job: Job): void {
    const old = this.job;
    keepUntold(job, old);
    this.job = job;
    this.jobChanges.tell();
    if (elsewhere(job.executor) && !hasEnded(job) && old?.state !== job.state) {
      this.place.stop();
      void this.loadPlace();
    }
    if (!old || hasEnded(old) === hasEnded(job)) return;
    if (hasEnded(job)) void this.completeFrames();
  }

  // Samples from the start and frames as they come; the frames before are fetched beside.
  private follow(): void {
    this.stopWatch = watch.add(this);
    void this.loadFrames();
  }

  receive(event: JobEvent): void {
    const { event: content } = event;
    switch (content.case) {
      case "snapshot":
        if (content.value.job) this.putJob(content.value.job);
        break;
      case "state":
        if (content.value.begunAgainSequence === event.sequence) this.clear();
        this.putJob(content.value);
        break;
      case "sample":
        this.samples.push(content.value);
        this.sampleChanges.tell();
        break;
      case "progress":
        if (this.job) this.job.progress = content.value;
        this.jobChanges.tell();
        break;
      case "mesh": this.reader.addMesh(content.value); break;
      case "frame": this.reader.addFrame(content.value); break;
    }
  }

  // The job restarts from step 0: what was computed is void.
  private clear(): void {
    this.samples = [];
    this.frames.clear();
    this.sampleChanges.tell();
  }

  private async loadHistory(): Promise<void> {
    let pageToken = "";
    do {
      const page = await api.jobs.getHistory({ name: this.name, pageToken }, { signal: this.abort.signal });
      this.samples.push(...page.samples);
      pageToken = page.nextPageToken;
      this.sampleChanges.tell();
    } while (pageToken);
  }

  private async loadFrames(): Promise<void> {
    if (this.isLoadingFrames) return;
    this.isLoadingFrames = true;
    try {
      await streamFrames(this.frames, this.abort.signal, { name: this.name, from: this.frames.firstGap() });
    } catch (error) {
      // A job without a frame yet is no error: the watch brings its frames.
      const code = ConnectError.from(error).code;
      if (code !== Code.FailedPrecondition && code !== Code.OutOfRange && !this.abort.signal.aborted) throw error;
    } finally {
      this.isLoadingFrames = false;
    }
  }

  // The watch skips frames for a slow reader, and ends before the last frames of a job that was quick.
  private async completeFrames(): Promise<void> {
    try {
      const job = await api.jobs.getJob({ name: this.name }, { signal: this.abort.signal });
      this.putJob(job);
      await this.loadFrames();
      if (job.summary && this.samples.length === 0) await this.loadHistory();
    } catch {
      // What came with the watch stays.
    }
  }

  // The lattice of a job that waits, unless it is too large for a preview; its watch sends the mesh once it runs.
  private async loadPreview(job: Job): Promise<void> {
    if (!job.case) return;
    const preview = await ifAny(api.cases.previewCase({ case: job.case }, { signal: this.abort.signal }));
    if (preview?.mesh && !this.frames.lattice) this.frames.setMesh(preview.mesh);
  }

  // What is modelled, and the theory of a job that has no summary yet.
  private async loadCheck(): Promise<void> {
    if (!this.job?.case) return;
    const check = await ifAny(api.cases.checkCase({ case: this.job.case }, { signal: this.abort.signal }));
    if (!check) return;
    this.check = check;
    this.jobChanges.tell();
  }

  destroy(): void {
    this.abort.abort();
    this.place.stop();
    this.stopWatch?.();
    for (const stop of this.stops) stop();
  }
}
