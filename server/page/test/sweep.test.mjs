import assert from "node:assert/strict";
import { test } from "node:test";
import { kMarkShapes, markPath } from "../src/charts/chart_data";
import { placeIn, Player } from "../src/picture/player";
import { placeOf, sweepChart } from "../src/sweep/points";

const kSpeed = "loading.speed_m_per_s";
const row = (speed, impact) => ({
  job: "jobs/1", values: [speed],
  result: { summary: { plateauStressImpactMpa: impact, plateauStressSupportMpa: 1,
                       theory: { gibsonAshbyMpa: 2, shockMpa: 2 + 0.001 * speed * speed } } },
});
const hexagons = { label: "Hexagons", rows: [row(50, 4), row(100, 12)], fields: [kSpeed] };
const squares = { label: "Squares", rows: [row(80, 9), row(150, 25)], fields: [kSpeed] };

test("a sweep alone shows both plates beside theory", () => {
  const { series } = sweepChart([{ ...hexagons, label: "" }], kSpeed);
  assert.deepEqual(series.map(({ label }) => label), ["shock theory (Eq. 51)", "quasi-static theory (Gibson-Ashby)",
                                                      "impact plate", "support plate"]);
});

test("sweeps in one chart differ in colour and mark, and share one axis", () => {
  const { series, columns, xEnd } = sweepChart([hexagons, squares], kSpeed);
  const points = series.filter(({ quiet }) => !quiet);
  assert.deepEqual(points.map(({ label }) => label), ["Hexagons", "Squares"]);
  assert.equal(new Set(points.map(({ colour }) => colour)).size, 2);
  assert.equal(new Set(points.map(({ mark }) => mark)).size, 2);
  assert.ok(xEnd > 150);
  const impact = (place) => columns[1 + series.indexOf(points[place])];
  const at = (x) => columns[0].indexOf(x);
  assert.equal(impact(0)[at(100)], 12);
  assert.equal(impact(0)[at(80)], null);
  assert.equal(impact(1)[at(80)], 9);
});

test("theory ends where the points of its sweep end", () => {
  const { series, columns } = sweepChart([hexagons, squares], kSpeed);
  const shock = columns[1 + series.findIndex(({ label }) => label === "shock theory (Eq. 51): Hexagons")];
  columns[0].forEach((x, i) => assert.equal(shock[i] !== null, x >= 50 && x <= 100, `at ${x}`));
});

test("a field of one lattice is that of another", () => {
  const fields = ["lattice.imperfection.seed", "lattice.square.wall_thickness_mm"];
  assert.equal(placeOf("lattice.hexagon.wall_thickness_mm", fields), 1);
  assert.equal(placeOf("lattice.hexagon.side_mm", fields), -1);
});

test("every mark is an outline of its own", () => {
  assert.equal(new Set(kMarkShapes.map((shape) => markPath(shape, 4))).size, kMarkShapes.length);
  for (const shape of kMarkShapes) assert.match(markPath(shape, 4), /^M[-\d., aL]+Z$/);
});

test("the place of a URL is wanted until the crush has come so far", () => {
  for (const text of ["", "strain=", "strain=abc"]) assert.equal(placeIn(new URLSearchParams(text)), undefined);
  const player = new Player();
  player.wanted = placeIn(new URLSearchParams("strain=0.6"));
  const told = [];
  player.changes.add(() => told.push([player.value, player.wanted]));
  player.setEnd(0.2);
  player.setEnd(0.7);
  player.setEnd(0.8);
  assert.deepEqual(told, [[0.2, 0.6], [0.6, undefined], [0.6, undefined]]);
});
