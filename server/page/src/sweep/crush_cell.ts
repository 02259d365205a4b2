// One job of the grid of crushes: some of its frames, loaded when the cell comes into view.
import { ConnectError, Code } from "@connectrpc/connect";
import { Job_State } from "../../gen/cellcrush/v1/job_pb";
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { h, setText } from "../dom/element";
import { idOf, strainText } from "../dom/format";
import { FrameStore } from "../frames/frame_store";
import { streamFrames } from "../job/job_data";
import { hasEnded, stateWord } from "../jobs/states";
import { SmallPicture } from "../picture/small_picture";
import { urlOf } from "../dom/base";

const kFrames = 32; // of each job
const kAgainMs = 4000; // for the frames of a running job

export class CrushCell {
  readonly element: HTMLElement;
  readonly frames = new FrameStore();
  /** Whether the cell has been in view. */
  isWanted = false;
  isLoading = false;
  private readonly picture: SmallPicture;
  private readonly link = h("a", {});
  private readonly place = h("span", { class: "faint figure" });
  private readonly note = h("p", { class: "picture-note" });
  private stride = 0;
  private wasComplete = false;
  private loadedAt = -Infinity;
  private shownKey = "";
  private readonly abort = new AbortController();

  constructor(public row: SweepTable_Row, readonly label: string) {
    this.picture = new SmallPicture(`Job ${idOf(row.job)}: deformed shape`);
    setText(this.link, label || `job ${idOf(row.job)}`);
    this.link.title = `Job ${idOf(row.job)}`;
    this.element = h("figure", { class: "crush-cell" },
      h("div", { class: "small-picture" }, this.picture.element, this.note),
      h("figcaption", {}, this.link, this.place));
  }

  /** The strain of the last frame so far. */
  get end(): number {
    return this.frames.frames[this.frames.frames.length - 1]?.strain ?? 0;
  }

  /** Whether there may be frames that are not here, and it is time to ask for them. */
  get needsFrames(): boolean {
    const { result } = this.row;
    if (!this.isWanted || this.isLoading || this.wasComplete || !result) return false;
    if (result.state === Job_State.PENDING) return false;
    return hasEnded(result) || performance.now() - this.loadedAt > kAgainMs;
  }

  async load(): Promise<void> {
    this.isLoading = true;
    const willBeComplete = this.row.result !== undefined && hasEnded(this.row.result);
    try {
      if (this.stride === 0) await this.chooseStride();
      const count = await this.stream(this.frames.frames.length * this.stride, undefined, this.stride);
      if (willBeComplete && (count - 1) % this.stride > 0) await this.stream(count - 1, undefined, 1);
      this.wasComplete = willBeComplete;
    } catch (error) {
      // A job without frames so far, or without new ones.
      const { code } = ConnectError.from(error);
      this.wasComplete = willBeComplete && (code === Code.FailedPrecondition || code === Code.OutOfRange);
    }
    this.isLoading = false;
    this.loadedAt = performance.now();
  }

  // A job that runs will have more frames than it has now.
  private async chooseStride(): Promise<void> {
    const { result } = this.row;
    const count = await this.stream(0, 0, 1);
    const done = result?.progress?.fraction || 1;
    this.stride = Math.max(1, Math.round(count / done / kFrames));
    this.frames.clear();
  }

  // Returns how many frames the job has.
  private async stream(from: number, to: number | undefined, stride: number): Promise<number> {
    await streamFrames(this.frames, this.abort.signal, { name: this.row.job, from, to, stride });
    return this.frames.jobCount;
  }

  showAt(strain: number): void {
    const { result, job } = this.row;
    this.link.href = urlOf(`/${job}?strain=${Number(strain.toFixed(3))}`);
    const state = result ? stateWord(result.state) : "";
    const { frames, lattice } = this.frames;
    this.note.hidden = frames.length > 0;
    if (!frames.length || !lattice) {
      const isWaiting = result?.state === Job_State.PENDING;
      setText(this.note, isWaiting ? state : this.wasComplete ? `${state}, no frames` : "");
      return;
    }
    let place = 0;
    frames.forEach((frame, i) => {
      if (Math.abs(frame.strain - strain) < Math.abs(frames[place].strain - strain)) place = i;
    });
    const frame = frames[place];
    const isShort = Math.abs(frame.strain - strain) > 0.02;
    setText(this.place, `${isShort ? `strain ${strainText(frame.strain)}` : ""}${
      this.wasComplete ? "" : ` ${state}`}`.trim());
    const key = `${frame.index} ${frame.timeS}`;
    if (key === this.shownKey) return;
    this.shownKey = key;
    this.picture.show(lattice, this.frames.fields(place), frame.strain);
  }

  destroy(): void {
    this.abort.abort();
    this.picture.destroy();
  }
}
