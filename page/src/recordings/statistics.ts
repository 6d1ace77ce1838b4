// What is said about the values of many events: the same numbers as the command line's (src/extract/distribution.h).

export interface Statistics {
  /** Values that are numbers and lie within the gates. */
  count: number;
  mean: number;
  /** n - 1. */
  standardDeviation: number;
  /** Of the mean. */
  standardError: number;
  median: number;
  firstQuartile: number;
  thirdQuartile: number;
}

/** The values that count: finite and, where a mask is given, marked in it. */
export function valuesWithin(values: ArrayLike<number>, inside: Uint8Array | null): Float64Array {
  const kept = new Float64Array(values.length);
  let count = 0;
  // Without branches that depend on the events: they are in no order, and a processor guesses half of them wrong.
  if (inside) {
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      kept[count] = value;
      count += inside[i] & Number(value - value === 0);
    }
  } else {
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      kept[count] = value;
      count += Number(value - value === 0);
    }
  }
  return kept.subarray(0, count);
}

/** Puts the value of rank k in its place, smaller ones before it (Hoare's selection); reorders the values. */
function select(values: Float64Array, k: number, from = 0): number {
  let low = from;
  let high = values.length - 1;
  while (low < high) {
    const pivot = values[(low + high) >> 1];
    let i = low;
    let j = high;
    while (i <= j) {
      while (values[i] < pivot) ++i;
      while (values[j] > pivot) --j;
      if (i <= j) {
        const held = values[i];
        values[i++] = values[j];
        values[j--] = held;
      }
    }
    if (k <= j) high = j;
    else if (k >= i) low = i;
    else break;
  }
  return values[k];
}

const bins = 4096;

/** Values counted into bins of equal width, so that a rank is sought in its own bin alone. */
class Ranks {
  private readonly counts = new Uint32Array(bins);
  /** of each value */
  private readonly bin: Uint16Array;

  constructor(private readonly values: Float64Array) {
    let low = Infinity;
    let high = -Infinity;
    for (let i = 0; i < values.length; ++i) {
      if (values[i] < low) low = values[i];
      if (values[i] > high) high = values[i];
    }
    const perUnit = high > low ? (bins - 1e-6) / (high - low) : 0;
    this.bin = new Uint16Array(values.length);
    for (let i = 0; i < values.length; ++i) {
      const bin = ((values[i] - low) * perUnit) | 0;
      this.bin[i] = bin;
      ++this.counts[bin];
    }
  }

  /** The values of ranks k and k + 1, counted from 0; the last one twice where there is none beyond. */
  pair(k: number): [number, number] {
    let before = 0;
    let bin = 0;
    while (before + this.counts[bin] <= k) before += this.counts[bin++];
    const own = this.inBin(bin);
    const lower = select(own, k - before);
    if (k - before + 1 < own.length) return [lower, select(own, k - before + 1, k - before + 1)];
    do ++bin;
    while (bin < bins && this.counts[bin] === 0);
    return [lower, bin < bins ? this.inBin(bin).reduce((a, b) => Math.min(a, b)) : lower];
  }

  private inBin(bin: number): Float64Array {
    const found = new Float64Array(this.counts[bin]);
    let count = 0;
    for (let i = 0; i < this.values.length && count < found.length; ++i)
      if (this.bin[i] === bin) found[count++] = this.values[i];
    return found;
  }
}

/** Quantiles, linear between two values. NaN of none. */
export function quantiles(values: Float64Array, fractions: number[]): number[] {
  if (values.length === 0) return fractions.map(() => NaN);
  const ranks = new Ranks(values);
  return fractions.map((fraction) => {
    const place = fraction * (values.length - 1);
    const below = Math.floor(place);
    const [lower, upper] = ranks.pair(below);
    return lower + (place - below) * (upper - lower);
  });
}

/** Sum with the rounding carried along: the order of the values does not matter for what is shown. */
function carefulMean(values: Float64Array): number {
  let sum = 0;
  let lost = 0;
  for (let i = 0; i < values.length; ++i) {
    const part = values[i] - lost;
    const next = sum + part;
    lost = next - sum - part;
    sum = next;
  }
  return sum / values.length;
}

function deviation(values: Float64Array, mean: number): number {
  let squares = 0;
  for (let i = 0; i < values.length; ++i) squares += (values[i] - mean) * (values[i] - mean);
  return values.length > 1 ? Math.sqrt(squares / (values.length - 1)) : NaN;
}

/** Statistics of the values within a mask. */
export function describe(values: ArrayLike<number>, inside: Uint8Array | null): Statistics {
  const kept = valuesWithin(values, inside);
  const mean = kept.length > 0 ? carefulMean(kept) : NaN;
  const standardDeviation = deviation(kept, mean);
  const [firstQuartile, median, thirdQuartile] = quantiles(kept, [0.25, 0.5, 0.75]);
  return {
    count: kept.length,
    mean,
    standardDeviation,
    standardError: standardDeviation / Math.sqrt(kept.length),
    median,
    firstQuartile,
    thirdQuartile,
  };
}

/** Two-sided 95 % points of Student's t for 1 to 30 degrees of freedom; beyond, the normal one with its first correction. */
const studentPoints = [
  12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.16, 2.145, 2.131, 2.12, 2.11, 2.101,
  2.093, 2.086, 2.08, 2.074, 2.069, 2.064, 2.06, 2.056, 2.052, 2.048, 2.045, 2.042,
];
export const studentPoint = (degrees: number): number =>
  degrees < 1 ? NaN : (studentPoints[degrees - 1] ?? 1.96 + 2.4 / degrees);

export interface Interval {
  value: number;
  low: number;
  high: number;
}

/**
 * The median and its 95 % interval from the order of the values: ranks n/2 -+ 0.98 sqrt(n), no shape of the distribution
 * supposed. Below six values there is no such interval.
 */
export function medianInterval(values: Float64Array): Interval {
  const count = values.length;
  const reach = 0.98 * Math.sqrt(count);
  const low = Math.floor(count / 2 - reach);
  const high = Math.ceil(count / 2 + reach);
  const ranks = [0.5, low / (count - 1), high / (count - 1)];
  if (low < 0 || high > count - 1) return { value: quantiles(values, [0.5])[0], low: NaN, high: NaN };
  const [value, lower, upper] = quantiles(values, ranks);
  return { value, low: lower, high: upper };
}

/** Mean of replicates with the 95 % interval by Student's t: what a condition has when its recordings are the sample. */
export function meanInterval(values: number[]): Interval {
  const own = describe(values, null);
  const reach = studentPoint(own.count - 1) * own.standardError;
  return { value: own.mean, low: own.mean - reach, high: own.mean + reach };
}
