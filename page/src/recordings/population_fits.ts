// Which recordings are fitted as the sessions of which condition, and the fitted medians of the number that is shown.
import type { Item, Population, PopulationCondition, PopulationRecording, PopulationRow } from '../api';
import { featureOfQuantity } from './features';

/** Recordings that have a condition, in the order of the list; those of a condition in the order of their replicates. */
export function sessionsOf(all: Item[]): PopulationCondition[] {
  const ready = all.filter((item) => item.state === 'ready' && item.condition !== '');
  return [...new Set(ready.map((item) => item.condition))].map((name) => {
    const own = ready.filter((item) => item.condition === name);
    own.sort((a, b) => a.replicate.localeCompare(b.replicate, undefined, { numeric: true }) || a.item - b.item);
    return { name, items: own.map((item) => item.item) };
  });
}

/** Recordings by condition, as the fit orders them; then those without one, which are shown and not compared. */
export function inOrderOfConditions(all: Item[]): Item[] {
  const named = sessionsOf(all).flatMap(({ items }) => items.map((number) => all.find(({ item }) => item === number)!));
  return [...named, ...all.filter((item) => item.state === 'ready' && item.condition === '')];
}

/** A number with the ends of its interval, which may be unknown. */
export interface FittedValue {
  value: number;
  low: number | null;
  high: number | null;
}

/** The number of a column with its interval, that of `ends` if it is another one; nothing where there is no number. */
export function intervalOf(row: PopulationRow, column: string, ends = column): FittedValue | undefined {
  const number = (name: string) => (row[name] ?? null) as number | null;
  const value = number(column);
  return value === null ? undefined : { value, low: number(`${ends}_low`), high: number(`${ends}_high`) };
}

/** The fit of one number. */
export interface NumberFit {
  record: Population;
  quantity: string;
  /** Of recordings by the numbers of their items. */
  medians: Map<number, { recording: PopulationRecording; median: FittedValue }>;
  /** By the names of the conditions. */
  means: Map<string, FittedValue>;
}

/** Those features whose medians were fitted, the most accurate first. */
export const fittedFeatures = (record: Population): string[] => record.quantities.map(({ quantity }) => featureOfQuantity(quantity, record.model));

/** Nothing if the fit does not determine this feature; `conditions` are those that were fitted. */
export function fitOf(record: Population, conditions: PopulationCondition[], feature: string): NumberFit | undefined {
  const place = fittedFeatures(record).indexOf(feature);
  if (place < 0) return undefined;
  const { quantity, median: column } = record.quantities[place];
  const medians: NumberFit['medians'] = new Map();
  for (const recording of record.recordings) {
    const item = conditions.find(({ name }) => name === recording.condition)?.items[recording.session - 1];
    const median = intervalOf(recording, column);
    if (item !== undefined && median) medians.set(item, { recording, median });
  }
  const means = record.conditions.flatMap((row) => {
    const mean = intervalOf(row, column);
    return mean ? [[row.condition, mean] as const] : [];
  });
  return { record, quantity, medians, means: new Map(means) };
}
