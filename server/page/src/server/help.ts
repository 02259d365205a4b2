// Help for the page: what its parts show, and its keys.
import { h } from "../dom/element";
import type { View } from "../router";

const kParts: [string, [string, string][]][] = [
  ["Jobs and sweeps", [
    ["Unfold a sweep", "The arrow before its title. Its rows show varied fields, progress and the plateau so far."],
    ["Sort", "Click the head of a column: up, down, back to the order of the list."],
    ["Columns", "The menu over a table. The browser keeps the choice."],
    ["Filter", "Part of a title; or state = FAILED, owner = \"NAME\", label.KEY = \"VALUE\", joined by AND."],
    ["Compare", "Select two to six jobs. The table lists what differs in cases and results."],
    ["Note", "“Note, labels and priority” of a new case: a sentence that stands beside the job’s title."],
  ]],
  ["Charts", [
    ["Zoom", "Drag a box, or turn the wheel. + and - zoom at the keyboard."],
    ["Show all", "Double click, the button, or 0."],
    ["Playhead", "Click, or drag the line. Picture and charts move together."],
    ["Scales and measures", "The lists over a chart: linear or logarithmic axes, and any number of the results."],
    ["A point of a sweep", "A click opens its job; for a mean, it lists the jobs."],
    ["The map of two fields", "A cell opens its job; with several seeds, it compares them."],
  ]],
  ["Picture", [
    ["Play", "Space plays and pauses; the arrow keys step through frames; Home and End go to the ends."],
    ["Zoom", "Wheel, pinch, + and -. Double click shows the whole crush."],
    ["Numbers of a wall", "Point at it, or tap it."],
  ]],
  ["Words and numbers", [
    ["Plateau stress", "Mean stress at a plate from 20 to 40 % strain."],
    ["Shock theory (Eq. 51)", "Gibson-Ashby stress plus the density times the square of the speed over the " +
      "densification strain."],
    ["Units", "Stresses below 0.1 MPa are in kPa; energies are in mJ, J or kJ by their size."],
    ["Fields of a case", "The form of a new case explains each field while it has the focus."],
  ]],
];

export class HelpPage implements View {
  readonly title = "Help";
  readonly element = h("div", { class: "page help-page" }, h("h1", {}, this.title),
    h("div", { class: "server-grid" }, ...kParts.map(([name, items]) => h("section", { class: "card" },
      h("h2", {}, name), h("dl", { class: "facts" }, ...items.map(([term, text]) =>
        h("div", {}, h("dt", {}, term), h("dd", {}, text))))))));

  destroy(): void {}
}
