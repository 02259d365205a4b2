// Positions and plastic fractions of frames, packed (FieldFrame.Packed) or plain.
import { unzlibSync } from "fflate";
import type { FieldFrame, FieldFrame_Packed } from "../../gen/cellcrush/v1/sample_pb";

export interface Fields {
  /** x0, y0, x1, y1, ... in mm: of the particles of the mesh, then of the ends that have broken off. */
  position: Float32Array;
  /** Of each element, 0 to 1. */
  plastic: Float32Array;
  /** Places in Lattice.ends of the ends that have broken off, in the order of the breaks. */
  broken: number[];
}

const kNone = 0xffffffff;

/** Of each particle the first two of lower indices that elements join it to: what to expect of its motion. */
export function guidesOf(ends: Uint32Array, particles: number): Uint32Array {
  const guides = new Uint32Array(2 * particles).fill(kNone);
  for (let e = 0; e + 1 < ends.length; e += 2) {
    const low = Math.min(ends[e], ends[e + 1]);
    const high = Math.max(ends[e], ends[e + 1]);
    if (high >= particles) continue;
    if (guides[2 * high] === kNone) guides[2 * high] = low;
    else if (guides[2 * high + 1] === kNone) guides[2 * high + 1] = low;
  }
  return guides;
}

// Adds a component of the displacements to the positions. `guides` are empty if they tell nothing.
function addDisplacements(position: Float32Array, bytes: Uint8Array, count: number, component: 0 | 1, quantum: number,
                          guides: Uint32Array): void {
  const low = component * count;
  const high = 2 * count + low;
  const numbers = new Int16Array(count);
  for (let i = 0; i < count; ++i) {
    let expected = i === 0 ? 0 : numbers[i - 1];
    if (guides.length > 0 && guides[2 * i] !== kNone) {
      expected = numbers[guides[2 * i]];
      if (guides[2 * i + 1] !== kNone) expected = (expected + numbers[guides[2 * i + 1]]) >> 1;
    }
    numbers[i] = expected + (bytes[low + i] | (bytes[high + i] << 8)); // wraps round
    position[2 * i + component] += quantum * numbers[i];
  }
}

// Those of the particles of the mesh.
function unpack(packed: FieldFrame_Packed, base: Float32Array, guides: Uint32Array): Omit<Fields, "broken"> {
  const particles = packed.particleCount;
  const elements = packed.elementCount;
  const bytes = unzlibSync(packed.data, { out: new Uint8Array(4 * particles + elements) });
  const position = base.length === 2 * particles ? base.slice() : new Float32Array(2 * particles);
  const fields = { position, plastic: new Float32Array(elements) };
  const used = packed.predictedByElements ? guides : new Uint32Array();
  addDisplacements(position, bytes, particles, 0, packed.quantumMm, used);
  addDisplacements(position, bytes, particles, 1, packed.quantumMm, used);
  for (let i = 0; i < elements; ++i) fields.plastic[i] = bytes[4 * particles + i] / 255;
  return fields;
}

function withEnds(position: Float32Array, ends: number[]): Float32Array {
  if (ends.length === 0) return position;
  const all = new Float32Array(position.length + ends.length);
  all.set(position);
  all.set(ends, position.length);
  return all;
}

/** The fields of a frame, packed or plain. `base` is Mesh.position_mm; without it packed displacements count from 0.
 *  `guides` are those of the mesh's elements. */
export function fieldsOf(frame: FieldFrame, base: Float32Array, guides: Uint32Array): Fields {
  const { position, plastic } = frame.packed ? unpack(frame.packed, base, guides)
    : { position: Float32Array.from(frame.positionMm), plastic: Float32Array.from(frame.plasticFraction) };
  return { position: withEnds(position, frame.endPositionMm), plastic, broken: frame.brokenEnd };
}
