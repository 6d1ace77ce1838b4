// The fit of populations: what is asked of the program, with the settings and gates of the page, and its answer.
import { fitPopulation, type PopulationAnswer, type PopulationCondition } from '../api';
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
/** What the cells are: the option --model of `rheocyte population`; empty: their shapes decide. */
export type CellModel = '' | 'solid' | 'effective' | 'cortex';
export const cellModel = store<CellModel>('');
/** Of the conditions by their names, as typed: an empty one is none. */
export const doses = store<Record<string, string>>({});
export const doseUnit = store('');

/** As the options --dose and --dose-unit have them, of conditions that are there. */
function doseSettings(conditions: PopulationCondition[]): Record<string, unknown> {
  const given = conditions.filter(({ name }) => (doses.get()[name] ?? '').trim() !== '').map(({ name }) => `${name}=${doses.get()[name].trim()}`);
  return given.length === 0 ? {} : { dose: given, ...(doseUnit.get().trim() !== '' && { dose_unit: doseUnit.get().trim() }) };
}

let stopping: AbortController | null = null;

export async function computePopulation(): Promise<void> {
  stopping = new AbortController();
  populationRuns.set(true);
  try {
    const conditions = sessionsOf(recordings(items.get()));
    const settings = {
      ...settingsToSend(moduliSettings.get()),
      ...gateSettings(gates.get()),
      ...doseSettings(conditions),
      paired: paired.get(),
      ...(cellModel.get() !== '' && { model: cellModel.get() }),
    };
    population.set(await fitPopulation({ conditions, settings }, stopping.signal));
  } catch (failure) {
    notifyFailure(failure);
  } finally {
    populationRuns.set(false);
  }
}

export const stopPopulation = (): void => stopping?.abort();
