// Positions and plastic fractions of packed frames (FieldFrame.Packed).
import { unzlibSync } from "fflate";
import type { FieldFrame } from "../../gen/cellcrush/v1/sample_pb";

export interface Fields {
  /** x0, y0, x1, y1, ... in mm. */
  position: Float32Array;
  /** Of each element, 0 to 1. */
  plastic: Float32Array;
}

// The running sums of the differences of one component, times the quantum, added to the undeformed positions.
function addDisplacements(fields: Fields, bytes: Uint8Array, count: number, component: 0 | 1, quantum: number): void {
  const low = component * count;
  const high = 2 * count + low;
  let value = 0;
  for (let i = 0; i < count; ++i) {
    value = (value + (bytes[low + i] | (bytes[high + i] << 8))) & 0xffff;
    fields.position[2 * i + component] += quantum * ((value << 16) >> 16);
  }
}

/** The fields of a frame, packed or plain. `base` is Mesh.position_mm; without it packed displacements count from 0. */
export function fieldsOf(frame: FieldFrame, base: Float32Array): Fields {
  const { packed } = frame;
  if (!packed) {
    return { position: Float32Array.from(frame.positionMm), plastic: Float32Array.from(frame.plasticFraction) };
  }
  const particles = packed.particleCount;
  const elements = packed.elementCount;
  const bytes = unzlibSync(packed.data, { out: new Uint8Array(4 * particles + elements) });
  const position = base.length === 2 * particles ? base.slice() : new Float32Array(2 * particles);
  const fields = { position, plastic: new Float32Array(elements) };
  addDisplacements(fields, bytes, particles, 0, packed.quantumMm);
  addDisplacements(fields, bytes, particles, 1, packed.quantumMm);
  for (let i = 0; i < elements; ++i) fields.plastic[i] = bytes[4 * particles + i] / 255;
  return fields;
}
