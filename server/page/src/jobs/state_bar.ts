import { Job_State } from "../../gen/cellcrush/v1/job_pb";
import { svg } from "../dom/element";
import { kStates, stateWord } from "./states";

const kWidth = 200;
const kOrder = [Job_State.SUCCEEDED, Job_State.FAILED, Job_State.CANCELLED,
                ...kStates.filter((state) => state < Job_State.SUCCEEDED)];

/** A bar with a part for each state, from the counts of a sweep by the names of the states. */
export function stateBar(counts: Record<string, number>): SVGElement {
  const total = Object.values(counts).reduce((sum, value) => sum + value, 0) || 1;
  const words: string[] = [];
  const bar = svg("svg", { class: "state-bar", viewBox: `0 0 ${kWidth} 8`, preserveAspectRatio: "none", role: "img" });
  let x = 0;
  for (const state of kOrder) {
    const value = counts[Job_State[state]] ?? 0;
    if (!value) continue;
    const width = (kWidth * value) / total;
    bar.append(svg("rect", { x, y: 0, width, height: 8, "data-state": stateWord(state) }));
    words.push(`${value} ${stateWord(state)}`);
    x += width;
  }
  bar.setAttribute("aria-label", words.join(", "));
  bar.append(svg("title", {}, words.join(", ")));
  return bar;
}
