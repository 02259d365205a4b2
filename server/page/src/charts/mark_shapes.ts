// Marks of points, so that curves are told apart without their colours.

export type MarkShape = "circle" | "square" | "triangle" | "diamond" | "cross" | "wedge";

/** In the order in which curves take them. */
export const kMarkShapes: MarkShape[] = ["circle", "square", "triangle", "diamond", "cross", "wedge"];

const kUnit: Record<MarkShape, [number, number][]> = {
  circle: [],
  square: [[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]],
  triangle: [[0, -1.2], [1.1, 0.75], [-1.1, 0.75]],
  diamond: [[0, -1.3], [1.1, 0], [0, 1.3], [-1.1, 0]],
  cross: [[-0.35, -1.1], [0.35, -1.1], [0.35, -0.35], [1.1, -0.35], [1.1, 0.35], [0.35, 0.35], [0.35, 1.1],
          [-0.35, 1.1], [-0.35, 0.35], [-1.1, 0.35], [-1.1, -0.35], [-0.35, -0.35]],
  wedge: [[0, 1.2], [1.1, -0.75], [-1.1, -0.75]],
};

/** Outline of a mark about the origin, as the data of an SVG path. */
export function markPath(shape: MarkShape, radius: number): string {
  const text = (value: number): string => (radius * value).toFixed(2);
  if (shape === "circle") {
    const half = (to: number): string => `a${radius},${radius} 0 1 0 ${to},0`;
    return `M${-radius},0${half(2 * radius)}${half(-2 * radius)}Z`;
  }
  return `M${kUnit[shape].map(([x, y]) => `${text(x)},${text(y)}`).join("L")}Z`;
}
