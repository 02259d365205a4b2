// Help for the page: what its parts show, and its keys.
import { h } from "../dom/element";
import type { View } from "../router";

const kParts: [string, [string, string][]][] = [
  ["Jobs and sweeps", [
    ["Unfold a sweep", "The arrow before its title. Its rows show varied fields, progress and the plateau so far."],
    ["Sort", "Click a column heading: ascending, descending, then the original order."],
    ["Columns", "The menu above a table chooses them. The browser remembers the choice."],
    ["Filter", "Part of a title; or state = FAILED, owner = \"NAME\", label.KEY = \"VALUE\", joined by AND."],
    ["Compare", "Select two to six jobs. The table lists what differs in cases and results."],
    ["Note", "Your words below the title of a job or a sweep. “Add a note” opens the editor; Ctrl-Enter saves."],
  ]],
  ["Charts", [
    ["Zoom", "Drag a box, turn the wheel, or press + and -."],
    ["Show all", "Double-click, press the button, or press 0."],
    ["Playhead", "Click, or drag the line. Picture and charts move together."],
    ["Scales and measures", "The menus above a chart choose linear or logarithmic axes, and the quantity to plot."],
    ["A point of a sweep", "Click it to open its job; for a mean, to list its jobs."],
    ["The map of two fields", "Click a cell to open its job; with several seeds, to compare them. Lines are contours " +
      "between the points. Of more fields, the menus choose two, and values for the others."],
  ]],
  ["Picture", [
    ["Play", "Space plays and pauses; the arrow keys step through frames; Home and End go to the ends."],
    ["Zoom", "Turn the wheel, pinch, or press + and -. Double-click to show the whole crush."],
    ["Values of a wall", "Point at it, or tap it."],
    ["Broken walls", "A diamond marks each end that has broken off."],
  ]],
  ["Words and numbers", [
    ["Plateau stress", "Mean stress at a plate from 20 to 40 % strain."],
    ["Shock theory (Eq. 51)", "Gibson-Ashby stress plus the density of the honeycomb times the speed " +
      "squared, divided by the densification strain."],
    ["Units", "Stresses below 0.1 MPa are in kPa; energies are in mJ, J or kJ, depending on their size."],
    ["Fields of a case", "In the form of a new case, select a field to read what it means."],
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
