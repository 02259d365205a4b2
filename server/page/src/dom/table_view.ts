// A table whose columns the user chooses and sorts by.
import { Columns, type Column } from "./columns";
import { button, h, replaceChildren, type Child } from "./element";

const kRowsAtFirst = 300;

export interface CellColumn<T> extends Column<T> { cell(row: T): Child }

export class TableView<T> {
  readonly element = h("div", { class: "table-scroll" });
  private readonly columns: Columns<T>;
  private readonly body = h("tbody");
  private readonly all = button("", () => {
    this.showsAll = true;
    this.show();
  }, { class: "quiet", hidden: true });
  private rows: T[] = [];
  private showsAll = false;

  /** `place` names the table in what the browser keeps. */
  constructor(place: string) {
    this.columns = new Columns<T>(place, () => this.show());
    this.element.append(h("table", { class: "rows" }, h("thead", {}, this.columns.head), this.body), this.all);
  }

  /** The menu of the columns. */
  get menu(): HTMLElement {
    return this.columns.menu;
  }

  update(rows: T[], columns: CellColumn<T>[]): void {
    this.rows = rows;
    this.columns.set(columns);
    this.show();
  }

  private show(): void {
    const { rows, columns } = this;
    const shown = columns.sorted(rows).slice(0, this.showsAll ? undefined : kRowsAtFirst);
    const cells = columns.shown as CellColumn<T>[];
    replaceChildren(this.body, ...shown.map((row) =>
      h("tr", {}, ...cells.map(({ figure, cell }) => h("td", { class: figure ? "figure" : "" }, cell(row))))));
    this.all.hidden = shown.length === rows.length;
    this.all.textContent = `All ${rows.length} rows`;
  }
}
