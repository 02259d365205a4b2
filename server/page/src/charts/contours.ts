// Contour lines of a grid of values, with a label on each level. They are interpolated between the points; squares
// with a point that has no value have none.
import { svg } from "../dom/element";
import { given } from "../dom/format";

/** Row by row from the top. */
export type Grid = (number | undefined)[][];
type Point = [number, number]; // column and row
type Line = [Point, Point];

export const kMostLevels = 8; // as the command line draws
const kClear = 0.28; // of a row, between a label and the middle of a row, where numbers stand
const kFewColumns = 6; // between whose numbers there is room
const kLabelWidth = 0.09; // of the drawing on a phone
const kLabelHeight = 0.4; // of a row

/** The lines of one level. Where they could join in two ways, the mean of the corners decides. */
export function linesAt(grid: Grid, level: number): Line[] {
  const lines: Line[] = [];
  for (let row = 0; row + 1 < grid.length; ++row) {
    for (let column = 0; column + 1 < grid[row].length; ++column) {
      const corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([right, below]): [number, number, number | undefined] =>
        [column + right, row + below, grid[row + below][column + right]]);
      const values = corners.map(([, , value]) => value).filter((value) => value !== undefined);
      if (values.length < 4) continue;
      const crossings = corners.flatMap(([x, y], i): Point[] => {
        const next = (i + 1) % 4;
        if ((values[i] < level) === (values[next] < level)) return [];
        const share = (level - values[i]) / (values[next] - values[i]);
        return [[x + share * (corners[next][0] - x), y + share * (corners[next][1] - y)]];
      });
      const mean = values.reduce((sum, value) => sum + value / 4, 0);
      if (crossings.length === 4 && (mean < level) !== (values[0] < level)) crossings.push(crossings.shift()!);
      for (let i = 0; i + 1 < crossings.length; i += 2) lines.push([crossings[i], crossings[i + 1]]);
    }
  }
  return lines;
}

const fromMiddle = (place: number): number => Math.abs(place - Math.round(place));

// The best middle of a line for its label: clear of the numbers in the cells and of other labels, far from both.
function labelPlace(lines: Line[], taken: Point[], columns: number): Point | undefined {
  const middles = lines.map(([[x0, y0], [x1, y1]]): Point => [0.5 * (x0 + x1), 0.5 * (y0 + y1)]);
  const isFree = ([x, y]: Point): boolean =>
    (fromMiddle(y) >= kClear || (columns <= kFewColumns && fromMiddle(x) >= 0.4)) &&
    taken.every((at) => Math.abs(at[0] - x) >= kLabelWidth * columns || Math.abs(at[1] - y) >= kLabelHeight);
  const clearance = ([x, y]: Point): number => fromMiddle(x) + fromMiddle(y);
  return middles.filter(isFree).sort((a, b) => clearance(b) - clearance(a))[0];
}

/** A drawing over the cells of a grid, which are equally large. */
export function contours(grid: Grid, levels: number[]): SVGElement {
  const [columns, rows] = [grid[0].length, grid.length];
  const taken: Point[] = [];
  const labels: SVGElement[] = [];
  let path = "";
  for (const level of levels) {
    const lines = linesAt(grid, level);
    for (const [[x0, y0], [x1, y1]] of lines) path += `M${x0 + 0.5} ${y0 + 0.5}L${x1 + 0.5} ${y1 + 0.5}`;
    const place = labelPlace(lines, taken, columns);
    if (!place) continue;
    taken.push(place);
    const [x, y] = place.map((at, i) => `${(100 * (at + 0.5)) / [columns, rows][i]}%`);
    labels.push(svg("text", { x, y, class: fromMiddle(place[1]) < kClear && "beside" }, given(level)));
  }
  const lines = svg("svg", { viewBox: `0 0 ${columns} ${rows}`, preserveAspectRatio: "none" },
    ...["casing", "line"].map((name) => svg("path", { d: path, class: name })));
  const drawing = svg("svg", { class: "contours", "aria-hidden": "true" }, lines, ...labels);
  drawing.style.width = `${100 * columns}%`;
  drawing.style.height = `${100 * rows}%`;
  return drawing;
}
