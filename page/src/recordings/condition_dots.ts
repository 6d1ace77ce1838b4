// Which recordings are whose sessions, and where the dots of fitted populations stand.
import type { Item, Population, PopulationCondition, PopulationRecording, PopulationRow } from '../api';
import type { Span } from './scale';

/** Recordings that have a condition, in the order of the list; those of a condition in the order of their replicates. */
export function sessionsOf(all: Item[]): PopulationCondition[] {
  const ready = all.filter((item) => item.state === 'ready' && item.condition !== '');
  return [...new Set(ready.map((item) => item.condition))].map((name) => {
    const own = ready.filter((item) => item.condition === name);
    own.sort((a, b) => a.replicate.localeCompare(b.replicate, undefined, { numeric: true }) || a.item - b.item);
    return { name, items: own.map((item) => item.item) };
  });
}

export interface SessionDot {
  recording: PopulationRecording;
  /** In slots: condition k has those from k to k + 1. */
  place: number;
}

/** A number with the ends of its interval, which may be unknown. */
export interface Interval {
  value: number;
  low: number | null;
  high: number | null;
}

/** The number of a column with its interval, that of `ends` if it is another one; nothing where there is no number. */
export function intervalOf(row: PopulationRow, column: string, ends = column): Interval | undefined {
  const number = (name: string) => (row[name] ?? null) as number | null;
  const value = number(column);
  return value === null ? undefined : { value, low: number(`${ends}_low`), high: number(`${ends}_high`) };
}

/** Sessions side by side within the slot of their condition, left of its mean; an axis that holds all intervals. */
export function dotsOf(found: Population, median: string): { dots: SessionDot[]; span: Span; slots: number } {
  const names = found.conditions.map(({ condition }) => condition);
  const dots = found.recordings
    .filter((recording) => intervalOf(recording, median))
    .map((recording) => {
      const count = found.recordings.filter(({ condition }) => condition === recording.condition).length;
      return { recording, place: names.indexOf(recording.condition) + 0.16 + (0.56 * (recording.session - 0.5)) / count };
    });
  const all = [...dots.map(({ recording }) => recording), ...found.conditions].flatMap((each) => {
    const modulus = intervalOf(each, median);
    return modulus ? [modulus.value, modulus.low ?? modulus.value, modulus.high ?? modulus.value] : [];
  });
  const low = Math.min(...all);
  const high = Math.max(...all);
  const room = 0.08 * (high - low) || 0.1 * Math.abs(high) || 1;
  return { dots, span: all.length > 0 ? { low: low - room, high: high + room } : { low: 0, high: 1 }, slots: names.length };
}
