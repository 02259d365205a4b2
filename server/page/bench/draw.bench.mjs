// Time to draw a frame pixel by pixel, as without a GPU: fields to segments, and segments to pixels of 1200 x 500.
import { fillSegments } from "../src/picture/segments";
import { drawSegments, shadesOf } from "../src/picture/walls_pixels";

const kPixels = { width: 1200, height: 500 };
const kSide = 4; // mm
const kFrames = 21;

/** Rows of zigzags and posts, as of hexagons: two elements a wall. */
function latticeOf(elements) {
  const rows = Math.round(Math.sqrt(elements / 24));
  const columns = Math.ceil(elements / rows / 6);
  const half = 0.5 * Math.sqrt(3) * kSide;
  const position = [];
  const ends = [];
  const addWall = (x0, y0, x1, y1) => {
    const at = position.length / 2;
    position.push(x0, y0, 0.5 * (x0 + x1), 0.5 * (y0 + y1), x1, y1);
    ends.push(at, at + 1, at + 1, at + 2);
  };
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const x = (2 * column + (row % 2)) * half;
      const y = 1.5 * kSide * row;
      addWall(x, y, x + half, y + 0.5 * kSide);
      addWall(x + half, y + 0.5 * kSide, x + 2 * half, y);
      addWall(x, y, x, y - kSide);
    }
  }
  const lattice = { ends: Uint32Array.from(ends), thickness: new Float32Array(ends.length / 2).fill(0.35) };
  return { lattice, position: Float32Array.from(position), width: 2 * half * columns, height: 1.5 * kSide * rows };
}

function timesOf(elements, zoom) {
  const { lattice, position, width, height } = latticeOf(elements);
  const fit = Math.min(kPixels.width / width, kPixels.height / height);
  const view = { ...kPixels, x: 0.5 * width, y: 0.5 * height, scale: fit * zoom, thinnest: 0.9 };
  const plastic = new Float32Array(lattice.thickness.length);
  const pixels = new Uint32Array(kPixels.width * kPixels.height);
  const shades = shadesOf(false);
  let segments;
  const times = [];
  for (let frame = 0; frame < kFrames; ++frame) {
    for (let i = 0; i < plastic.length; ++i) plastic[i] = ((i * 7919 + frame) % 1000) / 1000;
    const start = performance.now();
    segments = fillSegments(lattice, { position, plastic }, segments);
    pixels.fill(0);
    drawSegments(pixels, view, segments, shades);
    times.push(performance.now() - start);
  }
  return { count: segments.count, times: times.sort((a, b) => a - b) };
}

for (const elements of [9642, 150_000, 600_000]) {
  for (const zoom of [1, 8]) {
    const { count, times } = timesOf(elements, zoom);
    const [least, median, most] = [times[0], times[kFrames >> 1], times[kFrames - 1]].map((time) => time.toFixed(1));
    console.log(`${count} elements, zoom ${zoom}: median ${median} ms (${least} to ${most})`);
  }
}
