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
/** Whether bulk, cortex and tensions are told of cells, in place of the modulus of solids. */
export const withCortex = store(false);

let stopping: AbortController | null = null;

export async function computePopulation(): Promise<void> {
  stopping = new AbortController();
  populationRuns.set(true);
  try {
    const settings = { ...settingsToSend(moduliSettings.get()), ...gateSettings(gates.get()), paired: paired.get(), ...(withCortex.get() && { model: 'cortex' }) };
    population.set(await fitPopulation({ conditions: sessionsOf(recordings(items.get())), settings }, stopping.signal));
  } catch (failure) {
    notifyFailure(failure);
  } finally {
    populationRuns.set(false);
  }
}

export const stopPopulation = (): void => stopping?.abort();
