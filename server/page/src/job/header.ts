// The head of a job's page: title, state, progress, cause of a failure, actions.
import type { Queue_Entry } from "../../gen/cellcrush/v1/admin_service_pb";
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import { api } from "../api/clients";
import { isExported } from "../api/exported";
import { h, replaceChildren, setBanner, setText } from "../dom/element";
import { clock, count, duration, fullTime, idOf, pathOf, strainText } from "../dom/format";
import { icon } from "../dom/icons";
import { actionsOf, attempt } from "../jobs/actions";
import { NoteEditor } from "../jobs/note";
import { causeWords, hasEnded, setChip, stateChip, titleOf, whereOf } from "../jobs/states";
import type { JobStore } from "../jobs/store";
import { go } from "../router";
import { urlOf } from "../dom/base";

// An exported page has no other pages to link to.
function link(name: string, text: string): HTMLElement | string {
  return isExported ? text : h("a", { href: pathOf(name) }, text);
}

export class JobHeader {
  readonly element: HTMLElement;
  private readonly title = h("h1");
  private readonly chip = stateChip();
  private readonly note = new NoteEditor(async (note, previousNote) => {
    const job = { name: this.name, note };
    this.store.put(await api.jobs.updateJob({ job, updateMask: { paths: ["note"] }, previousNote }));
  });
  private name = "";
  private readonly about = h("p", { class: "faint about" });
  private readonly bar = h("progress", { max: 1, "aria-label": "progress" });
  private readonly progress = h("span", { class: "faint" });
  private readonly progressRow = h("div", { class: "progress-row invisible" }, this.bar, this.progress);
  private readonly actions = h("div", { class: "buttons" });
  private readonly cause = h("div", { class: "banner error", hidden: true });
  private shownState = -1;
  private aboutKey = "";

  constructor(private readonly store: JobStore) {
    this.element = h("header", { class: "job-header" },
      h("div", { class: "title-row" }, this.title, this.chip, h("span", { class: "spacer" }), this.actions),
      this.note.element, h("div", { class: "about-row" }, this.about, this.progressRow), this.cause);
  }

  /** `entry` is the place of a waiting job in the queue. */
  update(job: Job, entry: Queue_Entry | undefined): void {
    setText(this.title, titleOf(job));
    setChip(this.chip, job.state);
    this.name = job.name;
    this.note.update(job.note, job.owner);
    this.updateAbout(job);
    this.updateProgress(job, entry);
    this.updateCause(job);
    if (this.shownState === job.state) return;
    this.shownState = job.state;
    if (isExported) return;
    replaceChildren(this.actions, ...actionsOf(job, this.store, () => go(urlOf("/"))).map((action) =>
      h("button", { type: "button", class: action.danger ? "danger-quiet" : "", disabled: action.why !== "",
                    title: action.why,
                    click: () => void attempt(() => action.run(job)) }, icon(action.icon), action.label)));
  }

  private updateAbout(job: Job): void {
    const labels = Object.entries(job.labels).map(([key, value]) => `${key}=${value}`).join(", ");
    const where = whereOf(job);
    const key = [job.sweep, labels, job.owner, job.retryOf, job.attempt, job.state, where].join("\n");
    if (key === this.aboutKey) return;
    this.aboutKey = key;
    replaceChildren(this.about, `Job ${idOf(job.name)}`,
      ...(job.sweep ? [" of ", link(job.sweep, `sweep ${idOf(job.sweep)}`)] : []),
      ...(job.retryOf ? [", retry of ", link(job.retryOf, `job ${idOf(job.retryOf)}`)] : []),
      h("span", { title: fullTime(job.createTime) }, `, created ${clock(job.createTime)}`),
      job.owner ? ` by ${job.owner}` : "", where ? `, ${where}` : "", job.attempt > 1 ? `, worker ${job.attempt}` : "",
      labels ? `, labels ${labels}` : "");
  }

  private updateProgress(job: Job, entry: Queue_Entry | undefined): void {
    const { progress } = job;
    const isWaiting = job.state === Job_State.PENDING && entry !== undefined;
    this.bar.hidden = isWaiting;
    if (isWaiting) {
      this.progressRow.classList.remove("invisible");
      const start = entry.secondsUntilStart > 0 ? ` Starts in about ${duration(entry.secondsUntilStart)}.` : "";
      return setText(this.progress, entry.reason + start);
    }
    // Invisible rather than absent, so that the page does not jump when the job ends.
    this.progressRow.classList.toggle("invisible", hasEnded(job) || !progress);
    if (!progress) return;
    this.bar.value = progress.fraction;
    const left = job.state === Job_State.RUNNING ? `, ${duration(progress.secondsLeft)} left` : "";
    setText(this.progress, progress.stalled ? "The worker has not reported for some seconds."
      : `strain ${strainText(progress.strain)}, step ${count(progress.step)} of ${count(progress.stepCount)}${left}`);
  }

  private updateCause(job: Job): void {
    const text = [job.causeMessage, job.remedy].filter(Boolean).join(" ");
    this.cause.className = `banner ${job.state === Job_State.FAILED ? "error" : "warning"}`;
    const name = job.state === Job_State.FAILED ? `${causeWords(job.cause)}: ` : "";
    setBanner(this.cause, text && name + text);
  }
}
