// The fit of populations: what is asked of the program, with the settings and gates of the page, and its answer.
import { fitPopulation, type PopulationAnswer } from '../api';
import { notifyFailure } from '../shell/notices';
import { store } from '../shell/store';
import { gateSettings } from './gates';
import { gates, items, moduliSettings, recordings } from './model';
import { sessionsOf } from './condition_dots';
import { settingsToSend } from './settings';

export const population = store<PopulationAnswer | null>(null);
export const populationRuns = store(false);
/** Whether the recordings of one replicate belong together. */
export const paired = store(false);
/** What the cells are: the option --model of `rheocyte population`. */
export type CellModel = 'solid' | 'effective' | 'cortex';
export const cellModel = store<CellModel>('solid');

let stopping: AbortController | null = null;

export async function computePopulation(): Promise<void> {
  stopping = new AbortController();
  populationRuns.set(true);
  try {
    const settings = { ...settingsToSend(moduliSettings.get()), ...gateSettings(gates.get()), paired: paired.get(), model: cellModel.get() };
    population.set(await fitPopulation({ conditions: sessionsOf(recordings(items.get())), settings }, stopping.signal));
  } catch (failure) {
    notifyFailure(failure);
  } finally {
    populationRuns.set(false);
  }
}

export const stopPopulation = (): void => stopping?.abort();
