import assert from "node:assert/strict";
import { test } from "node:test";
import { create } from "@bufbuild/protobuf";
import { CaseSchema } from "../gen/cellcrush/v1/case_pb";
import { NamedMaterialSchema } from "../gen/cellcrush/v1/cases_service_pb";
import { groupsOf, isNumber, isTable, kLatticeKinds, pathsBeside, readField, typedAt,
         writeField } from "../src/new_case/fields";
import { NamedMaterials } from "../src/new_case/named_materials";
import { helpOf, labelOf, limitsOf, placeIn } from "../src/new_case/words";

const kHardening = "material.hardening_table";
const kRate = "material.rate_table";

test("a table is read from two columns with any separator", () => {
  for (const text of ["0\t76\n0.1\t90.5", "0;76\r\n\r\n0,1;90,5\n", "0,76\n0.1,90.5", "0, 76\n0,1 90,5",
                      " 0 76 \n.1  90.5"]) {
    const value = create(CaseSchema);
    assert.ok(writeField(value, kHardening, text), text);
    const { plasticStrains, stressesMpa } = value.material.hardeningTable;
    assert.deepEqual([plasticStrains, stressesMpa], [[0, 0.1], [76, 90.5]], text);
  }
});

test("what is wrong with a table is told with its row, and changes nothing", () => {
  const value = create(CaseSchema);
  assert.ok(writeField(value, kRate, "1 1\n100 1.2"));
  const separators = "Separate them by a tab, semicolon, comma or blank.";
  for (const [text, problem] of [
    ["strain\tstress\n0\t76", "Row 1: “strain” is not a number: write digits with a point, such as 0.35 or 2e-7."],
    ["0\t76\n\n0.1", `Row 2 has 1 number, not 2. ${separators}`],
    ["0\t76\n0.1\t90\t5", `Row 2 has 3 numbers, not 2. ${separators}`],
    ["0;76\n0,05", `Row 2 has 1 number, not 2. ${separators}`],
    ["0,05,292,5", `Row 1 has 4 numbers, not 2. ${separators}`],
    ["0,76,", "Row 1: “” is not a number: write digits with a point, such as 0.35 or 2e-7."],
    ["0;1,200", "Row 1: “1,200” could be 1.2 or 1200: write 1.2 or 1200."],
  ]) {
    assert.equal(writeField(value, kRate, text), false, text);
    assert.equal(typedAt(kRate, text).problem, problem);
  }
  assert.equal(readField(value, kRate), "1\t1\n100\t1.2");
});

test("a table has its rows in the form, and its other fields until it is cleared", () => {
  const value = create(CaseSchema, {
    material: { hardeningTable: { plasticStrains: [0, 2e-7], stressesMpa: [76, 90], beyond: 3 } },
  });
  assert.equal(readField(value, kHardening), "0\t76\n2e-7\t90");
  assert.equal(readField(value, `${kHardening}.beyond`), "POWER_LAW");
  assert.ok(writeField(value, kHardening, `${readField(value, kHardening)}\n1\t95`));
  assert.deepEqual(value.material.hardeningTable.stressesMpa, [76, 90, 95]);
  assert.equal(readField(value, `${kHardening}.beyond`), "POWER_LAW");
  const inForm = groupsOf(kLatticeKinds[0]).flatMap(({ paths }) => paths);
  assert.deepEqual(pathsBeside(value, inForm), []);
  assert.ok(writeField(value, kHardening, " "));
  assert.equal(value.material.hardeningTable, undefined);
});

test("a table tells its columns, and where in them a problem is", () => {
  assert.equal(limitsOf(kHardening), "2 to 64 rows: plastic strains and stresses in MPa");
  assert.equal(limitsOf(kRate), "2 to 64 rows: rates in 1/s and factors");
  assert.match(helpOf(kRate), /^A measured factor .* Plastic strain rates, ascending. Factor at each of them/);
  assert.equal(placeIn(kHardening, `${kHardening}.stresses_mpa[0]`), "Stresses, row 1");
  assert.equal(placeIn(kRate, `${kRate}.rates_per_s`), "Rates");
  assert.equal(placeIn("lattice.grading.size_steps", "lattice.grading.size_steps[2]"), "entry 3");
  assert.equal(placeIn("depth_mm", "depth_mm"), "");
});

test("a sweep varies numbers only", () => {
  assert.ok(isTable(kRate) && !isTable("lattice.grading.size_steps"));
  assert.ok(isNumber("material.yield_stress_mpa") && isNumber("lattice.imperfection.seed"));
  for (const path of ["material.named", "material.plane", kRate, "loading.quasi_static"]) {
    assert.ok(!isNumber(path), path);
  }
});

test("the form has the failure strain, which has no unit", () => {
  const { paths } = groupsOf(kLatticeKinds[0]).find(({ title }) => title === "Material, further");
  const path = "material.failure_strain";
  assert.ok(paths.includes(path) && isNumber(path));
  assert.equal(labelOf(path), "Failure strain");
  assert.equal(limitsOf(path), "Default 0 (walls do not break); 0 to 10");
  assert.match(helpOf(path), /^Failure strain: a wall breaks where /);
});

const kSteel = create(NamedMaterialSchema, {
  name: "steel", title: "A steel", material: { youngsModulusMpa: 207000, yieldStressMpa: 250, ludwikStressMpa: 100 },
});
const kOther = create(NamedMaterialSchema, { name: "other", material: { youngsModulusMpa: 1000 } });

test("a picked material stands for all numbers, and none has those from before", () => {
  const materials = new NamedMaterials([kSteel, kOther]);
  const value = create(CaseSchema, { material: { youngsModulusMpa: 69000, hardeningModulusMpa: 700, plane: 1 } });
  const plain = { ...value.material };
  assert.equal(materials.givenAt(value, "material.youngs_modulus_mpa"), undefined);
  materials.pick(value, "steel");
  assert.equal(materials.of(value), kSteel);
  assert.deepEqual([value.material.named, value.material.youngsModulusMpa, value.material.hardeningModulusMpa],
                   ["steel", undefined, undefined]);
  assert.deepEqual(materials.givenAt(value, "material.ludwik_stress_mpa"), { text: "100", by: "steel" });
  assert.equal(materials.givenAt(value, "material.voce_stress_mpa"), undefined);
  writeField(value, "material.yield_stress_mpa", "300");
  materials.pick(value, "other");
  assert.equal(value.material.yieldStressMpa, undefined);
  writeField(value, "material.plane", "PLANE_STRAIN");
  materials.pick(value, "");
  assert.deepEqual({ ...value.material }, { ...plain, plane: 2 });
  assert.equal(limitsOf("material.youngs_modulus_mpa", "From steel"), "From steel; 1e-6 to 1e12");
});

test("a case keeps a name that the daemon does not know, and the numbers beside it", () => {
  const value = create(CaseSchema, { material: { named: "alloy", youngsModulusMpa: 500 } });
  const materials = new NamedMaterials([kSteel]);
  assert.deepEqual(materials.choicesOf(value).map((choice) => choice.value), ["steel", "alloy"]);
  assert.deepEqual(new NamedMaterials([]).choicesOf(value), []);
  assert.equal(materials.of(value), undefined);
  materials.pick(value, "");
  assert.deepEqual([value.material.named, value.material.youngsModulusMpa], ["", 500]);
});
