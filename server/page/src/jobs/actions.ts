// What a user can do with a job in its state.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import { whyNot } from "../api/caller";
import { api, errorText } from "../api/clients";
import { idOf } from "../dom/format";
import { ask, say } from "../dom/dialog";
import type { IconName } from "../dom/icons";
import { go } from "../router";
import { hasEnded, titleOf } from "./states";
import type { JobStore } from "./store";
import { urlOf } from "../dom/base";

export interface Action {
  icon: IconName;
  label: string;
  danger?: boolean;
  why: string;  // the caller may not do it; empty if it may
  run(job: Job): Promise<void>;
}

/** Runs a call of the user; says why where the daemon refuses. */
export async function attempt(call: () => Promise<void>): Promise<void> {
  try {
    await call();
  } catch (error) {
    say(errorText(error), "error");
  }
}

export function actionsOf(job: Job, store: JobStore, removed?: () => void): Action[] {
  const why = whyNot(job.owner);
  const cancel: Action = {
    why, icon: "stop", label: "Cancel", danger: true,
    run: async (job) => {
      const agreed = job.state !== Job_State.RUNNING || await ask(`Cancel job ${idOf(job.name)}?`,
        `“${titleOf(job)}” stops within about a second. Its results so far are kept; it cannot continue.`,
        "Cancel the job");
      if (agreed) store.put(await api.jobs.cancelJob({ name: job.name }));
    },
  };
  const suspend: Action = {
    why, icon: "pause", label: "Suspend",
    run: async (job) => store.put(await api.jobs.suspendJob({ name: job.name })),
  };
  const resume: Action = {
    why, icon: "play", label: "Resume",
    run: async (job) => store.put(await api.jobs.resumeJob({ name: job.name })),
  };
  const fork: Action = {
    why: "", icon: "fork", label: "New case from this one",
    run: async (job) => go(urlOf(`/new?from=${job.name}`)),
  };
  const remove: Action = {
    why, icon: "trash", label: "Delete", danger: true,
    run: async (job) => {
      const agreed = await ask(`Delete job ${idOf(job.name)}?`,
        `“${titleOf(job)}” disappears with its result and history. This cannot be undone.`, "Delete the job");
      if (!agreed) return;
      await api.jobs.deleteJob({ name: job.name });
      store.remove(job.name);
      removed?.();
    },
  };
  if (hasEnded(job)) return [fork, remove];
  switch (job.state) {
    case Job_State.RUNNING: return [fork, suspend, cancel];
    case Job_State.PENDING: return [fork, suspend, cancel];
    case Job_State.SUSPENDED: return [fork, resume, cancel];
    default: return [fork];
  }
}
