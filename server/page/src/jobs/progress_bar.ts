// How far a job, or a sweep, has come.
import type { Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { h } from "../dom/element";
import { duration, strainText } from "../dom/format";

function bar(fraction: number, title: string): HTMLElement {
  const element = h("progress", { max: 1, "aria-label": "progress" });
  element.value = fraction;
  return h("span", { class: "progress", title }, element, h("span", { class: "strain" },
    `${Math.floor(100 * fraction)} %`));
}

/** Of a job that has not ended. */
export function progressBar({ progress }: Job): HTMLElement {
  const left = progress?.secondsLeft ? `, ${duration(progress.secondsLeft)} left` : "";
  return bar(progress?.fraction ?? 0, `strain ${strainText(progress?.strain)}${left}`);
}

/** Share of the jobs of a sweep that have ended; running jobs count by what they have done. */
export function sweepFraction({ jobs, stateCounts }: Sweep, running: Job[]): number {
  const ended = ["SUCCEEDED", "FAILED", "CANCELLED"].reduce((sum, state) => sum + (stateCounts[state] ?? 0), 0);
  const begun = running.reduce((sum, { progress }) => sum + (progress?.fraction ?? 0), 0);
  return jobs.length ? Math.min(1, (ended + begun) / jobs.length) : 1;
}

export const sweepBar = (sweep: Sweep, running: Job[]): HTMLElement =>
  bar(sweepFraction(sweep, running), `${running.length} running`);
