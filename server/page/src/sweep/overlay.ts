// Other sweeps over the same field, in the chart of a sweep: which of them, and why not others.
import type { Sweep } from "../../gen/cellcrush/v1/sweep_pb";
import { api, errorText, ifAny, isNotFound } from "../api/clients";
import { Later, Listeners } from "../dom/calls";
import { idOf, pathOf } from "../dom/format";
import { watch } from "../api/watch";
import { h, replaceChildren } from "../dom/element";
import { iconButton } from "../dom/icons";
import { pathsOf, titleOfSweep } from "../jobs/states";
import { loadSweep, type LoadedSweep } from "./sweep_data";
import { axisName, isSeed, kMostGroups, placeOf, type Swept } from "./points";

const kListed = 100; // sweeps that can be chosen, the newest
const kCalmMs = 1500;

export class SweepOverlay {
  readonly element = h("div", { class: "overlay" });
  /** Told when the chart has to be drawn again; `ids` may have changed. */
  readonly changes = new Listeners<void>();
  private readonly choice = h("select", { "aria-label": "Add a sweep to the chart" });
  private readonly loaded = new Map<string, LoadedSweep>();
  private readonly problems = new Map<string, string>();
  private readonly abort = new AbortController();
  private names: string[];
  private listed: Sweep[] = [];
  private path = "";
  private readonly reload = new Later(() => {
    for (const name of this.names) void this.load(name);
  }, kCalmMs);
  private readonly stops: (() => void)[];

  /** `ids` are those of the URL. */
  constructor(private readonly own: string, ids: string[]) {
    const names = [...new Set(ids.filter((id) => /^\d+$/.test(id)).map((id) => `sweeps/${id}`))];
    this.names = names.filter((name) => name !== own).slice(0, kMostGroups - 1);
    this.choice.addEventListener("change", () => this.add(this.choice.value));
    this.stops = [
      watch.freshStarts.add(() => void this.list()),
      watch.sweeps.add(() => void this.list()),
      watch.deletedSweeps.add((name) => {
        if (this.names.includes(name)) this.remove(name);
        void this.list();
      }),
      watch.jobs.add((job) => {
        if (this.names.includes(job.sweep)) this.reload.soon();
      }),
    ];
    for (const name of this.names) void this.load(name);
    void this.list();
  }

  get ids(): string[] {
    return this.names.map(idOf);
  }

  /** The field of the chart. */
  setPath(path: string): void {
    if (path === this.path) return;
    this.path = path;
    this.show();
  }

  /** The sweeps to draw beside the own one. */
  get swept(): Swept[] {
    return this.matching().map(({ sweep, ...of }) => ({ label: this.labelOf(sweep), ...of }));
  }

  private matching(): LoadedSweep[] {
    return this.names.map((name) => this.loaded.get(name))
      .filter((loaded): loaded is LoadedSweep => loaded !== undefined && placeOf(this.path, loaded.fields) >= 0);
  }

  /** The title of a sweep, with its number where another one has the same title. */
  labelOf(sweep: Sweep): string {
    const title = titleOfSweep(sweep);
    const others = [...this.listed, ...[...this.loaded.values()].map((loaded) => loaded.sweep)];
    const isShared = others.some((other) => other.name !== sweep.name && titleOfSweep(other) === title);
    return isShared ? `${title} (sweep ${idOf(sweep.name)})` : title;
  }

  private add(name: string): void {
    if (!name || this.names.includes(name)) return;
    this.names.push(name);
    void this.load(name);
    this.show();
  }

  private remove(name: string): void {
    this.names = this.names.filter((other) => other !== name);
    this.problems.delete(name);
    this.show();
    this.changes.tell();
    this.choice.focus();
  }

  private async load(name: string): Promise<void> {
    try {
      this.loaded.set(name, await loadSweep(name, this.abort.signal));
      this.problems.delete(name);
    } catch (error) {
      if (this.abort.signal.aborted) return;
      this.problems.set(name, isNotFound(error) ? "does not exist, or was deleted" : errorText(error));
    }
    this.show();
    this.changes.tell();
  }

  private async list(): Promise<void> {
    const page = await ifAny(api.sweeps.listSweeps({ pageSize: kListed }, { signal: this.abort.signal }));
    if (page) this.listed = page.sweeps;
    this.show();
  }

  // Why a sweep over these fields cannot be drawn over the field of the chart; empty if it can.
  private whyNot(paths: string[]): string {
    if (placeOf(this.path, paths) >= 0) return "";
    const varied = paths.filter((path) => !isSeed(path)).map(axisName).join(" and ") || "only seeds";
    return `varies ${varied}, not ${axisName(this.path)}`;
  }

  private show(): void {
    if (!this.path) return;
    const others = this.listed.filter((sweep) => sweep.name !== this.own && !this.names.includes(sweep.name));
    replaceChildren(this.choice, h("option", { value: "" }, "Add a sweep…"), ...others.map((sweep) => {
      const why = this.whyNot(pathsOf(sweep));
      return h("option", { value: sweep.name, disabled: why !== "" },
        `Sweep ${idOf(sweep.name)}: ${titleOfSweep(sweep)}${why && ` (${why})`}`);
    }));
    this.choice.disabled = this.names.length >= kMostGroups - 1;
    replaceChildren(this.element, others.length > 0 && this.choice, ...this.names.map((name) => this.chip(name)));
    this.element.hidden = others.length === 0 && this.names.length === 0;
  }

  private chip(name: string): HTMLElement {
    const loaded = this.loaded.get(name);
    const why = this.problems.get(name) ?? (loaded ? this.whyNot(loaded.fields) : "");
    const text = loaded ? `Sweep ${idOf(name)}: ${titleOfSweep(loaded.sweep)}` : `Sweep ${idOf(name)}`;
    return h("span", { class: why ? "overlaid refused" : "overlaid" },
      h("span", {}, h("a", { href: pathOf(name) }, text), why && ` ${why}.`),
      iconButton("minus", `Remove sweep ${idOf(name)}`, () => this.remove(name)));
  }

  destroy(): void {
    this.abort.abort();
    this.reload.stop();
    for (const stop of this.stops) stop();
  }
}
