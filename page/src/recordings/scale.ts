// Axes: linear or logarithmic, and their ticks.
import { plain, rounded, tickLabels, ticks } from '../draw/numbers';

export type ScaleKind = 'linear' | 'log';

/** Ends of an axis along its scale: of a logarithmic one they are decimal logarithms. */
export interface Span {
  low: number;
  high: number;
}

export const forward = (kind: ScaleKind, value: number): number => (kind === 'log' ? Math.log10(value) : value);
export const backward = (kind: ScaleKind, place: number): number => (kind === 'log' ? 10 ** place : place);

/** The span moved and stretched about a place that stays where it is. */
export function zoomed(span: Span, factor: number, fixed: number): Span {
  return { low: fixed + (span.low - fixed) / factor, high: fixed + (span.high - fixed) / factor };
}
export function moved(span: Span, fraction: number): Span {
  const by = fraction * (span.high - span.low);
  return { low: span.low + by, high: span.high + by };
}

export interface Tick {
  /** Along the scale. */
  place: number;
  /** Empty: a line without a number. */
  label: string;
}

const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';

function powerOfTen(exponent: number): string {
  const digits = [...String(Math.abs(exponent))].map((digit) => superscripts[Number(digit)]).join('');
  return `10${exponent < 0 ? '⁻' : ''}${digits}`;
}

function linearTicks(span: Span, wanted: number): Tick[] {
  const values = ticks(span.low, span.high, wanted);
  const labels = tickLabels(values);
  return values.map((place, k) => ({ place, label: labels[k] }));
}

const label10 = (exponent: number, lead: number) =>
  exponent >= -3 && exponent <= 4 ? plain(rounded(lead * 10 ** exponent, 3)) : lead === 1 ? powerOfTen(exponent) : '';

function logTicks(span: Span, wanted: number): Tick[] {
  const length = span.high - span.low;
  if (length < 0.7) return linearOnLog(span, wanted);
  const every = Math.max(1, Math.ceil(length / wanted));
  const found: Tick[] = [];
  for (let e = Math.floor(span.low); e <= Math.ceil(span.high); ++e)
    for (const lead of every > 1 ? [1] : [1, 2, 3, 4, 5, 6, 7, 8, 9]) {
      const place = e + Math.log10(lead);
      if (place < span.low - 1e-9 || place > span.high + 1e-9) continue;
      const named = lead === 1 ? e % every === 0 : (lead === 2 || lead === 5) && length < 2.2;
      found.push({ place, label: named ? label10(e, lead) : '' });
    }
  return found;
}

function linearOnLog(span: Span, wanted: number): Tick[] {
  const ends = { low: 10 ** span.low, high: 10 ** span.high };
  return linearTicks(ends, wanted).flatMap(({ place, label }) => (place > 0 ? [{ place: Math.log10(place), label }] : []));
}

export const ticksOf = (kind: ScaleKind, span: Span, wanted: number): Tick[] =>
  kind === 'log' ? logTicks(span, wanted) : linearTicks(span, wanted);

/** 1234567 -> "1 234 567" with narrow spaces. */
export const counted = (count: number): string => String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, '\u202f');

/**
 * An axis that holds the values: 99.8 % of them with some room, so that single outliers do not squeeze the others.
 * `sorted` are values along the scale.
 */
export function spanOf(sorted: Float64Array): Span {
  if (sorted.length === 0) return { low: 0, high: 1 };
  const at = (fraction: number) => sorted[Math.round(fraction * (sorted.length - 1))];
  const low = at(sorted.length > 500 ? 0.001 : 0);
  const high = at(sorted.length > 500 ? 0.999 : 1);
  const room = 0.06 * (high - low) || Math.max(0.05 * Math.abs(high), 0.5);
  return { low: low > 0 && low < 0.35 * high ? 0 : low - room, high: high + room };
}

/** The axis of values that are not sorted, by at most 20,000 of them, evenly taken. */
export function rangeOf(values: ArrayLike<number>, scale: ScaleKind): Span {
  const every = Math.max(1, Math.floor(values.length / 20000));
  const found = new Float64Array(Math.ceil(values.length / every));
  let count = 0;
  for (let i = 0; i < values.length; i += every) {
    const place = forward(scale, values[i]);
    if (Number.isFinite(place)) found[count++] = place;
  }
  return spanOf(found.subarray(0, count).sort());
}
