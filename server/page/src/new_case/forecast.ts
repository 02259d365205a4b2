// What the check of a case predicts, before it runs.
import type { CheckCaseResponse } from "../../gen/cellcrush/v1/cases_service_pb";
import type { Problem } from "../../gen/cellcrush/v1/problem_pb";
import { h, replaceChildren, setText } from "../dom/element";
import { bytes, count, duration, number, percent } from "../dom/format";

const kRows = ["predicted time on one core", "memory", "result file", "beam elements", "time steps",
               "specimen", "relative density", "plateau by Gibson-Ashby", "plateau by shock theory (Eq. 51)",
               "elastic modulus by theory", "Poisson’s ratio by theory"];

export class Forecast {
  readonly element = h("section", { class: "card forecast" });
  private readonly values = kRows.map(() => h("dd", {}, "–"));
  private readonly notes = h("div", { class: "forecast-notes" });

  constructor() {
    this.element.append(h("h2", {}, "Before it runs"), h("dl", { class: "facts" }, ...kRows.map((name, i) =>
      h("div", {}, h("dt", {}, name), this.values[i]))), this.notes);
  }

  show(check: CheckCaseResponse, unplaced: Problem[]): void {
    const isValid = check.problems.length === 0;
    this.element.classList.toggle("stale", !isValid);
    if (isValid) {
      const { theory } = check;
      const hasTheory = theory !== undefined && theory.gibsonAshbyMpa > 0;
      const texts = [duration(check.predictedSeconds), bytes(check.predictedMemoryBytes), bytes(check.predictedBytes),
        count(check.elementCount), count(check.stepCount),
        check.lengthMm ? `${number(check.lengthMm)} × ${number(check.widthMm)} mm` : "–",
        check.relativeDensity ? percent(check.relativeDensity, 3) : "–",
        hasTheory ? `${number(theory.gibsonAshbyMpa)} MPa` : "none applies",
        hasTheory ? `${number(theory.shockMpa)} MPa` : "none applies",
        theory?.modulusMpa ? `${number(theory.modulusMpa)} MPa; across ${number(theory.modulusAcrossMpa ?? 0)} MPa`
          : "none applies",
        theory?.poissonsRatio !== undefined
          ? `${number(theory.poissonsRatio)}; across ${number(theory.poissonsRatioAcross ?? 0)}` : "none applies"];
      texts.forEach((text, i) => setText(this.values[i], text));
    }
    const entry = (problem: Problem, kind: string): HTMLElement =>
      h("div", { class: `banner ${kind}` }, problem.field === "case" ? "" : h("strong", {}, `${problem.field} `),
        `${problem.message} ${problem.remedy}`);
    const note = check.words?.theoryNote;
    replaceChildren(this.notes, note ? h("p", { class: "faint note" }, note) : null,
      ...unplaced.map((problem) => entry(problem, isValid ? "warning" : "error")));
  }
}
