// What is said of pictures that are drawn slowly.
import assert from "node:assert/strict";
import test from "node:test";
import { Pace } from "../src/picture/player";

function noteAfter(pace, interval, pictures) {
  let text = "";
  for (let i = 0; i < pictures; ++i) text = pace.note(1000 + i * interval);
  return text;
}

test("a smooth picture has no note, a slow one tells its rate", () => {
  assert.equal(noteAfter(new Pace(), 16, 50), "");
  assert.equal(noteAfter(new Pace(), 250, 50), "slow drawing: 4 per second");
  assert.equal(noteAfter(new Pace(), 800, 50), "slow drawing: 1.3 per second");
  assert.equal(noteAfter(new Pace(), 800, 1), "");
});

test("a pause between two plays is not slow", () => {
  const pace = new Pace();
  noteAfter(pace, 16, 20);
  pace.stop();
  assert.equal(pace.note(60_000), "");
  assert.equal(pace.note(60_016), "");
});
