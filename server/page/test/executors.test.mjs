import assert from "node:assert/strict";
import { test } from "node:test";
import { create } from "@bufbuild/protobuf";
import { JobSchema } from "../gen/cellcrush/v1/job_pb";
import { elsewhere, whereOf } from "../src/jobs/states";

test("an executor is named unless it is the daemon's machine", () => {
  assert.equal(elsewhere("slurm/a"), "slurm/a");
  assert.equal(elsewhere("local"), "");
  assert.equal(elsewhere(""), "");
  const whereIs = (job) => whereOf(create(JobSchema, job));
  assert.equal(whereIs({ executor: "local" }), "");
  assert.equal(whereIs({ executor: "slurm/a" }), "on slurm/a");
  assert.equal(whereIs({ executor: "slurm/a", place: "Slurm job 17, PENDING (Priority)" }),
               "on slurm/a: Slurm job 17, PENDING (Priority)");
});
