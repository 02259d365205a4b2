// The crushes of a sweep side by side, at equal strain under one slider.
import type { SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { Later } from "../dom/calls";
import { h, replaceChildren, setText } from "../dom/element";
import { given } from "../dom/format";
import { nameOf } from "../new_case/words";
import { colourLegend } from "../picture/colours";
import { Player } from "../picture/player";
import { PlayerBar } from "../picture/player_bar";
import { keepInUrl } from "../router";
import { CrushCell } from "./crush_cell";
import { isSeed } from "./points";

const kMostCells = 24;
const kLoads = 2; // at once, as browsers allow six connections to a host
const kAgainMs = 5000; // for the frames of running jobs
const kFirstStrain = 0.4;
const kUrlMs = 400;

export class CrushGrid {
  readonly element = h("section", { class: "card crush-grid", hidden: true });
  private readonly grid = h("div", { class: "cells" });
  private readonly note = h("p", { class: "faint note" });
  private readonly player = new Player();
  private readonly bar: PlayerBar;
  private cells: CrushCell[] = [];
  private cellsKey = "";
  private loads = 0;
  private again = 0;
  private readonly url = new Later(() => {
    if (this.player.wanted !== undefined) return;
    const strain = Number(this.player.value.toFixed(3));
    keepInUrl({ strain: strain === kFirstStrain ? undefined : String(strain) });
  }, kUrlMs);
  private readonly observer = new IntersectionObserver((entries) => this.see(entries), { rootMargin: "200px" });

  /** `strain` is that of the URL. */
  constructor(strain: number | undefined) {
    this.player.wanted = strain ?? kFirstStrain;
    this.bar = new PlayerBar(this.player, {
      neighbour: (direction) => this.player.value + 0.01 * direction,
      text: (value) => `strain ${value.toFixed(2)}`,
    });
    this.player.changes.add(() => this.showPlace());
    this.element.addEventListener("keydown", (event) => this.bar.key(event));
    this.element.append(h("div", { class: "picture-head" }, h("h2", {}, "Deformed shapes at equal strain"),
      h("span", { class: "spacer" }), colourLegend()), this.bar.element, this.grid, this.note);
    this.again = window.setInterval(() => this.loadNext(), kAgainMs);
  }

  /** `endStrain` is the strain at which the crushes end. */
  update(rows: SweepTable_Row[], fields: string[], endStrain: number): void {
    this.player.fullEnd = endStrain;
    const chosen = choose(rows, fields);
    const key = chosen.map((row) => row.job).join();
    if (key !== this.cellsKey) this.build(chosen, fields, key);
    const byJob = new Map(rows.map((row) => [row.job, row]));
    for (const cell of this.cells) cell.row = byJob.get(cell.row.job) ?? cell.row;
    this.element.hidden = chosen.length === 0;
    const isAll = chosen.length === rows.length;
    setText(this.note, isAll ? "" : `${chosen.length} of ${rows.length} jobs`);
    this.loadNext();
    this.showPlace();
  }

  private build(rows: SweepTable_Row[], fields: string[], key: string): void {
    this.cellsKey = key;
    this.observer.disconnect();
    for (const cell of this.cells) cell.destroy();
    const varied = fields.map((_, i) => i).filter((i) => new Set(rows.map((row) => row.values[i])).size > 1);
    this.cells = rows.map((row) => new CrushCell(row, varied.map((i) => valueWords(fields[i], row.values[i]))
      .join(", ")));
    replaceChildren(this.grid, ...this.cells.map((cell) => cell.element));
    for (const cell of this.cells) this.observer.observe(cell.element);
  }

  private see(entries: IntersectionObserverEntry[]): void {
    for (const { target, isIntersecting } of entries) {
      const cell = this.cells.find((candidate) => candidate.element === target);
      if (cell && isIntersecting) cell.isWanted = true;
    }
    this.loadNext();
  }

  private loadNext(): void {
    if (document.hidden) return;
    for (const cell of this.cells) {
      if (this.loads >= kLoads) return;
      if (!cell.needsFrames) continue;
      ++this.loads;
      void cell.load().then(() => {
        --this.loads;
        this.setEnd();
        this.loadNext();
      });
    }
  }

  private setEnd(): void {
    this.player.setEnd(Math.max(0, ...this.cells.map((cell) => cell.end)));
  }

  private showPlace(): void {
    const { value, playing } = this.player;
    for (const cell of this.cells) cell.showAt(value);
    if (!playing && this.player.wanted === undefined) this.url.afresh();
    else this.url.stop();
  }

  destroy(): void {
    clearInterval(this.again);
    this.url.stop();
    this.observer.disconnect();
    this.player.destroy();
    for (const cell of this.cells) cell.destroy();
  }
}

// A value with its unit, as "speed 50 m/s".
function valueWords(path: string, value: number): string {
  const { words, unit } = nameOf(path);
  return `${words} ${given(value)} ${unit}`.trim();
}

// The rows to show, by their values: of too many, as many seeds of each combination as fit, or evenly spaced ones.
function choose(rows: SweepTable_Row[], fields: string[]): SweepTable_Row[] {
  const sorted = [...rows].sort((a, b) => {
    const at = a.values.findIndex((value, i) => value !== b.values[i]);
    return at < 0 ? 0 : a.values[at] - b.values[at];
  });
  if (sorted.length <= kMostCells) return sorted;
  const combinations = new Map<string, SweepTable_Row[]>();
  for (const row of sorted) {
    const key = row.values.filter((_, i) => !isSeed(fields[i])).join();
    combinations.set(key, [...(combinations.get(key) ?? []), row]);
  }
  const seeds = Math.max(1, Math.floor(kMostCells / combinations.size));
  const candidates = [...combinations.values()].flatMap((members) => members.slice(0, seeds));
  if (candidates.length <= kMostCells) return candidates;
  return Array.from({ length: kMostCells }, (_, i) =>
    candidates[Math.round((i * (candidates.length - 1)) / (kMostCells - 1))]);
}
