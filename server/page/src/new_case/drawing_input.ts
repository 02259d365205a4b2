// The lattice of a new case from a drawing: a file that is chosen, or dropped on the page.
import type { Lattice_Network } from "../../gen/cellcrush/v1/case_pb";
import { api, errorText } from "../api/clients";
import { acceptDrops } from "../dom/drops";
import { h, labelled, replaceChildren, setBanner } from "../dom/element";

const kEndings = ".csv,.json,.dxf,.svg,.inp,.msh";
const kUnits = ["mm", "cm", "m", "um", "in", "ft", "pt", "px"];
const kMostBytes = 4_000_000;

export class DrawingInput {
  readonly element: HTMLElement;
  private readonly choice = h("input", { type: "file", multiple: true, accept: kEndings, "aria-label": "Drawing" });
  private readonly unit = h("select", {}, h("option", { value: "" }, "as the file tells"),
    ...kUnits.map((unit) => h("option", { value: unit }, unit)));
  private readonly thickness = h("input", { type: "text", inputmode: "decimal", autocomplete: "off" });
  private readonly report = h("ul", { class: "drawing-report", "aria-live": "polite" });
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private files: File[] = [];
  private abort = new AbortController();

  /** `read` gets the network of a drawing, and the title that its name gives the case. */
  constructor(private readonly read: (network: Lattice_Network, title: string) => void) {
    this.choice.addEventListener("change", () => this.take([...this.choice.files ?? []]));
    for (const input of [this.unit, this.thickness]) input.addEventListener("change", () => void this.load());
    this.element = h("details", { class: "drawing-input" }, h("summary", {}, "Lattice from a drawing"),
      h("p", { class: "faint" }, "Drop a CSV, JSON, DXF, SVG, Abaqus or Gmsh file on this page, or choose it; of CSV " +
        "also two files, nodes and edges."),
      this.choice,
      h("div", { class: "fields" }, labelled("Unit of the file", this.unit),
        labelled("Thickness, where the file has none", this.thickness, undefined, "mm")),
      this.problem, this.report);
  }

  /** Reads files that are dropped on an element. */
  acceptDrops(target: HTMLElement): void {
    acceptDrops(target, (files) => this.take(files));
  }

  private take(files: File[]): void {
    if (files.length === 0) return;
    // Of two files the edges come last.
    this.files = files.sort((a, b) => Number(/edge|wall|element/i.test(a.name)) -
      Number(/edge|wall|element/i.test(b.name)));
    (this.element as HTMLDetailsElement).open = true;
    void this.load();
  }

  private async load(): Promise<void> {
    if (this.files.length === 0) return;
    this.abort.abort();
    const abort = (this.abort = new AbortController());
    replaceChildren(this.report);
    const text = this.thickness.value.trim().replace(",", ".");
    const thicknessMm = text === "" ? undefined : Number(text);
    if (thicknessMm !== undefined && !(thicknessMm > 0)) {
      return setBanner(this.problem, "The thickness is not a positive number of mm.");
    }
    if (this.files.reduce((bytes, { size }) => bytes + size, 0) > kMostBytes) {
      return setBanner(this.problem, "The drawing is larger than 4 MB. Give it to `cellcrush submit --lattice`.");
    }
    try {
      const files = await Promise.all(this.files.map(async (file) =>
        ({ name: file.name, content: new Uint8Array(await file.arrayBuffer()) })));
      const { network, report } = await api.cases.importLattice({ files, unit: this.unit.value, thicknessMm },
                                                                { signal: abort.signal });
      if (abort.signal.aborted || !network || !report) return;
      setBanner(this.problem, "");
      replaceChildren(this.report, ...report.lines.map((line) => h("li", {}, line)));
      this.read(network, this.files[0].name.replace(/\.[^.]*$/, ""));
    } catch (error) {
      if (!abort.signal.aborted) setBanner(this.problem, errorText(error));
    }
  }

  destroy(): void {
    this.abort.abort();
  }
}
