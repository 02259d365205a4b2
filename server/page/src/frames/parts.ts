// Meshes and frames that arrive in parts.
import { create } from "@bufbuild/protobuf";
import type { FrameChunk, MeshChunk } from "../../gen/cellcrush/v1/event_pb";
import { FieldFrame_PackedSchema, FieldFrameSchema, MeshSchema, type FieldFrame,
         type Mesh } from "../../gen/cellcrush/v1/sample_pb";
import type { FrameStore } from "./frame_store";

function joinBytes(parts: Uint8Array[]): Uint8Array {
  const all = new Uint8Array(parts.reduce((size, part) => size + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

// Arrays of millions of numbers do not fit as arguments of push.
function join(arrays: number[][]): number[] {
  return arrays.length === 1 ? arrays[0] : ([] as number[]).concat(...arrays);
}

function joinMeshes(parts: Mesh[]): Mesh {
  return create(MeshSchema, {
    ...parts[0],
    elementNodes: join(parts.map((part) => part.elementNodes)),
    thicknessMm: join(parts.map((part) => part.thicknessMm)),
    positionMm: join(parts.map((part) => part.positionMm)),
  });
}

function joinFrames(parts: FieldFrame[]): FieldFrame {
  const packed = parts[0].packed;
  return create(FieldFrameSchema, {
    ...parts[0],
    positionMm: join(parts.map((part) => part.positionMm)),
    plasticFraction: join(parts.map((part) => part.plasticFraction)),
    brokenEnd: join(parts.map((part) => part.brokenEnd)),
    endPositionMm: join(parts.map((part) => part.endPositionMm)),
    packed: packed && create(FieldFrame_PackedSchema, {
      ...packed, data: joinBytes(parts.map((part) => part.packed?.data ?? new Uint8Array())),
    }),
  });
}

// Parts of one thing until the last has come. A first part drops an unfinished thing.
class Parts<T> {
  private parts: T[] = [];

  constructor(private readonly joined: (parts: T[]) => T) {}

  add(value: T | undefined, part: number, count: number): T | undefined {
    if (!value || part !== (part === 0 ? 0 : this.parts.length)) return undefined;
    if (part === 0) this.parts = [];
    this.parts.push(value);
    if (this.parts.length < Math.max(count, 1)) return undefined;
    const whole = count > 1 ? this.joined(this.parts) : this.parts[0];
    this.parts = [];
    return whole;
  }
}

/** Puts meshes and frames into a store, each with its last part. */
export class FrameReader {
  private readonly meshes = new Parts<Mesh>(joinMeshes);
  private readonly frames = new Parts<FieldFrame>(joinFrames);

  constructor(private readonly store: Pick<FrameStore, "setMesh" | "add">) {}

  addMesh({ mesh, part, partCount }: MeshChunk): void {
    const whole = this.meshes.add(mesh, part, partCount);
    if (whole) this.store.setMesh(whole);
  }

  addFrame({ frame, part, partCount }: FrameChunk): void {
    const whole = this.frames.add(frame, part, partCount);
    if (whole) this.store.add(whole);
  }
}
