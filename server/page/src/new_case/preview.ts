// The drawing of the lattice of a case that does not run yet.
import type { Case } from "../../gen/cellcrush/v1/case_pb";
import { api } from "../api/clients";
import { latticeOf } from "../frames/lattice";
import { h, setText } from "../dom/element";
import { Picture } from "../picture/picture";
import { facesOf } from "../picture/rigid_walls";

const kMostElements = 150_000;

export class Preview {
  readonly element: HTMLElement;
  private readonly picture = new Picture("The lattice before loading");
  private readonly note = h("p", { class: "picture-note" });
  private abort = new AbortController();
  private shownKey = "";

  constructor() {
    this.picture.element.append(this.note);
    this.element = h("section", { class: "card" }, h("div", { class: "picture-box" }, this.picture.element));
  }

  /** Draws the lattice of a valid case, if it is another one than before. */
  async show(value: Case, elementCount: number): Promise<void> {
    const { lattice: walls, loading, elementsPerWall, numerics } = value;
    const hasPlates = loading?.speedMPerS !== undefined || loading?.quasiStatic;
    const parts = [walls, loading?.direction, hasPlates, loading?.rigidWalls, elementsPerWall, numerics?.fidelity];
    const key = JSON.stringify(parts, (_, part) => (typeof part === "bigint" ? `${part}` : part));
    if (key === this.shownKey) return;
    this.shownKey = key;
    this.abort.abort();
    const abort = (this.abort = new AbortController());
    if (elementCount > kMostElements) return setText(this.note, "The mesh is too large for a drawing.");
    try {
      const { mesh } = await api.cases.previewCase({ case: value }, { signal: abort.signal });
      if (!mesh || abort.signal.aborted) return;
      setText(this.note, "");
      this.picture.setLattice(latticeOf(mesh));
      this.picture.showUndeformed(facesOf(value));
    } catch {
      this.shownKey = ""; // the check has told the problem; the next change draws again
    }
  }

  destroy(): void {
    this.abort.abort();
    this.picture.destroy();
  }
}
