import assert from "node:assert/strict";
import { test } from "node:test";
import { Loading_Grip_Edge as Edge } from "../gen/cellcrush/v1/case_pb";
import { isOverTime } from "../src/jobs/states";
import { placedFace, platesOf, RigidWalls } from "../src/picture/rigid_walls";

const wall = { xMm: 1, yMm: 2, normalX: 0, normalY: -5 };
const job = { case: { lattice: { kind: { case: "frame", value: { rigidWalls: [wall] } } } } };
const sample = (timeS, displacementMm) => ({ timeS, rigidWalls: [{ displacementMm }] });

test("a rigid wall moves along its normal, between samples evenly", () => {
  const walls = new RigidWalls({ job, samples: [sample(1, 10), sample(3, 30)] });
  const yAt = (time) => walls.at(time)[0].y;
  assert.equal(yAt(1), 2 - 10);
  assert.equal(yAt(2), 2 - 20);
  assert.equal(yAt(9), 2 - 30);
});

test("before the first sample a rigid wall stands where the case puts it", () => {
  const samples = [];
  const walls = new RigidWalls({ job, samples });
  assert.deepEqual(walls.at(0), [{ x: 1, y: 2, normalX: 0, normalY: -1 }]);
  samples.push(sample(1, 10));
  assert.equal(walls.at(0)[0].y, 2);
  assert.equal(walls.at(1)[0].y, 2 - 10);
});

test("a honeycomb has the rigid walls of its loading", () => {
  const facesOf = (loading) => new RigidWalls({ job: { case: { loading } }, samples: [] }).at(0);
  assert.deepEqual(facesOf({ rigidWalls: [wall] }), [{ x: 1, y: 2, normalX: 0, normalY: -1 }]);
  assert.deepEqual(facesOf(undefined), []);
});

test("side walls stand beside the plates, across the crush", () => {
  const lattice = { plates: true, alongY: false, impactPlate: 0, supportPlate: 10, length: 10, sideLow: -1, sideHigh: 4 };
  const [impact, support, low, high] = platesOf(lattice, 0.1);
  assert.deepEqual([impact.x, support.x], [1, 10]);
  assert.deepEqual([low.y, low.normalY, high.y, high.normalY], [-1, 1, 4, -1]);
  assert.equal(platesOf({ ...lattice, sideLow: 0, sideHigh: 0 }, 0.1).length, 2);
});

test("a wall at an edge touches the outermost surface of the lattice, and moves from there", () => {
  const lattice = { undeformed: [0, 0, 8, 3], ends: Uint32Array.of(0, 1), thickness: [2] };
  const atEdge = { case: { loading: { rigidWalls: [{ edge: Edge.RIGHT }, { edge: Edge.BOTTOM }] } } };
  const samples = [{ timeS: 0, rigidWalls: [{ displacementMm: 0.5 }, { displacementMm: 0 }] }];
  const [right, bottom] = new RigidWalls({ job: atEdge, samples }).at(0).map((face) => placedFace(face, lattice));
  assert.deepEqual([right.x, right.normalX], [9 - 0.5, -1]);
  assert.deepEqual([bottom.y, bottom.normalY], [-1, 1]);
});

test("a run is told over time where walls may go back", () => {
  const job = (loading, words = { rigidWallPlates: true }) => ({ words, case: { loading: { rigidWalls: [], ...loading } } });
  assert.equal(isOverTime(job({ rigidWalls: [{ massG: 3 }] })), true);
  assert.equal(isOverTime(job({ rigidWalls: [{ velocityMPerS: { points: [] } }] })), true);
  assert.equal(isOverTime(job({ velocityXMPerS: 60 })), true);
  assert.equal(isOverTime(job({ rigidWalls: [{}] })), false);
  assert.equal(isOverTime(job({ rigidWalls: [{ massG: 3 }] }, { plates: true })), false);
  assert.equal(isOverTime(job({}, {})), true);
});
