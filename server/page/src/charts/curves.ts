// The curves of a job from its samples, as columns.
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";

/** What the curves of a job run over: strain, or for a frame of beams, whose strain is always 0, the time. */
export interface Axis {
  label: string;
  end: number;
  sample(sample: Sample): number;
  frame(frame: { strain: number; timeS: number }): number;
  text(value: number): string;
}

export function strainAxis(end: number): Axis {
  return {
    label: "nominal strain", end,
    sample: (sample) => sample.strain,
    frame: (frame) => frame.strain,
    text: (value) => `strain ${value.toFixed(3)}`,
  };
}

export function timeAxis(endSeconds: number): Axis {
  return {
    label: "time (ms)", end: 1e3 * endSeconds,
    sample: (sample) => 1e3 * sample.timeS,
    frame: (frame) => 1e3 * frame.timeS,
    text: (value) => `${value.toPrecision(3)} ms`,
  };
}

/** The samples with finite values, in the order of the axis. */
export function finite(samples: Sample[], axis: Axis): Sample[] {
  return samples.filter((s) =>
    Number.isFinite(axis.sample(s) + s.stressImpactMpa + s.stressSupportMpa + s.workExternalMj));
}
