// Where jobs are computed.
import type { Job } from "../../gen/cellcrush/v1/job_pb";

/** Name of an executor other than the daemon's machine; empty for that machine, and from daemons without executors. */
export function elsewhere(executor: string): string {
  return executor === "local" ? "" : executor;
}

/** "on slurm/a: Slurm job 17, RUNNING on node1"; empty for a job on the daemon's machine. */
export function whereOf(job: Job): string {
  const executor = elsewhere(job.executor);
  return executor && `on ${executor}${job.place ? `: ${job.place}` : ""}`;
}
