// One sweep in the list: its jobs as counts and a bar, and when it is unfolded as the table of its page.
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { errorText } from "../api/clients";
import { h, replaceChildren, setText } from "../dom/element";
import { clock, fullTime, idOf, pathOf, plural } from "../dom/format";
import { icon } from "../dom/icons";
import { SweepData } from "../sweep/sweep_data";
import { SweepTableView } from "../sweep/table";
import { sweepBar, sweepFraction } from "./progress_bar";
import { kStates, stateBar, stateWord, titleOfSweep, variedFields } from "./states";

// Rows that are unfolded stay so while the tab is open.
const unfolded = new Set<string>();

export class SweepRow {
  readonly element: HTMLTableSectionElement;
  private readonly fold: HTMLButtonElement;
  private readonly title = h("a", { class: "job-title" });
  private readonly note = h("div", { class: "job-note" });
  private readonly under = h("div", { class: "under faint" });
  private readonly states = h("td", { class: "states" });
  private readonly done = h("td", { class: "done" });
  private readonly owner = h("td", { class: "owner", "data-label": "owner" });
  private readonly created = h("td", { class: "figure", "data-label": "created" });
  private readonly inside = h("td", { class: "inside" });
  private readonly insideRow = h("tr", { class: "inside-row", hidden: true }, this.inside);
  private data: SweepData | undefined;

  constructor(private readonly name: string) {
    this.title.href = pathOf(name);
    this.fold = h("button", { type: "button", class: "icon-button fold", "aria-expanded": "false",
                              click: () => this.toggle(this.data === undefined) }, icon("next"));
    this.element = h("tbody", {}, h("tr", {},
      h("td", { class: "what" },
        h("div", { class: "foldable" }, this.fold, h("div", {}, this.title, this.note, this.under))),
      this.states, this.done, this.owner, this.created), this.insideRow);
    if (unfolded.has(name)) this.toggle(true);
  }

  update(sweep: Sweep, running: Job[], isShown: Set<string>): void {
    setText(this.title, titleOfSweep(sweep));
    setText(this.note, sweep.note);
    this.fold.setAttribute("aria-label", `Jobs of sweep ${idOf(this.name)}`);
    setText(this.under, `sweep ${idOf(this.name)} over ${variedFields(sweep).join(", ") || "points"}`);
    const words = kStates.filter((state) => sweep.stateCounts[Job_State[state]])
      .map((state) => `${sweep.stateCounts[Job_State[state]]} ${stateWord(state)}`);
    const counts = words.join(" · ") || plural(sweep.jobs.length, "job");
    if (this.states.title !== counts) {
      this.states.title = counts;
      replaceChildren(this.states, stateBar(sweep.stateCounts), h("div", { class: "faint under" }, counts));
    }
    replaceChildren(this.done, sweepFraction(sweep, []) < 1 && sweepBar(sweep, running));
    setText(this.owner, sweep.owner);
    setText(this.created, clock(sweep.createTime));
    this.created.title = fullTime(sweep.createTime);
    this.inside.colSpan = isShown.size;
    this.done.hidden = !isShown.has("done");
    this.owner.hidden = !isShown.has("owner");
    this.created.hidden = !isShown.has("created");
  }

  private toggle(isOpen: boolean): void {
    this.fold.setAttribute("aria-expanded", String(isOpen));
    this.insideRow.hidden = !isOpen;
    this.data?.destroy();
    this.data = undefined;
    if (!isOpen) {
      unfolded.delete(this.name);
      return this.inside.replaceChildren();
    }
    unfolded.add(this.name);
    const data = this.data = new SweepData(this.name);
    const table = new SweepTableView();
    const problem = h("p", { class: "faint" }, "Loading the jobs…");
    this.inside.append(h("div", { class: "toolbar" }, problem, h("span", { class: "spacer" }), table.menu),
                       table.element);
    data.changes.add(() => {
      setText(problem, data.error ? errorText(data.error) : "");
      if (data.sweep) table.update(data);
    });
  }

  destroy(): void {
    this.data?.destroy();
  }
}
