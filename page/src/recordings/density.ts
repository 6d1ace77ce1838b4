// Density of events in the plane, for colours and contours: a kernel estimate on a grid, in linear time. The same rule
// as the pictures of `rheocyte plot`.
import type { Places } from './places';
import type { Span } from './scale';

export const densityCells = 256;

function normalKernel(width: number): Float64Array {
  const reach = Math.max(1, Math.ceil(4 * width));
  const kernel = Float64Array.from({ length: 2 * reach + 1 }, (_, k) => Math.exp(-0.5 * ((k - reach) / width) ** 2));
  const sum = kernel.reduce((a, b) => a + b, 0);
  return kernel.map((value) => value / sum);
}

/** Convolution of each row with a normal curve of so many cells; what leaves a row is lost. Writes the transpose. */
function smoothedTransposed(rows: Float64Array, width: number): Float64Array {
  const kernel = normalKernel(width);
  const reach = (kernel.length - 1) / 2;
  const n = densityCells;
  const out = new Float64Array(n * n);
  const line = new Float64Array(n + 2 * reach);
  for (let i = 0; i < n; ++i) {
    line.fill(0);
    for (let j = 0; j < n; ++j) {
      const value = rows[i * n + j];
      if (value !== 0) for (let k = 0; k < kernel.length; ++k) line[j + k] += value * kernel[k];
    }
    for (let j = 0; j < n; ++j) out[j * n + i] = line[j + reach];
  }
  return out;
}

/** Density on densityCells x densityCells cells of a rectangle, row by row from below; its greatest value. */
export class Density {
  readonly values: Float64Array;
  readonly counts = new Float64Array(densityCells * densityCells);
  readonly greatest: number;

  /** x, y: the rectangle, along the scales; the kernel's width is 0.8 n^(-1/6) times the robust spread of each coordinate. */
  constructor(
    places: Places,
    inside: Uint8Array | null,
    readonly x: Span,
    readonly y: Span,
  ) {
    const n = densityCells;
    const { counts } = this;
    const perX = n / (x.high - x.low);
    const perY = n / (y.high - y.low);
    const offX = (places.originX - x.low) * perX;
    const offY = (places.originY - y.low) * perY;
    let count = 0;
    for (let i = 0; i < places.x.length; ++i) {
      if (inside !== null && !inside[i]) continue;
      const column = places.x[i] * perX + offX;
      const row = places.y[i] * perY + offY;
      if (!(column >= 0 && column < n && row >= 0 && row < n)) continue;
      ++counts[(row | 0) * n + (column | 0)];
      ++count;
    }
    const shrink = 0.8 * Math.max(1, count) ** (-1 / 6);
    const width = (spread: number) => Math.min(n / 8, Math.max(0.8, shrink * spread));
    const [spreadX, spreadY] = marginalSpreads(counts, count);
    this.values = smoothedTransposed(smoothedTransposed(counts, width(spreadX)), width(spreadY));
    this.greatest = this.values.reduce((a, b) => Math.max(a, b), 0);
  }

  /** Bilinear between the cells' centres; beyond the rim, the rim's value. Places along the scales. */
  at(x: number, y: number): number {
    const n = densityCells;
    const column = Math.min(n - 1.001, Math.max(0, ((x - this.x.low) / (this.x.high - this.x.low)) * n - 0.5));
    const row = Math.min(n - 1.001, Math.max(0, ((y - this.y.low) / (this.y.high - this.y.low)) * n - 0.5));
    const j = column | 0;
    const i = row | 0;
    const s = column - j;
    const t = row - i;
    const at = i * n + j;
    const v = this.values;
    return (1 - t) * ((1 - s) * v[at] + s * v[at + 1]) + t * ((1 - s) * v[at + n] + s * v[at + n + 1]);
  }
}

/** Robust spreads along both axes, in cells, from the counts. */
function marginalSpreads(counts: Float64Array, count: number): [number, number] {
  const n = densityCells;
  const alongX = new Float64Array(n);
  const alongY = new Float64Array(n);
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < n; ++j) {
      alongX[j] += counts[i * n + j];
      alongY[i] += counts[i * n + j];
    }
  return [spreadOfCounts(alongX, count), spreadOfCounts(alongY, count)];
}

/** Standard deviation in cells, or what the quartiles say if that is less: single outliers must not blur everything. */
function spreadOfCounts(counts: Float64Array, count: number): number {
  if (count === 0) return 1;
  let sum = 0;
  counts.forEach((value, k) => (sum += value * k));
  const mean = sum / count;
  let squares = 0;
  counts.forEach((value, k) => (squares += value * (k - mean) ** 2));
  const spread = Math.sqrt(squares / count);
  const byQuartiles = (placeOfFraction(counts, 0.75 * count) - placeOfFraction(counts, 0.25 * count)) / 1.349;
  return byQuartiles > 0 && byQuartiles < spread ? byQuartiles : spread;
}

function placeOfFraction(counts: Float64Array, wanted: number): number {
  let sum = 0;
  for (let k = 0; k < counts.length; ++k) {
    if (sum + counts[k] >= wanted && counts[k] > 0) return k + (wanted - sum) / counts[k];
    sum += counts[k];
  }
  return counts.length;
}

/** The densities above which the given fractions of the events lie; an event has the density of its cell. */
export function levelsEnclosing({ values, counts }: Density, fractions: number[]): number[] {
  const filled = Uint32Array.from(counts.keys()).filter((cell) => counts[cell] > 0);
  filled.sort((a, b) => values[b] - values[a]);
  const total = counts.reduce((a, b) => a + b, 0);
  return fractions.map((fraction) => {
    let sum = 0;
    for (const cell of filled) {
      sum += counts[cell];
      if (sum >= fraction * total) return values[cell];
    }
    return 0;
  });
}
