// Runs of the moduli of recordings: settings, progress, what came out.
import { readModuli, startModuli, stopModuli, type Moduli } from '../api';
import { notify, notifyFailure } from '../shell/notices';
import { store } from '../shell/store';
import { forgetComputed } from './columns';
import { itemOf, moduliSettings, refreshItem, titleOf } from './model';
import { settingsToSend } from './settings';

export const moduli = store<Record<number, Moduli>>({});
/** Rises when moduli of some recording are new: isoelasticity lines are read again. */
export const moduliVersion = store(0);

const watched = new Set<number>();
const pause = (milliseconds: number) => new Promise((resolve) => window.setTimeout(resolve, milliseconds));
const take = (item: number, found: Moduli) => moduli.update((all) => ({ ...all, [item]: found }));

async function finish(item: number, found: Moduli): Promise<void> {
  if (found.state === 'failed') {
    const known = itemOf(item);
    if (found.error) notify(`${known ? titleOf(known) : 'The recording'}: ${found.error}`, 'failed');
    return;
  }
  forgetComputed(item);
  await refreshItem(item);
  moduliVersion.update((version) => version + 1);
}

/** Follows a run until it ends. */
async function watch(item: number): Promise<void> {
  if (watched.has(item)) return;
  watched.add(item);
  try {
    for (;;) {
      const found = await readModuli(item);
      take(item, found);
      if (found.state !== 'running') return void (await finish(item, found));
      await pause(200);
    }
  } finally {
    watched.delete(item);
  }
}

/** What the program knows already of a recording: a run may have been started before the page was opened. */
export async function readKnownModuli(item: number): Promise<void> {
  const found = await readModuli(item);
  take(item, found);
  if (found.state === 'running') await watch(item);
  if (found.state === 'ready') moduliVersion.update((version) => version + 1);
}

export async function runModuli(numbers: number[]): Promise<void> {
  const settings = settingsToSend(moduliSettings.get());
  for (const item of numbers)
    try {
      take(item, { state: 'running', done: 0 });
      await startModuli(item, settings);
      await watch(item);
    } catch (failure) {
      take(item, { state: 'failed', done: 0, error: failure instanceof Error ? failure.message : String(failure) });
      notifyFailure(failure);
    }
}

export async function endModuli(item: number): Promise<void> {
  await stopModuli(item).catch(notifyFailure);
}
