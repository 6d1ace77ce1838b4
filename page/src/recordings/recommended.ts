// Which modulus of a recording is to be reported: what the program recommends, read from its summary here alone.
import type { Moduli } from '../api';
import { significant, withErrors } from '../draw/numbers';
import { meanInterval, type Interval } from './statistics';
import { repetitions } from './violins';

export interface Recommended {
  by: string;
  /** In kPa; NaN where no number is recommended. */
  value: number;
  /** By the scatter of the events, and by what they share. */
  errors: number[];
  /** "softer" or "stiffer" than `limit`, in kPa; empty without a bound. */
  bound: string;
  limit: number;
  /** A sentence. */
  text: string;
}

const numberOf = (value: unknown): number => (typeof value === 'number' ? value : NaN);
const textOf = (value: unknown): string => (typeof value === 'string' ? value : '');

/** Nothing before the moduli of the recording are there. */
export function recommendedOf(run: Moduli | undefined): Recommended | undefined {
  if (run?.state !== 'ready' || !run.summary) return undefined;
  const said = (name: string) => run.summary![`recommended_${name}`];
  return {
    by: textOf(said('modulus')),
    value: numberOf(said('young_modulus_median_kPa')),
    errors: ['error', 'common_error'].map((kind) => numberOf(said(`young_modulus_median_kPa_${kind}`))),
    bound: textOf(said('bound')),
    limit: numberOf(said('bound_kPa')),
    text: textOf(said('text')).replaceAll('+-', '±'),
  };
}

/** "3.934 ± 0.041 ± 0.083", "< 0.600" or "none". */
export function inShort({ value, errors, bound, limit }: Recommended): string {
  if (Number.isFinite(value)) return withErrors(value, errors);
  return bound && Number.isFinite(limit) ? `${bound === 'softer' ? '<' : '>'} ${significant(limit, 3)}` : 'none';
}

/** What a recording of a condition recommends. */
export interface RecommendedOfOne {
  replicate: string;
  found: Recommended | undefined;
}

/**
 * Mean over the replicates with its 95 % interval. NaN as soon as one recording has no number: the others would be a
 * selection by the outcome.
 */
export function meanRecommended(of: RecommendedOfOne[]): Interval {
  if (of.some(({ found }) => !found || !Number.isFinite(found.value))) return { value: NaN, low: NaN, high: NaN };
  return meanInterval(repetitions(of.map(({ replicate, found }) => ({ replicate, value: found!.value }))));
}
