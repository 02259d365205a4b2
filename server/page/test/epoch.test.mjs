import assert from "node:assert/strict";
import { test } from "node:test";
import { Code, ConnectError } from "@connectrpc/connect";
import { otherServer, withEpoch } from "../src/api/epoch";

test("calls name the server that answered first, and the first answer of another one is told once", async () => {
  const named = [];
  let told = 0;
  otherServer.add(() => ++told);
  const headers = (epoch) => new Headers(epoch ? { "cellcrush-epoch": epoch } : {});
  const call = (answer) => withEpoch(async (request) => {
    named.push(request.header.get("cellcrush-epoch"));
    return answer();
  })({ header: new Headers() });
  const succeed = (epoch) => call(() => ({ header: headers(epoch) }));
  const fail = (epoch) => call(() => {
    throw new ConnectError("refused", Code.FailedPrecondition, headers(epoch));
  });
  await succeed("");
  await succeed("first");
  await succeed("first");
  await assert.rejects(fail("first"));
  await assert.rejects(call(() => { throw new TypeError("away"); }));
  assert.equal(told, 0);
  await assert.rejects(fail("second"));
  await succeed("second");
  assert.equal(told, 1);
  assert.deepEqual(named, [null, null, "first", "first", "first", "first", "first"]);
});
