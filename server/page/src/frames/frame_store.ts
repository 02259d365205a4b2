// The frames of a job, kept packed; the fields of the frames in use are unpacked when they are wanted.
import type { FieldFrame, Mesh } from "../../gen/cellcrush/v1/sample_pb";
import { Listeners } from "../dom/calls";
import { latticeOf, type Lattice } from "./lattice";
import { fieldsOf, guidesOf, type Fields } from "./packed";

const kKept = 8; // unpacked frames

export class FrameStore {
  lattice: Lattice | undefined;
  /** In the order of their indices. */
  frames: FieldFrame[] = [];
  /** Number of frames of the job; an exported page may have fewer. */
  jobCount = 0;
  readonly changes = new Listeners<void>();
  private unpacked = new Map<number, Fields>();
  private base: Float32Array = new Float32Array();
  private guides: Uint32Array = new Uint32Array();

  setMesh(mesh: Mesh): void {
    const lattice = latticeOf(mesh);
    if (lattice.undeformed.length === 0 && this.lattice) return;
    this.lattice = lattice;
    this.base = lattice.undeformed;
    this.guides = guidesOf(lattice.ends, mesh.particleCount);
    this.unpacked.clear();
    this.changes.tell();
  }

  add(frame: FieldFrame): void {
    const { frames } = this;
    // Jobs of earlier versions have a mesh without positions: the first frame has them.
    if (this.lattice && this.lattice.undeformed.length === 0 && frame.index === 0) {
      this.lattice.undeformed = fieldsOf(frame, this.base, this.guides).position;
    }
    let at = frames.length;
    while (at > 0 && frames[at - 1].index >= frame.index) --at;
    frames.splice(at, frames[at]?.index === frame.index ? 1 : 0, frame);
    this.unpacked.delete(frame.index);
    this.changes.tell();
  }

  /** Forgets all frames, as when the job restarts. */
  clear(): void {
    this.frames = [];
    this.unpacked.clear();
    this.changes.tell();
  }

  /** The fields of the frame at a place in `frames`. */
  fields(place: number): Fields {
    const frame = this.frames[place];
    let fields = this.unpacked.get(frame.index);
    if (!fields) {
      fields = fieldsOf(frame, this.base, this.guides);
      this.unpacked.set(frame.index, fields);
      if (this.unpacked.size > kKept) this.unpacked.delete(this.unpacked.keys().next().value!);
    }
    return fields;
  }

  /** Index of the first frame that is missing before the given number of frames. */
  firstGap(): number {
    const at = this.frames.findIndex((frame, i) => frame.index !== i);
    return at < 0 ? this.frames.length : at;
  }
}
