// One row of the table of jobs.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { Queue_Entry } from "../../gen/cellcrush/v1/admin_service_pb";
import { h, printable, setText } from "../dom/element";
import { clock, duration, fullTime, idOf, pathOf, quantity, strainText } from "../dom/format";
import { iconButton } from "../dom/icons";
import { kMeasures, textWithUnit } from "../job/measures";
import { actionsOf, attempt } from "./actions";
import { elsewhere, hasEnded, sceneWords, setChip, stateChip, titleOf, tookText, whereOf } from "./states";
import type { JobStore } from "./store";

function stateNote(job: Job, entry: Queue_Entry | undefined): string {
  if (job.state === Job_State.PENDING) return entry?.reason || job.causeMessage;
  if (job.progress?.stalled) return "The worker has not reported for some seconds.";
  return job.causeMessage;
}

export const impactOf = ({ summary, progress }: Job): number | undefined =>
  summary ? summary.plateauStressImpactMpa : progress?.plateauSoFarMpa;

/** Those of a summary that have no cell of their own. */
export const kMoreMeasures = kMeasures.slice(2);

function setStress(cell: HTMLElement, value: number | undefined): void {
  setText(cell, quantity(value, "MPa"));
  cell.classList.toggle("missing", value === undefined);
}

export class JobRow {
  readonly element: HTMLTableRowElement;
  readonly select = h("input", { type: "checkbox", class: "select" });
  private readonly title = h("a", { class: "job-title" });
  private readonly name = h("span", { class: "faint" });
  private readonly sweep = h("a", { class: "faint" });
  private readonly ownNote = h("div", { class: "job-note" });
  private readonly about = h("span", { class: "faint" });
  private readonly where = h("span", { class: "faint" });
  private readonly chip = stateChip();
  private readonly note = h("div", { class: "note" });
  private readonly bar = h("progress", { max: 1 });
  private readonly strain = h("span", { class: "strain" });
  private readonly time = h("td", { class: "figure", "data-label": "time" });
  private readonly impact = h("td", { class: "figure", "data-label": "impact plateau" });
  private readonly support = h("td", { class: "figure", "data-label": "support plateau" });
  private readonly owner = h("td", { class: "owner", "data-label": "owner" });
  private readonly created = h("td", { class: "figure", "data-label": "created" });
  private readonly actions = h("td", { class: "actions" });
  private shownState = -1;

  // Those that the user can leave out, by the keys of their columns, in their order.
  private readonly cells = new Map<string, HTMLElement>([
    ["done", h("td", { class: "done" }, h("div", { class: "progress" }, this.bar, this.strain))],
    ["time", this.time], ["impact", this.impact], ["support", this.support],
    ...kMoreMeasures.map((measure): [string, HTMLElement] => [measure.field,
      h("td", { class: "figure", "data-label": measure.words })]),
    ["owner", this.owner], ["created", this.created],
  ]);

  constructor(private readonly store: JobStore) {
    this.element = h("tr", {},
      h("td", { class: "check" }, this.select),
      h("td", { class: "what" }, this.title, this.ownNote,
        h("div", { class: "under" }, this.name, this.sweep, this.about, this.where)),
      h("td", { class: "state" }, this.chip, this.note),
      ...this.cells.values(), this.actions);
  }

  /** `shown` has the keys of the columns to show. */
  update(job: Job, entry: Queue_Entry | undefined, shown: Set<string>): void {
    for (const [key, cell] of this.cells) cell.hidden = !shown.has(key);
    for (const measure of kMoreMeasures) {
      if (shown.has(measure.field)) {
        setText(this.cells.get(measure.field)!, job.summary ? textWithUnit(measure, job.summary) : "");
      }
    }
    setText(this.title, titleOf(job));
    this.title.href = pathOf(job.name);
    setText(this.name, `job ${idOf(job.name)}`);
    setText(this.sweep, job.sweep ? `sweep ${idOf(job.sweep)}` : "");
    if (job.sweep) this.sweep.href = pathOf(job.sweep);
    setText(this.about, sceneWords(job.words));
    setText(this.where, whereOf(job));
    this.select.setAttribute("aria-label", `Select job ${idOf(job.name)} to compare`);
    this.select.disabled = job.state === Job_State.PENDING;
    setChip(this.chip, job.state);
    setText(this.note, stateNote(job, entry));
    setText(this.ownNote, job.note);
    this.note.title = printable([job.causeMessage, job.remedy].filter(Boolean).join(" "));
    this.updateProgress(job);
    this.updateTime(job, entry);
    const { summary, progress } = job;
    setStress(this.impact, impactOf(job));
    this.impact.classList.toggle("so-far", !summary && progress?.plateauSoFarMpa !== undefined);
    setStress(this.support, summary?.plateauStressSupportMpa);
    setText(this.owner, job.owner);
    setText(this.created, clock(job.createTime));
    this.created.title = fullTime(job.createTime);
    this.updateActions(job);
  }

  private updateProgress(job: Job): void {
    const fraction = job.state === Job_State.SUCCEEDED ? 1 : job.progress?.fraction ?? 0;
    this.bar.value = fraction;
    const isShown = !hasEnded(job) && job.progress !== undefined;
    this.bar.hidden = !isShown;
    this.bar.setAttribute("aria-label", "progress");
    setText(this.strain, isShown ? `${Math.round(100 * fraction)} %` : "");
    this.strain.title = job.progress ? `strain ${strainText(job.progress.strain)}` : "";
  }

  private updateTime(job: Job, entry: Queue_Entry | undefined): void {
    let text = "";
    if (hasEnded(job)) text = tookText(job);
    else if (job.state === Job_State.RUNNING && job.progress) text = `${duration(job.progress.secondsLeft)} left`;
    else if (entry && elsewhere(entry.executor) && entry.secondsUntilStart === 0) text = ""; // the executor decides
    else if (entry) text = entry.secondsUntilStart < 1 ? "starts next" : `in ${duration(entry.secondsUntilStart)}`;
    setText(this.time, text);
  }

  private updateActions(job: Job): void {
    if (this.shownState === job.state) return;
    this.shownState = job.state;
    this.actions.replaceChildren(...actionsOf(job, this.store).map((action) => {
      const label = `${action.label} (job ${idOf(job.name)})`;
      const element = iconButton(action.icon, action.why ? `${label}. ${action.why}` : label, () =>
        void attempt(() => action.run(this.store.jobs.get(job.name) ?? job)));
      element.disabled = action.why !== "";
      return element;
    }));
  }
}
