// Walls drawn pixel by pixel, and what is said of pictures that are drawn slowly.
import assert from "node:assert/strict";
import test from "node:test";
import { kShades } from "../src/picture/colours";
import { Pace } from "../src/picture/player";
import { kRigid } from "../src/picture/segments";
import { drawSegments, shadesOf } from "../src/picture/walls_pixels";

const kView = { width: 200, height: 100, x: 0, y: 0, scale: 1, thinnest: 0 };

function draw(walls, view = kView) {
  const pixels = new Uint32Array(view.width * view.height);
  drawSegments(pixels, view, { count: walls.length, values: Float32Array.from(walls.flat()) }, shadesOf(false));
  return pixels;
}

const alphaOf = (pixel) => pixel >>> 24;
const area = (pixels) => pixels.reduce((sum, pixel) => sum + alphaOf(pixel) / 255, 0);
const at = (pixels, x, y, view = kView) => pixels[(view.height / 2 - y) * view.width + view.width / 2 + x];

test("a wall at any angle covers its area, with round ends", () => {
  for (const degrees of [0, 10, 45, 80, 90, 133, 180, 270]) {
    const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
    for (const [length, thickness] of [[60, 1], [60, 3], [60, 12], [0, 8]]) {
      const [x, y] = [0.5 * length * c, 0.5 * length * s];
      const covered = area(draw([[-x, -y, x, y, thickness, 0]]));
      const exact = length * thickness + (Math.PI * thickness * thickness) / 4;
      // A wall as wide as a pixel has few pixels across it, and at 45 degrees 12 % too much. Ends are a little smaller.
      const error = thickness === 1 ? 0.13 : 0.05;
      assert.ok(Math.abs(covered - exact) < error * exact, `${degrees} degrees, ${length} x ${thickness}: ${covered}`);
    }
  }
});

test("a rigid wall has the colour of the plates, whatever the plastic fractions", () => {
  const colour = (share) => at(draw([[-30, 0, 30, 0, 8, share]]), 0, 0) & 0xffffff;
  assert.equal(colour(kRigid), 91 | (97 << 8) | (108 << 16));
  for (const share of [0, 0.5, 1]) assert.notEqual(colour(share), colour(kRigid));
});

test("y points up, and x to the right", () => {
  const pixels = draw([[10, 20, 40, 20, 4, 0]]);
  assert.equal(alphaOf(at(pixels, 25, 20)), 255);
  for (const [x, y] of [[25, -20], [-25, 20], [60, 20], [0, 20]]) assert.equal(alphaOf(at(pixels, x, y)), 0);
});

test("zooming in shows the point at the centre, as wide as it is", () => {
  const view = { ...kView, x: 30, y: 5, scale: 10 };
  const pixels = draw([[0, 5, 100, 5, 1, 0]], view);
  for (let y = -49; y < 50; ++y) {
    if (Math.abs(y) === 5) continue; // on the edge
    assert.equal(alphaOf(at(pixels, 0, y, view)), Math.abs(y) < 5 ? 255 : 0, `row ${y}`);
  }
});

test("thin walls keep the least thickness", () => {
  const covered = area(draw([[-30, 0.5, 30, 0.5, 0.001, 0]], { ...kView, thinnest: 2 }));
  assert.ok(Math.abs(covered - 120) < 8, String(covered));
});

test("colours follow the plastic fraction, within their ends", () => {
  const shades = shadesOf(false);
  const colourOf = (plastic) => at(draw([[-20, 0, 20, 0, 6, plastic]]), 0, 0) & 0xffffff;
  assert.equal(colourOf(0), shades[0]);
  assert.equal(colourOf(1), shades[kShades - 1]);
  assert.equal(colourOf(-0.1), shades[0]);
  assert.equal(colourOf(7), shades[kShades - 1]);
});

test("of walls that cross, the later one lies on top, and the edges of both stay smooth", () => {
  const pixels = draw([[-40, 0, 40, 0, 8, 0], [0, -40, 0, 40, 8, 1]]);
  assert.equal(at(pixels, 0, 0) & 0xffffff, shadesOf(false)[kShades - 1]);
  assert.equal(at(pixels, 20, 0) & 0xffffff, shadesOf(false)[0]);
});

test("walls beyond the view and walls without a place draw nothing", () => {
  const walls = [[500, 0, 600, 0, 3, 0], [0, -900, 10, -800, 3, 0], [NaN, 0, 1, 0, 3, 0], [0, 0, Infinity, 0, 3, 0]];
  for (const wall of walls) assert.equal(area(draw([wall])), 0);
  assert.ok(area(draw([[-1e5, 0, 1e5, 0, 2, 0]])) > 390, "a wall through the view does");
});

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
  // A pause between two plays is not slow.
  const pace = new Pace();
  noteAfter(pace, 16, 20);
  pace.stop();
  assert.equal(pace.note(60_000), "");
  assert.equal(pace.note(60_016), "");
});
