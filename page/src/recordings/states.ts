// The states of the moduli of events: what the program says that they mean.
import { readStates, type ModulusState } from '../api';
import { notifyFailure } from '../shell/notices';
import { store } from '../shell/store';

/** In the order of their numbers; empty until the program has answered. */
export const states = store<ModulusState[]>([]);

/** Asks for them once. */
export const wantStates = (): void => void (states.get().length === 0 && readStates().then(states.set, notifyFailure));

/** Those of events by their counts: with a modulus first. */
export function countedStates(all: ModulusState[], counts: Record<string, number>): [ModulusState, number][] {
  return all
    .map((state): [ModulusState, number] => [state, counts[state.name] ?? 0])
    .filter(([, count]) => count > 0)
    .sort(([a], [b]) => Number(b.has_modulus) - Number(a.has_modulus));
}

/** What the numbers of a column "state" say, as far as they occur: "State: 0 valid; 7 unresolved: The standard ...". */
export function stateLegend(all: ModulusState[], values: ArrayLike<number>): string {
  const found = new Set<number>();
  for (let i = 0; i < values.length; ++i) found.add(values[i]);
  const told = all
    .filter(({ number }) => found.has(number))
    .map(({ number, name, sentence }) => `${number} ${name}${sentence && `: ${sentence.replace(/\.$/, '')}`}`);
  return told.length > 0 ? `State: ${told.join('; ')}` : '';
}
