// The drawing of the lattice of a case that does not run yet.
import { Code, ConnectError } from "@connectrpc/connect";
import type { Case } from "../../gen/cellcrush/v1/case_pb";
import { api } from "../api/clients";
import { latticeOf } from "../frames/lattice";
import { h, replaceChildren, setText } from "../dom/element";
import { legendOf } from "../picture/marks";
import { Picture } from "../picture/picture";
import { facesOf } from "../picture/rigid_walls";

const kSurelyDrawn = 150_000; // elements

export class Preview {
  readonly element: HTMLElement;
  private readonly picture = new Picture("The lattice before loading");
  private readonly note = h("p", { class: "picture-note" });
  private readonly legend = h("ul", { class: "mark-legend", "aria-label": "Marks" });
  private abort = new AbortController();
  private shownKey = "";

  constructor() {
    this.picture.element.append(this.note);
    this.element = h("section", { class: "card" }, h("div", { class: "picture-box" }, this.picture.element),
      this.legend);
  }

  /** Draws the lattice of a case that can be meshed, if it is another one than before. */
  async show(value: Case, elementCount: number): Promise<void> {
    const { lattice: walls, loading, elementsPerWall, numerics } = value;
    const hasPlates = loading?.speedMPerS !== undefined || loading?.quasiStatic;
    const parts = [walls, loading?.direction, hasPlates, loading?.rigidWalls, loading?.sides,
                   loading?.grips, elementsPerWall, numerics?.fidelity];
    const key = JSON.stringify(parts, (_, part) => (typeof part === "bigint" ? `${part}` : part));
    if (key === this.shownKey) return;
    this.shownKey = key;
    this.abort.abort();
    const abort = (this.abort = new AbortController());
    try {
      const { mesh, marks } = await api.cases.previewCase({ case: value }, { signal: abort.signal });
      if (!mesh || abort.signal.aborted) return;
      setText(this.note, "");
      this.picture.setLattice(latticeOf(mesh));
      this.picture.showUndeformed(facesOf(value), marks);
      replaceChildren(this.legend, ...legendOf(marks));
    } catch (error) {
      if (elementCount > kSurelyDrawn && ConnectError.from(error).code === Code.ResourceExhausted)
        return setText(this.note, "The mesh is too large for a drawing.");
      this.shownKey = ""; // the check has told the problem; the next change draws again
    }
  }

  destroy(): void {
    this.abort.abort();
    this.picture.destroy();
  }
}
