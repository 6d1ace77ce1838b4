// The fit of populations: what is asked of the program, with the settings and gates of the page, and its answer.
import { fitPopulation, type PopulationAnswer, type PopulationCondition } from '../api';
import { notifyFailure } from '../shell/notices';
import { store } from '../shell/store';
import { gateSettings } from './gates';
import { gates, items, measured, moduliSettings, recordings } from './model';
import { fittedFeatures, sessionsOf } from './population_fits';
import { settingsToSend } from './settings';

/** With the conditions that were fitted. */
export const population = store<(PopulationAnswer & { fitted: PopulationCondition[] }) | null>(null);
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
    const answer = await fitPopulation({ conditions, settings }, stopping.signal);
    const features = fittedFeatures(answer.record);
    population.set({ ...answer, fitted: conditions });
    if (features.length > 0 && !features.includes(measured.get())) measured.set(features[0]);
  } catch (failure) {
    notifyFailure(failure);
  } finally {
    populationRuns.set(false);
  }
}

export const stopPopulation = (): void => stopping?.abort();
