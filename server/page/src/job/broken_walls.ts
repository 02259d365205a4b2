// How many walls have broken so far, and where in the run the first one did.
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";
import type { Axis } from "../charts/curves";
import { count } from "../dom/format";

export interface BrokenWalls { count: string; first: string }

/** None until a wall has broken. */
export function brokenWalls(samples: Sample[], axis: Axis): BrokenWalls | undefined {
  const last: Sample | undefined = samples[samples.length - 1];
  const first = last?.breakCount ? samples.find(({ breakCount }) => breakCount > 0n) : undefined;
  if (!first) return undefined;
  const at = axis.frame({ strain: first.strain, timeS: first.breaks[0]?.timeS ?? first.timeS });
  return { count: count(last.breakCount), first: `the first at ${axis.text(at)}` };
}
