// Walls that have broken: where their ends are in pictures, and what is said of them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { zlibSync } from "fflate";
import { create } from "@bufbuild/protobuf";
import { FieldFrameSchema, MeshSchema, SampleSchema } from "../gen/cellcrush/v1/sample_pb";
import { strainAxis, timeAxis } from "../src/charts/curves";
import { energyChart } from "../src/charts/energy";
import { FrameStore } from "../src/frames/frame_store";
import { boxOf } from "../src/frames/lattice";
import { brokenWalls } from "../src/job/broken_walls";
import { fillSegments, findNearest, kSegmentFloats, mixFields } from "../src/picture/segments";

// A chain of three elements along x.
const kMesh = {
  particleCount: 4, elementNodes: [0, 1, 1, 2, 2, 3], thicknessMm: [1, 1, 1],
  positionMm: [0, 0, 10, 0, 20, 0, 30, 0],
};
// The end of the first element breaks off, then the start of the last.
const kEnds = { brokenEnd: [1, 4], endPositionMm: [9, 3, 21, -50] };
const kParted = [[0, 0, 9, 3], [10, 0, 20, 0], [21, -50, 30, 0]];
// No displacement of any particle, no plastic fraction.
const kPacked = { quantumMm: 0.001, particleCount: 4, elementCount: 3, data: zlibSync(new Uint8Array(19)),
                  predictedByElements: true };

function storeOf(...frames) {
  const store = new FrameStore();
  store.setMesh(create(MeshSchema, kMesh));
  frames.forEach((frame, index) => store.add(create(FieldFrameSchema, { index, ...frame })));
  return store;
}

const endsOf = ({ count, values }) => Array.from({ length: count }, (_, i) =>
  [...values.subarray(kSegmentFloats * i, kSegmentFloats * i + 4)]);
const drawn = (store, fields, old) => endsOf(fillSegments(store.lattice, fields, old));

test("elements end where their ends have broken off, in plain and packed frames", () => {
  for (const frame of [{ positionMm: kMesh.positionMm, plasticFraction: [0, 0, 0] }, { packed: kPacked }]) {
    const store = storeOf(frame, { ...frame, ...kEnds });
    const segments = fillSegments(store.lattice, store.fields(1), undefined);
    assert.deepEqual(endsOf(segments), kParted);
    assert.equal(findNearest(segments, 9, 3, 1), 0, "under the pointer");
    assert.equal(findNearest(segments, 21, -50, 1), 2, "under the pointer");
    assert.equal(boxOf(store.fields(1).position).lowY, -50);
    // Frames before the breaks are as they were, also in segments that are used again.
    const whole = [[0, 0, 10, 0], [10, 0, 20, 0], [20, 0, 30, 0]];
    assert.deepEqual(drawn(store, store.fields(0), segments), whole);
  }
});

test("between two frames an end comes from its joint, or from where it was", () => {
  const store = storeOf({ packed: kPacked }, { packed: kPacked, brokenEnd: [1], endPositionMm: [9, 1] },
                        { packed: kPacked, ...kEnds });
  const [none, one, both] = [0, 1, 2].map((place) => store.fields(place));
  const { ends } = store.lattice;
  let mixed = mixFields(none, one, 0.5, ends, undefined);
  assert.deepEqual(drawn(store, mixed), [[0, 0, 9.5, 0.5], [10, 0, 20, 0], [20, 0, 30, 0]]);
  mixed = mixFields(one, both, 0.5, ends, mixed);
  assert.deepEqual(drawn(store, mixed), [[0, 0, 9, 2], [10, 0, 20, 0], [20.5, -25, 30, 0]]);
  mixed = mixFields(one, both, 1, ends, mixed);
  assert.deepEqual(drawn(store, mixed), kParted);
});

test("a job tells how many walls have broken, and when the first did", () => {
  const samples = [
    { strain: 0.1, timeS: 1e-4 },
    { strain: 0.2, timeS: 2e-4, breakCount: 2n, breaks: [{ timeS: 1.5e-4 }, { timeS: 1.8e-4 }] },
    { strain: 0.3, timeS: 3e-4, breakCount: 12n },
  ].map((sample) => create(SampleSchema, sample));
  assert.deepEqual(brokenWalls(samples, strainAxis(0.8)), { count: "12", first: "the first at strain 0.200" });
  assert.deepEqual(brokenWalls(samples, timeAxis(1e-3)), { count: "12", first: "the first at 0.150 ms" });
  assert.equal(brokenWalls(samples.slice(0, 1), strainAxis(0.8)), undefined);
  assert.equal(brokenWalls([], strainAxis(0.8)), undefined);
});

test("the work of fracture is the highest area of the ledger", () => {
  const sample = create(SampleSchema, { strain: 0.1, workExternalMj: 100, energyPlasticMj: 60, energyFrictionMj: 5,
                                        energyFractureMj: 30 });
  const { series, columns } = energyChart([sample], strainAxis(0.8));
  assert.deepEqual(series.map(({ label, colour }) => [label, colour]),
                   [["fracture", "energy-8"], ["friction", "energy-7"], ["plastic", "energy-1"],
                    ["work of the plates", "ink"]]);
  assert.equal(columns[1][0], 95);
});
