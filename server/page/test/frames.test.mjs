import assert from "node:assert/strict";
import { test } from "node:test";
import { zlibSync } from "fflate";
import { create } from "@bufbuild/protobuf";
import { FieldFrameSchema, MeshSchema } from "../gen/cellcrush/v1/sample_pb";
import { FrameStore } from "../src/frames/frame_store";
import { fieldsOf, guidesOf } from "../src/frames/packed";
import { FrameReader } from "../src/frames/parts";

// Packs as the comment of FieldFrame.Packed says, independently of the daemon. `elements`: what tells what to expect.
function pack(displacements, plastic, quantum, elements = []) {
  const count = displacements.length / 2;
  const bytes = new Uint8Array(4 * count + plastic.length);
  for (const component of [0, 1]) {
    const numbers = Array.from({ length: count }, (_, i) => Math.round(displacements[2 * i + component] / quantum));
    numbers.forEach((value, i) => {
      const joined = elements.filter((ends) => Math.max(...ends) === i).map((ends) => numbers[Math.min(...ends)]);
      let expected = numbers[i - 1] ?? 0;
      if (joined.length === 1) expected = joined[0];
      if (joined.length > 1) expected = Math.floor((joined[0] + joined[1]) / 2);
      const difference = (value - expected) & 0xffff;
      bytes[component * count + i] = difference & 0xff;
      bytes[2 * count + component * count + i] = difference >> 8;
    });
  }
  plastic.forEach((value, i) => { bytes[4 * count + i] = Math.round(255 * value); });
  return {
    quantumMm: quantum, particleCount: count, elementCount: plastic.length, data: zlibSync(bytes),
    predictedByElements: elements.length > 0,
  };
}

test("a packed frame gives positions within half a quantum, also across the 16-bit range", () => {
  const base = new Float32Array([0, 0, 10, 5, -3, 8]);
  const moved = [100, -99.5, -100, 99.5, 0.004, 0];
  const quantum = 100 / 32767;
  const frame = create(FieldFrameSchema, { packed: pack(moved, [0, 0.5, 1], quantum) });
  const { position, plastic } = fieldsOf(frame, base, new Uint32Array());
  moved.forEach((value, i) => assert.ok(Math.abs(position[i] - base[i] - value) <= 0.5 * quantum + 1e-5));
  assert.deepEqual([...plastic].map((value) => value.toFixed(2)), ["0.00", "0.50", "1.00"]);
});

test("elements tell what to expect of particles inside walls", () => {
  // Two joints and the three particles of a wall between them, of which the middle one was numbered last; and a joint.
  const elements = [[0, 2], [2, 4], [4, 3], [3, 1], [5, 1]];
  const moved = [100, -100, -99, 100, 31.5, 2, -63, 7, 12, -3, 0.5, 100];
  const quantum = 100 / 32767;
  const frame = create(FieldFrameSchema, { packed: pack(moved, [], quantum, elements) });
  const { position } = fieldsOf(frame, new Float32Array(12), guidesOf(Uint32Array.from(elements.flat()), 6));
  moved.forEach((value, i) => assert.ok(Math.abs(position[i] - value) <= 0.5 * quantum + 1e-5, `${i}: ${position[i]}`));
});

test("without positions in the mesh, the first frame is the undeformed lattice and the base stays 0", () => {
  const store = new FrameStore();
  store.setMesh(create(MeshSchema, { particleCount: 2, elementNodes: [0, 1], thicknessMm: [1] }));
  const quantum = 0.001;
  store.add(create(FieldFrameSchema, { index: 0, packed: pack([1, 2, 3, 4], [0], quantum) }));
  store.add(create(FieldFrameSchema, { index: 1, packed: pack([1.5, 2, 3, 4], [0], quantum) }));
  assert.ok(Math.abs(store.lattice.undeformed[2] - 3) < 1e-5);
  assert.ok(Math.abs(store.fields(1).position[0] - 1.5) < 1e-5);
});

test("frames are kept in order, replaced by index, and gaps are found", () => {
  const store = new FrameStore();
  for (const index of [0, 1, 4, 3, 3]) store.add(create(FieldFrameSchema, { index, strain: 0.1 * index }));
  assert.deepEqual(store.frames.map((frame) => frame.index), [0, 1, 3, 4]);
  assert.equal(store.firstGap(), 2);
});

test("a frame in parts is whole with its last part; an unfinished one is dropped", () => {
  const added = [];
  const reader = new FrameReader({ add: (frame) => added.push(frame.positionMm) });
  const chunk = (part, positionMm) => ({ frame: create(FieldFrameSchema, { positionMm }), part, partCount: 2 });
  for (const part of [chunk(0, [9, 9]), chunk(0, [1, 2]), chunk(1, [3, 4])]) reader.addFrame(part);
  assert.deepEqual(added, [[1, 2, 3, 4]]);
});

test("the ends that have broken off are whole with the last part, in however many parts they come", () => {
  const ends = { brokenEnd: [3, 0], endPositionMm: [5, 6, 7, 8] };
  for (const parts of [
    [{ positionMm: [1, 2], ...ends }, { positionMm: [3, 4] }],
    [{ brokenEnd: [3, 0], endPositionMm: [5, 6, 7] }, { endPositionMm: [8], positionMm: [1, 2, 3, 4] }],
  ]) {
    const added = [];
    const reader = new FrameReader({ add: (frame) => added.push(frame) });
    parts.forEach((frame, part) =>
      reader.addFrame({ frame: create(FieldFrameSchema, frame), part, partCount: parts.length }));
    const [{ positionMm, brokenEnd, endPositionMm }] = added;
    assert.deepEqual({ positionMm, brokenEnd, endPositionMm }, { positionMm: [1, 2, 3, 4], ...ends });
  }
});
