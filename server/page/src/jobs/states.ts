// Jobs in words: states, causes, cases.
import { Job_Cause, Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { CaseWords } from "../../gen/cellcrush/v1/problem_pb";
import { Warning_Kind } from "../../gen/cellcrush/v1/sample_pb";
import { h, setText } from "../dom/element";
import { idOf } from "../api/names";

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
export function sceneWords(words: CaseWords | undefined): string {
  return [words?.lattice, words?.loading].filter(Boolean).join(", ");
}

/** Title of a job, or its name where it has none. */
export function titleOf(job: Job): string {
  return job.title || job.case?.title || `Job ${idOf(job.name)}`;
}
