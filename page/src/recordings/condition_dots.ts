// Which recordings are whose sessions, and where the dots of fitted populations stand.
import type { Estimate, Item, Population, PopulationCondition, PopulationRecording } from '../api';
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

/** Median of a quantity; nothing where it is not told. */
export const medianOf = (of: Record<string, unknown> | undefined, key: string): Estimate | undefined => of?.[`median_${key}`] as Estimate | undefined;

/** Sessions side by side within the slot of their condition, left of its mean; an axis that holds all intervals. */
export function dotsOf(found: Population, key: string): { dots: SessionDot[]; span: Span; slots: number } {
  const names = found.conditions.map(({ name }) => name);
  const dots = found.recordings
    .filter((recording) => medianOf(recording.population, key))
    .map((recording) => {
      const count = found.recordings.filter(({ condition }) => condition === recording.condition).length;
      return { recording, place: names.indexOf(recording.condition) + 0.16 + (0.56 * (recording.session - 0.5)) / count };
    });
  const all = [...dots.map(({ recording }) => recording.population!), ...found.conditions].flatMap((each) => {
    const modulus = medianOf(each, key);
    return modulus ? [modulus.value, modulus.lower ?? modulus.value, modulus.upper ?? modulus.value] : [];
  });
  const low = Math.min(...all);
  const high = Math.max(...all);
  const room = 0.08 * (high - low) || 0.1 * Math.abs(high) || 1;
  return { dots, span: all.length > 0 ? { low: low - room, high: high + room } : { low: 0, high: 1 }, slots: names.length };
}
