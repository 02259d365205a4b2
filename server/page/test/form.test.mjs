import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { create } from "@bufbuild/protobuf";
import { CaseSchema, Frame_RigidWallSchema, Lattice_HexagonSchema,
         Lattice_InclusionsSchema } from "../gen/cellcrush/v1/case_pb";
import { printable } from "../src/dom/element";
import { caseValues, fieldAt, groupsOf, isNumber, kLatticeKinds, linesOf, pathsBeside, readField, typedAt,
         writeField } from "../src/new_case/fields";
import { baseOf, pathIn } from "../src/dom/base";
import { labelsOf } from "../src/new_case/order";
import { axisOf, axisText, jobCount } from "../src/new_case/sweep_axis";
import { readReal, readWhole } from "../src/new_case/typed_number";
import { defaultOf, helpOf, labelOf, limitsOf, unitOf } from "../src/new_case/words";

const hexagons = () => create(CaseSchema, {
  lattice: { kind: { case: "hexagon", value: create(Lattice_HexagonSchema, { columns: 20 }) } },
});

test("every field of the form is in the protos and has help", () => {
  for (const kind of kLatticeKinds) {
    for (const path of groupsOf(kind).flatMap((group) => group.paths)) {
      assert.ok(fieldAt(path).field, path);
      assert.ok(helpOf(path).length > 10, path);
      assert.ok(labelOf(path), path);
    }
  }
  assert.equal(unitOf("loading.speed_m_per_s"), "m/s");
  assert.equal(defaultOf("loading.end_strain"), "0.8, or less where the lattice is closed");
  assert.equal(defaultOf("depth_mm"), "required");
  assert.equal(limitsOf("depth_mm"), "Required, 1e-6 to 1e12");
  assert.equal(
    limitsOf("loading.end_strain"),
    "Default 0.8, or less where the lattice is closed; 0.0001 to below 0.95",
  );
  assert.equal(limitsOf("lattice.hexagon.wall_thickness_mm"), "Required, 1e-6 to half of side_mm");
  assert.equal(limitsOf("output.sample_count"), "Default 1000; 10 to 100000");
  assert.equal(limitsOf("loading.end_time_s"), "Required without plates only; 1e-12 to 1e12");
  assert.equal(unitOf("loading.gravity_x_m_per_s2"), "m/s²");
});

test("fields are written and read by path, and cleared by an empty text", () => {
  const value = hexagons();
  assert.ok(writeField(value, "loading.speed_m_per_s", "12.5"));
  assert.ok(writeField(value, "lattice.imperfection.seed", "18446744073709551615"));
  assert.ok(writeField(value, "lattice.hexagon.rows", "7"));
  assert.equal(value.loading.speedMPerS, 12.5);
  assert.equal(value.lattice.imperfection.seed, 18446744073709551615n);
  assert.equal(readField(value, "lattice.hexagon.rows"), "7");
  assert.ok(writeField(value, "loading.speed_m_per_s", ""));
  assert.equal(readField(value, "loading.speed_m_per_s"), "");
});

test("what has no field in the form stands beside it, and is removed only by name", () => {
  const [kind, frame] = ["hexagon", "frame"].map((name) => kLatticeKinds.find((each) => each.name === name));
  const inForm = groupsOf(kind).flatMap(({ paths }) => paths);
  const value = hexagons();
  for (const name of ["end_time_s", "end_at_rest", "gravity_x_m_per_s2", "gravity_y_m_per_s2"]) {
    assert.ok(inForm.includes(`loading.${name}`) && writeField(value, `loading.${name}`, "0.5"));
  }
  value.loading.rigidWalls = [1, 2, 3, 4, 5].map((id) => create(Frame_RigidWallSchema, { id: `w${id}`, normalX: -1 }));
  value.lattice.inclusions = create(Lattice_InclusionsSchema, { rows: [2, 4] });
  assert.deepEqual(pathsBeside(value, inForm), ["lattice.inclusions", "loading.rigid_walls"]);
  assert.deepEqual(linesOf(value, "lattice.inclusions"), ["rows 2, 4"]);
  assert.deepEqual(linesOf(value, "loading.rigid_walls"), [
    "id w1 normal_x -1", "id w2 normal_x -1", "id w3 normal_x -1", "and 2 more"]);
  assert.ok(writeField(value, "loading.rigid_walls", ""));
  assert.deepEqual(pathsBeside(value, inForm), ["lattice.inclusions"]);
  const paths = groupsOf(frame).flatMap((group) => group.paths);
  assert.ok(paths.includes("lattice.frame.end_time_s") && !paths.includes("loading.end_time_s"));
});

test("lists of numbers are separated by blanks, commas with blanks or semicolons", () => {
  const value = hexagons();
  for (const text of ["1 1.5 2", "1, 1.5, 2", "1; 1,5 ;2", " 1\t1.5  2 "]) {
    assert.ok(writeField(value, "lattice.grading.thickness_steps", text), text);
    assert.deepEqual(value.lattice.grading.thicknessSteps, [1, 1.5, 2]);
  }
  assert.equal(readField(value, "lattice.grading.thickness_steps"), "1, 1.5, 2");
  assert.equal(writeField(value, "lattice.grading.thickness_steps", "1 x 2"), false);
  assert.equal(typedAt("lattice.grading.thickness_steps", "1 x 2").problem,
               "has an entry, “x”, that is not a number: write digits with a point, such as 0.35 or 2e-7");
  assert.deepEqual(value.lattice.grading.thicknessSteps, [1, 1.5, 2]);
  assert.ok(writeField(value, "lattice.grading.thickness_steps", ""));
  assert.deepEqual(value.lattice.grading.thicknessSteps, []);
  assert.equal(limitsOf("lattice.grading.thickness_steps"), "Default none; numbers separated by blanks, at most 1000");
  assert.ok(!isNumber("lattice.outline.corners_mm") && isNumber("lattice.outline.edge_wall_thickness_mm"));
});

test("a text that is no value of its field is refused", () => {
  const value = hexagons();
  assert.equal(writeField(value, "depth_mm", "four"), false);
  assert.equal(writeField(value, "lattice.hexagon.rows", "2.5"), false);
  assert.equal(writeField(value, "lattice.imperfection.seed", "-1"), false);
  assert.equal(writeField(value, "section.formulation", "FAST"), false);
});

test("values of a sweep: a list, ranges, seeds", () => {
  const count = (text) => jobCount([axisOf("loading.speed_m_per_s", text)]);
  assert.equal(count("25, 50, 100"), 3);
  assert.equal(count("10:200:8"), 8);
  assert.equal(axisOf("f", "10:200:8:log").values.case, "logarithmic");
  assert.equal(count("seeds:5"), 5);
  assert.equal(typeof axisOf("f", "fast"), "string");
  assert.equal(typeof axisOf("f", ""), "string");
  // Each combination of several fields is a job.
  assert.equal(jobCount([axisOf("a", "1, 2, 3"), axisOf("b", "seeds:5")]), 15);
});

test("labels are pairs of key and value", () => {
  assert.deepEqual(labelsOf(" series = a b , note=x=y,"), { series: "a b", note: "x=y" });
  for (const wrong of ["series", "=a", "a=1, a=2"]) assert.equal(typeof labelsOf(wrong), "string", wrong);
});

test("a comparison sees every field of a case but its title", () => {
  const value = hexagons();
  value.title = "one";
  assert.ok(writeField(value, "numerics.mass_damping_per_s", "40"));
  assert.ok(writeField(value, "loading.ramp_strain", "0.01"));
  assert.ok(writeField(value, "section.formulation", "DISPLACEMENT_BASED"));
  value.lattice.inclusions = create(Lattice_InclusionsSchema, { rows: [2, 4] });
  assert.deepEqual(Object.fromEntries(caseValues(value)), {
    "lattice.hexagon.columns": "20", "lattice.inclusions.rows": "2, 4", "section.formulation": "DISPLACEMENT_BASED",
    "loading.ramp_strain": "0.01", "numerics.mass_damping_per_s": "40",
  });
  value.lattice.$unknown = [{ no: 99, wireType: 2, data: new Uint8Array([2, 8, 5]) }];
  assert.equal(caseValues(value).get("lattice.99 (of a newer server)"), "2 8 5");
});

test("a text of others reorders nothing beside it", () => {
  assert.equal(printable("a\u202eb\u2066\u061c\u200f"), "a\\u202eb\\u2066\\u061c\\u200f");
  assert.equal(printable("µm – עברית 日本"), "µm – עברית 日本");
});

// The command line reads the same table (tests/client-cli/case_file_test.cpp).
test("a typed number is read by the table that the command line reads too", () => {
  const rows = readFileSync("../../tests/scenes/typed_numbers.csv", "utf8").trimEnd().split("\n").slice(1);
  assert.ok(rows.length > 30);
  for (const row of rows) {
    const [kind, text, plain, problem] = row.split(";");
    const read = kind === "whole" ? readWhole(text) : readReal(text);
    assert.deepEqual([read.plain ?? "", read.problem ?? ""], [plain, problem], row);
  }
  const value = hexagons();
  assert.equal(writeField(value, "material.yield_stress_mpa", "1,200"), false);
  assert.ok(writeField(value, "material.yield_stress_mpa", "292,5"));
  assert.equal(value.material.yieldStressMpa, 292.5);
});

test("the values of an axis are shown as they were read", () => {
  assert.equal(axisText(axisOf("f", "1,200"), "m/s"), "2 values: 1, 200 m/s");
  assert.equal(axisText(axisOf("f", "1,5; 2"), "m/s"), "2 values: 1.5, 2 m/s");
  assert.equal(axisText(axisOf("f", "10:200:8"), "mm"), "8 values, 10 mm to 200 mm");
  assert.match(axisOf("f", "1,200; 2"), /could be 1.2 or 1200/);
});

test("addresses of the page lie below the path at which its script is served", () => {
  assert.equal(baseOf("https://site.example/node/host/8080/app.js"), "/node/host/8080");
  assert.equal(baseOf("http://127.0.0.1:8080/app.js"), "");
  assert.equal(pathIn("/node/host/8080/jobs/3", "/node/host/8080"), "/jobs/3");
  assert.equal(pathIn("/node/host/8080", "/node/host/8080"), "/");
  assert.equal(pathIn("/jobs/3", ""), "/jobs/3");
});
