// Shows the frames of a store in a picture, at the place of a player.
import type { FieldFrame } from "../../gen/cellcrush/v1/sample_pb";
import { indexBefore } from "../charts/curves";
import type { FrameStore } from "../frames/frame_store";
import type { Fields } from "../frames/packed";
import { Picture } from "./picture";
import type { Face } from "./rigid_walls";
import { Pace } from "./player";
import { mixFields } from "./segments";

export class FrameView {
  readonly picture: Picture;
  /** The frame that is shown, or the earlier of the two that a moving picture lies between. */
  shown: FieldFrame | undefined;
  private mixed: Fields | undefined;
  private shownKey = "";
  private included = -1;
  private readonly pace = new Pace();

  /** `facesAt` gives the faces of rigid walls at a time in s. */
  constructor(private readonly store: FrameStore, private readonly valueOf: (frame: FieldFrame) => number,
              label: string, private readonly facesAt: (time: number) => Face[] = () => []) {
    this.picture = new Picture(label);
  }

  /** Place in the store of the last frame at or before a value. */
  private placeBefore(value: number): number {
    return indexBefore(this.store.frames, value, this.valueOf);
  }

  /** A moving picture lies between two frames; a still one is the nearest frame itself. */
  showAt(value: number, isMoving: boolean): void {
    const { store } = this;
    const { frames, lattice } = store;
    if (!lattice || lattice.undeformed.length === 0) return;
    this.picture.setLattice(lattice);
    if (frames.length === 0) { // a job that has none yet
      this.shownKey = "";
      return this.picture.showUndeformed(this.facesAt(0));
    }
    if (!lattice.plates) this.includeLast();
    const before = this.placeBefore(value);
    const after = Math.min(before + 1, frames.length - 1);
    const [a, b] = [this.valueOf(frames[before]), this.valueOf(frames[after])];
    const mix = b > a ? Math.min(Math.max((value - a) / (b - a), 0), 1) : 0;
    if (!isMoving) {
      this.pace.stop();
      this.picture.note("");
      return this.showFrame(mix < 0.5 ? before : after);
    }
    this.picture.note(this.pace.note(performance.now()));
    this.shown = frames[before];
    this.shownKey = "";
    this.mixed = mixFields(store.fields(before), store.fields(after), mix, lattice.ends, this.mixed);
    const between = (a: number, b: number): number => a + mix * (b - a);
    const faces = this.facesAt(between(frames[before].timeS, frames[after].timeS));
    this.picture.show(this.mixed, between(frames[before].strain, frames[after].strain), faces);
  }

  private includeLast(): void {
    const last = this.store.frames.length - 1;
    if (last === this.included) return;
    this.included = last;
    this.picture.include(this.store.fields(last).position);
  }

  private showFrame(place: number): void {
    const frame = this.store.frames[place];
    const faces = this.facesAt(frame.timeS);
    const key = [frame.index, frame.timeS, ...faces.flatMap(({ x, y }) => [x, y])].join(" ");
    this.shown = frame;
    if (key === this.shownKey) return;
    this.shownKey = key;
    this.picture.show(this.store.fields(place), frame.strain, faces);
  }

  /** The value of the next (1) or previous (-1) frame of a place. */
  neighbour(value: number, direction: 1 | -1): number {
    const { frames } = this.store;
    if (frames.length === 0) return 0;
    const tiny = 1e-9;
    let place = this.placeBefore(value + tiny);
    const isOnFrame = Math.abs(this.valueOf(frames[place]) - value) < tiny;
    if (direction === 1) ++place;
    else if (isOnFrame) --place;
    return this.valueOf(frames[Math.min(Math.max(place, 0), frames.length - 1)]);
  }

  destroy(): void {
    this.picture.destroy();
  }
}
