// Jobs and sweeps in words and bars: states, causes, cases, places.
import { Job_Cause, Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { CaseWords } from "../../gen/cellcrush/v1/problem_pb";
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { Warning_Kind } from "../../gen/cellcrush/v1/sample_pb";
import { h, setText, svg } from "../dom/element";
import { duration, idOf, milliseconds } from "../dom/format";

const kWords: Record<Job_State, string> = {
  [Job_State.JOB_STATE_UNSPECIFIED]: "unknown",
  [Job_State.PENDING]: "waiting",
  [Job_State.RUNNING]: "running",
  [Job_State.SUSPENDED]: "suspended",
  [Job_State.CANCELLING]: "stopping",
  [Job_State.SUCCEEDED]: "succeeded",
  [Job_State.FAILED]: "failed",
  [Job_State.CANCELLED]: "cancelled",
};

export const stateWord = (state: Job_State): string => kWords[state];
export const kStates = [Job_State.RUNNING, Job_State.PENDING, Job_State.SUSPENDED, Job_State.CANCELLING,
                        Job_State.SUCCEEDED, Job_State.FAILED, Job_State.CANCELLED];
export const kActiveStates = kStates.slice(0, 4);

export function hasEnded(job: Job): boolean {
  return job.state >= Job_State.SUCCEEDED;
}

export function stateChip(): HTMLElement {
  return h("span", { class: "chip" });
}

export function setChip(chip: HTMLElement, state: Job_State): void {
  setText(chip, stateWord(state));
  chip.dataset.state = stateWord(state);
}

export function causeWords(cause: Job_Cause): string {
  return Job_Cause[cause].toLowerCase().replaceAll("_", " ");
}

export function warningWords(kind: Warning_Kind): string {
  const words = Warning_Kind[kind]?.toLowerCase().replaceAll("_", " ") ?? "warning";
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** A case in one line; the words are the server's. */
/** Whether a crush has strain and stresses: between plates, or between rigid walls in their place. */
export const hasStrain = (words: CaseWords | undefined): boolean =>
  words === undefined || words.plates || words.rigidWallPlates;

/** Whether a run is told over time, as experiments are: walls that go back take the strain with them. */
export function isOverTime(job: Job | undefined): boolean {
  if (!hasStrain(job?.words)) return true;
  const loading = job?.case?.loading;
  if (job?.words?.plates || !loading) return false;
  return Boolean(loading.velocityXMPerS || loading.velocityYMPerS)
    || loading.rigidWalls.some((wall) => wall.massG !== undefined || wall.velocityMPerS !== undefined);
}

export function sceneWords(words: CaseWords | undefined): string {
  return [words?.lattice, words?.loading].filter(Boolean).join(", ");
}

/** Title of a job, or its name where it has none. */
export function titleOf(job: Job): string {
  return job.title || job.case?.title || `Job ${idOf(job.name)}`;
}

/** Name of an executor other than the daemon's machine; empty for that machine, and from daemons without executors. */
export function elsewhere(executor: string): string {
  return executor === "local" ? "" : executor;
}

/** "on slurm/a: Slurm job 17, RUNNING on node1"; empty for a job on the daemon's machine. */
export function whereOf(job: Job): string {
  const executor = elsewhere(job.executor);
  return executor && `on ${executor}${job.place ? `: ${job.place}` : ""}`;
}

/** For how many seconds an ended job has run. */
export function secondsOf(job: Job): number | undefined {
  if (!job.startTime || !job.endTime) return undefined;
  return (milliseconds(job.endTime) - milliseconds(job.startTime)) / 1000;
}

export function tookText(job: Job): string {
  const seconds = secondsOf(job);
  return seconds !== undefined && seconds < 1 ? "under 1 s" : duration(seconds);
}

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

export const titleOfSweep = (sweep: Sweep): string => sweep.case?.title || `Sweep ${idOf(sweep.name)}`;

/** Paths of the varied fields of a sweep. */
export function pathsOf(sweep: Sweep): string[] {
  return sweep.axes.length ? sweep.axes.map((axis) => axis.field) : Object.keys(sweep.points[0]?.fields ?? {});
}

/** The same by the last part of their paths. */
export const variedFields = (sweep: Sweep): string[] =>
  pathsOf(sweep).map((path) => path.slice(path.lastIndexOf(".") + 1));
