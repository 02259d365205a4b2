import assert from "node:assert/strict";
import { test } from "node:test";
import { create } from "@bufbuild/protobuf";
import { SampleSchema, SummarySchema, Warning_Kind } from "../gen/cellcrush/v1/sample_pb";
import { linesAt } from "../src/charts/contours";
import { runningMean, strainAxis, thin, ticksOf } from "../src/charts/curves";
import { energyChart } from "../src/charts/energy";
import { stressChart } from "../src/charts/stress";
import { duration, number } from "../src/dom/format";

test("the moving mean of a line is the line, away from its ends", () => {
  const x = Array.from({ length: 101 }, (_, i) => i / 100);
  const mean = runningMean(x, x.map((value) => 3 * value), 0.105);
  for (let i = 10; i < 90; ++i) assert.ok(Math.abs(mean[i] - 3 * x[i]) < 1e-9);
});

test("fewer points keep the least and the greatest value", () => {
  const y = Array.from({ length: 10000 }, (_, i) => Math.sin(i));
  y[4321] = 99;
  y[777] = -99;
  const places = thin(y, 500);
  assert.ok(places.length <= 520 && places.includes(4321) && places.includes(777));
  assert.ok(places.every((place, i) => i === 0 || place > places[i - 1]));
});

test("the areas of the ledger add up to the work without the residual", () => {
  const sample = create(SampleSchema, {
    strain: 0.1, workExternalMj: 100, energyPlasticMj: 60, energyKineticMj: 20, energyElasticMj: 10,
    energyContactMj: 4, energyDampingMj: 5, energyContactDampingMj: 5, energyResidualMj: 1,
  });
  const chart = energyChart([sample], strainAxis(0.8));
  assert.ok(Math.abs(chart.columns[1][0] - 99) < 1e-9); // mJ: the highest area comes first
  assert.deepEqual(chart.series.map(({ label }) => label),
                   ["contact damping", "contact", "elastic", "kinetic", "plastic", "work of the plates"]);
});

test("a chart of stresses marks densification and where it is in doubt", () => {
  const warnings = [{ kind: Warning_Kind.BORDERS_NEAR, strain: 0.1 }, { kind: Warning_Kind.WALLS_NECK, strain: 0.3 }];
  const summary = create(SummarySchema, { densificationStrain: 0.6, warnings });
  assert.deepEqual(stressChart([], strainAxis(0.8), summary, undefined, "").marks,
                   [{ at: 0.6, label: "densification" }, { at: 0.3, label: "in doubt: walls neck" }]);
  const other = create(SummarySchema, { otherRiseStrain: 0.7, otherRiseWords: "second collapse" });
  assert.deepEqual(stressChart([], strainAxis(0.8), other, undefined, "").marks, [{ at: 0.7, label: "second collapse" }]);
});

test("numbers have three significant digits, times a unit", () => {
  assert.deepEqual([0.31437, 3.5526, 1544, 0, undefined].map((value) => number(value)),
                   ["0.314", "3.55", "1544", "0", "–"]);
  assert.deepEqual([0.05, 12, 300, 7300].map(duration), ["50 ms", "12 s", "5 min", "2 h 2 min"]);
});

test("levels are as many round numbers of the range as fit", () => {
  assert.deepEqual(ticksOf(0.205, 14.17, 8), [2, 4, 6, 8, 10, 12, 14]);
  assert.deepEqual(ticksOf(0.3, 8.7, 8), [1, 2, 3, 4, 5, 6, 7, 8]);
  assert.deepEqual(ticksOf(3, 3, 8), []);
});

test("contours lie between the points by their values, part at a saddle by its mean, and end at gaps", () => {
  assert.deepEqual(linesAt([[0, 4, 8], [0, 4, 8]], 1), [[[0.25, 0], [0.25, 1]]]);
  assert.deepEqual(linesAt([[0, 4, 8], [0, undefined, 8]], 1), []);
  const saddle = (peak) => linesAt([[0, peak], [peak, 0]], 1).map(([[x0, y0], [x1, y1]]) =>
    Math.sign((y1 - y0) / (x1 - x0)));
  assert.deepEqual(saddle(1.5), [1, 1], "low along the diagonal");
  assert.deepEqual(saddle(3), [-1, -1], "high across it");
});
