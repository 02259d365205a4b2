import assert from "node:assert/strict";
import { test } from "node:test";
import { platesOf, RigidWalls } from "../src/picture/rigid_walls";

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
