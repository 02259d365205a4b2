// The one stream of a tab: all jobs and sweeps, and the samples and frames of the jobs that a view asks for.
//
// The watch reconnects with growing delays and continues with its token, so no change is lost while the daemon is away.
// A tab that was hidden for a minute closes its stream. A tab that has no place for a lasting stream (takePlace), or
// that is behind a proxy which passes an answer on only as a whole, asks every few seconds for what has changed.
import { create } from "@bufbuild/protobuf";
import { Code, ConnectError } from "@connectrpc/connect";
import type { JobEvent } from "../../gen/cellcrush/v1/event_pb";
import type { Job, Progress } from "../../gen/cellcrush/v1/job_pb";
import { WatchJobRequestSchema, type WatchJobsResponse } from "../../gen/cellcrush/v1/jobs_service_pb";
import { FieldFrame_Encoding } from "../../gen/cellcrush/v1/sample_pb";
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { api } from "./clients";
import { otherServer } from "./epoch";
import { Listeners } from "../dom/calls";

const kPlaces = 4;

/** Takes a place that is free. The returned function gives it back; undefined: none is free. */
export async function takePlace(): Promise<(() => void) | undefined> {
  if (!("locks" in navigator)) return () => undefined;
  for (let place = 0; place < kPlaces; ++place) {
    const giveBack = await holdIfFree(`cellcrush-stream-${place}`);
    if (giveBack) return giveBack;
  }
  return undefined;
}

// A lock is held until the promise of its callback is settled, and ends with its tab. Browsers may refuse locks to a
// page in a frame of another site, which then streams without.
function holdIfFree(name: string): Promise<(() => void) | undefined> {
  return new Promise((resolve) => {
    navigator.locks.request(name, { ifAvailable: true }, (lock) => {
      if (!lock) return resolve(undefined);
      return new Promise<void>((giveBack) => resolve(giveBack));
    }).catch(() => resolve(() => undefined));
  });
}

/** "other": another server answers, and the watch has ended. */
export type Connection = "connecting" | "live" | "away" | "hidden" | "other";

/** A job whose samples and frames a view wants, and how far it has them. */
export interface WatchedJob {
  readonly name: string;
  /** Sequence number of the last event received. */
  sequence: bigint;
  /** Called with each event, in order. */
  receive(event: JobEvent): void;
}

const kFirstDelayMs = 500;
const kLongestDelayMs = 15_000;
const kSilenceMs = 45_000; // a live stream sends a bookmark every 15 s
const kFirstMs = 5_000; // until the first message of a stream
const kHiddenMs = 60_000;
const kBriefMs = 1_500; // after which the daemon ends a brief stream, and the time until the next one
const kBetweenMs = 3_000;

class Watch {
  readonly connection = new Listeners<Connection>();
  readonly jobs = new Listeners<Job>();
  readonly progress = new Listeners<{ job: string; progress: Progress }>();
  readonly deletedJobs = new Listeners<string>();
  readonly sweeps = new Listeners<Sweep>();
  readonly deletedSweeps = new Listeners<string>();
  /** The stream began without a token: what views have listed may be out of date. */
  readonly freshStarts = new Listeners<void>();

  state: Connection = "connecting";
  private readonly watched = new Map<string, WatchedJob>();
  private token: Uint8Array<ArrayBufferLike> = new Uint8Array();
  private abort = new AbortController();
  private delay = kFirstDelayMs;
  private timer = 0;
  private silence = 0;
  private hiding = 0;
  private lasting: "untried" | "works" | "held up" = "untried";

  start(): void {
    document.addEventListener("visibilitychange", () => this.followVisibility());
    window.addEventListener("online", () => this.restart());
    otherServer.add(() => this.end());
    this.restart();
  }

  /** Adds the samples and frames of a job to the stream; returns the function that removes them. */
  add(job: WatchedJob): () => void {
    this.watched.set(job.name, job);
    this.restart();
    return () => {
      if (this.watched.get(job.name) !== job) return;
      this.watched.delete(job.name);
      if (!this.abort.signal.aborted) this.restart();
    };
  }

  private end(): void {
    this.setState("other");
    clearTimeout(this.timer);
    this.abort.abort();
  }

  retryNow(): void {
    this.delay = kFirstDelayMs;
    this.restart();
  }

  // Several changes of `watched` in a row make one new stream.
  private restart(after = 0): void {
    if (this.state === "hidden" || this.state === "other") return;
    this.abort.abort();
    clearTimeout(this.timer);
    clearTimeout(this.silence);
    this.timer = window.setTimeout(() => void this.run(), after);
  }

  private followVisibility(): void {
    clearTimeout(this.hiding);
    if (document.hidden) {
      this.hiding = window.setTimeout(() => {
        this.setState("hidden");
        clearTimeout(this.timer);
        this.abort.abort();
      }, kHiddenMs);
    } else if (this.state === "hidden") {
      this.setState("connecting");
      this.retryNow();
    } else if (this.state === "away") {
      this.retryNow();
    }
  }

  private async run(): Promise<void> {
    const abort = (this.abort = new AbortController());
    const giveBack = await takePlace();
    abort.signal.addEventListener("abort", () => giveBack?.());
    if (abort.signal.aborted) return giveBack?.();
    await this.read(abort, !giveBack || this.lasting === "held up");
    giveBack?.();
  }

  private async read(abort: AbortController, isBrief: boolean): Promise<void> {
    const request = {
      resumeToken: this.token,
      jobs: [...this.watched.values()].map((job) =>
        create(WatchJobRequestSchema, {
          name: job.name, afterSequence: job.sequence, frames: true, encoding: FieldFrame_Encoding.PACKED,
        })),
    };
    const headers = isBrief ? { "Connect-Timeout-Ms": `${kBriefMs}` } : undefined;
    this.expectWithin(kFirstMs);
    try {
      for await (const message of api.jobs.watchJobs(request, { signal: abort.signal, headers })) {
        if (abort.signal.aborted) return;
        if (!isBrief) this.lasting = "works";
        this.expectWithin(kSilenceMs);
        this.receive(message);
      }
      if (!abort.signal.aborted) this.reconnect();
    } catch (error) {
      if (abort.signal.aborted) return;
      const failure = ConnectError.from(error);
      if (isBrief && failure.code === Code.DeadlineExceeded) this.restart(kBetweenMs);
      else this.recover(failure);
    }
  }

  private expectWithin(milliseconds: number): void {
    clearTimeout(this.silence);
    this.silence = window.setTimeout(() => {
      if (this.lasting === "untried") this.lasting = "held up";
      this.reconnect();
    }, milliseconds);
  }

  private recover(error: ConnectError): void {
    if (error.code === Code.Unauthenticated) return; // the page asks for a token and starts again
    const tokenIsVoid = error.code === Code.OutOfRange || error.code === Code.FailedPrecondition;
    if (tokenIsVoid) this.token = new Uint8Array();
    this.reconnect();
  }

  // Proxies end what is open for long: a cut that the next stream repairs is no news.
  private get isFirstCut(): boolean {
    return this.state === "live" && this.delay === kFirstDelayMs;
  }

  private reconnect(): void {
    if (!this.isFirstCut) this.setState("away");
    this.restart(this.delay * (0.75 + 0.5 * Math.random()));
    this.delay = Math.min(2 * this.delay, kLongestDelayMs);
  }

  private setState(state: Connection): void {
    if (this.state === state || this.state === "other") return;
    this.state = state;
    this.connection.tell(state);
  }

  private receive(message: WatchJobsResponse): void {
    this.delay = kFirstDelayMs;
    this.setState("live");
    const hadToken = this.token.length > 0;
    if (message.resumeToken.length > 0) this.token = message.resumeToken;
    const { event } = message;
    switch (event.case) {
      case "snapshot": if (!hadToken) this.freshStarts.tell(); break;
      case "job": this.jobs.tell(event.value); break;
      case "progress":
        if (event.value.progress) this.progress.tell({ job: event.value.job, progress: event.value.progress });
        break;
      case "deletedJob": this.deletedJobs.tell(event.value); break;
      case "sweep": this.sweeps.tell(event.value); break;
      case "deletedSweep": this.deletedSweeps.tell(event.value); break;
      case "watched": this.pass(event.value.job, event.value.event); break;
      case "watchedEnd": this.watched.delete(event.value.job); break;
    }
  }

  private pass(name: string, event: JobEvent | undefined): void {
    const job = this.watched.get(name);
    if (!job || !event) return;
    job.receive(event);
    job.sequence = event.sequence;
  }
}

export const watch = new Watch();
