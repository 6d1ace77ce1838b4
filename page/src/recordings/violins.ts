// Shapes of distributions: densities along one feature, medians and quartiles with intervals, conditions from replicates.
import { describe, meanInterval, medianInterval, quantiles, valuesWithin, type Interval } from './statistics';
import { forward, type ScaleKind, type Span } from './scale';

export interface Violin {
  count: number;
  /** Density at evenly spaced places along the scale, greatest 1. */
  outline: Float64Array;
  /** Along the scale. */
  firstQuartile: number;
  thirdQuartile: number;
  /** Of the median, along the scale. */
  median: Interval;
}

export const violinCells = 120;

/** Histogram smoothed by a normal kernel of 0.9 s n^(-1/5) (Silverman's rule). */
function densityAlong(values: Float64Array, span: Span, spread: number): Float64Array {
  const counts = new Float64Array(violinCells);
  const per = violinCells / (span.high - span.low);
  for (const value of values) {
    const cell = Math.floor((value - span.low) * per);
    if (cell >= 0 && cell < violinCells) ++counts[cell];
  }
  const width = Math.max(0.7, 0.9 * spread * values.length ** -0.2 * per);
  const reach = Math.ceil(4 * width);
  const smooth = new Float64Array(violinCells);
  for (let k = 0; k < violinCells; ++k)
    for (let d = -reach; d <= reach; ++d) smooth[k] += (counts[k + d] ?? 0) * Math.exp(-0.5 * (d / width) ** 2);
  const greatest = smooth.reduce((a, b) => Math.max(a, b), 0) || 1;
  return smooth.map((value) => value / greatest);
}

/** Values within the mask, along the scale: each recording's own, before the common axis is known. */
export function valuesAlong(values: ArrayLike<number>, inside: Uint8Array | null, scale: ScaleKind): Float64Array {
  const kept = valuesWithin(values, inside);
  return scale === 'linear' ? kept : kept.map((value) => forward(scale, value)).filter(Number.isFinite);
}

export function violinOf(values: Float64Array, span: Span): Violin {
  const [firstQuartile, thirdQuartile] = quantiles(values, [0.25, 0.75]);
  const spread = Math.min(describe(values, null).standardDeviation, (thirdQuartile - firstQuartile) / 1.349 || Infinity);
  return {
    count: values.length,
    outline: densityAlong(values, span, Number.isFinite(spread) ? spread : 0),
    firstQuartile,
    thirdQuartile,
    median: medianInterval(values),
  };
}

export interface ConditionSummary {
  condition: string;
  recordings: number;
  /** Of the replicates' medians, in the feature's unit. */
  mean: Interval;
}

/** Mean of each replicate, whose recordings have the same weight; a recording without one stands for itself. */
export function repetitions(of: { replicate: string; value: number }[]): number[] {
  const groups = new Map<string, number[]>();
  of.forEach(({ replicate, value }, k) => {
    const name = replicate === '' ? `recording ${k}` : replicate;
    groups.set(name, [...(groups.get(name) ?? []), value]);
  });
  return [...groups.values()].map((values) => values.reduce((a, b) => a + b, 0) / values.length);
}

/** Replicates of a condition are its sample: the median of each, then mean and 95 % interval. */
export function byCondition(found: { condition: string; replicate: string; median: number }[]): ConditionSummary[] {
  const conditions = [...new Set(found.map((each) => each.condition))].filter((name) => name !== '');
  return conditions.map((condition) => {
    const own = found.filter((each) => each.condition === condition && Number.isFinite(each.median));
    const medians = repetitions(own.map(({ replicate, median }) => ({ replicate, value: median })));
    return { condition, recordings: own.length, mean: meanInterval(medians) };
  });
}
