// Lines of equal value on a grid: marching squares, segments joined to polylines.

export type Polyline = [number, number][];

/** Corner k of a cell, counter-clockwise from (0, 0). */
const corners = [
  [0, 0],
  [1, 0],
  [1, 1],
  [0, 1],
] as const;
/** For each pattern of corners above the level: pairs of sides that the line joins; side k leads from corner k to k + 1. */
const joined: number[][] = [
  [], [3, 0], [0, 1], [3, 1], [1, 2], [3, 0, 1, 2], [0, 2], [3, 2], [2, 3], [2, 0], [0, 1, 2, 3], [2, 1], [1, 3], [1, 0], [0, 3], [],
];

class Grid {
  constructor(
    readonly values: ArrayLike<number>,
    readonly columns: number,
    readonly level: number,
  ) {}

  private value(j: number, i: number): number {
    return this.values[i * this.columns + j];
  }

  pattern(j: number, i: number): number {
    return corners.reduce((sum, [a, b], k) => sum + (this.value(j + a, i + b) > this.level ? 1 << k : 0), 0);
  }

  /** The same number for the two cells that share a side. */
  sideOf(j: number, i: number, side: number): number {
    const vertical = side === 1 || side === 3;
    const column = side === 1 ? j + 1 : j;
    const row = side === 2 ? i + 1 : i;
    return 2 * (row * this.columns + column) + (vertical ? 1 : 0);
  }

  pointOn(j: number, i: number, side: number): [number, number] {
    const [a, b] = corners[side];
    const [c, d] = corners[(side + 1) % 4];
    const from = this.value(j + a, i + b);
    const fraction = (this.level - from) / (this.value(j + c, i + d) - from);
    return [j + a + fraction * (c - a), i + b + fraction * (d - b)];
  }
}

interface Segment {
  to: number;
  from: [number, number];
  end: [number, number];
}

function segmentsOf(grid: Grid, rows: number): Map<number, Segment> {
  const next = new Map<number, Segment>();
  for (let i = 0; i + 1 < rows; ++i)
    for (let j = 0; j + 1 < grid.columns; ++j) {
      const sides = joined[grid.pattern(j, i)];
      for (let k = 0; k < sides.length; k += 2)
        next.set(grid.sideOf(j, i, sides[k]), {
          to: grid.sideOf(j, i, sides[k + 1]),
          from: grid.pointOn(j, i, sides[k]),
          end: grid.pointOn(j, i, sides[k + 1]),
        });
    }
  return next;
}

/**
 * Lines where a grid (row by row) has the level, in cells from the centre of its first one. Lines end only at the rim;
 * closed ones repeat their first point.
 */
export function isolines(values: ArrayLike<number>, columns: number, rows: number, level: number): Polyline[] {
  const next = segmentsOf(new Grid(values, columns, level), rows);
  const reached = new Set([...next.values()].map((segment) => segment.to));
  const lines: Polyline[] = [];
  const follow = (start: number) => {
    const line: Polyline = [];
    for (let at = start; next.has(at); ) {
      const segment = next.get(at)!;
      next.delete(at);
      if (line.length === 0) line.push(segment.from);
      line.push(segment.end);
      at = segment.to;
    }
    lines.push(line);
  };
  for (const start of [...next.keys()]) if (!reached.has(start)) follow(start);
  for (const start of [...next.keys()]) if (next.has(start)) follow(start);
  return lines;
}
