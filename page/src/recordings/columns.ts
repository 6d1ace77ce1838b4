// Columns of events, fetched once and kept: in double precision, so that gates and statistics agree with the command line.
import { readEvents, type Item } from '../api';
import { notifyFailure } from '../shell/notices';
import { store } from '../shell/store';
import { isComputed } from './features';
import { readRecordings } from './model';

type Column = Float64Array;

const kept = new Map<string, Column>();
const underWay = new Map<string, AbortController>();
/** Requests for columns of a file as it was before. */
const forgotten = new WeakSet<AbortController>();
const keyOf = (item: number, feature: string) => `${item}/${feature}`;

/** Rises whenever columns have come or gone. */
export const columnsVersion = store(0);
/** How many requests are under way. */
export const loadingColumns = store(0);

const changed = () => {
  loadingColumns.set(new Set(underWay.values()).size);
  columnsVersion.update((version) => version + 1);
};

/** The column if it has arrived. */
export const column = (item: number, feature: string): Column | undefined => kept.get(keyOf(item, feature));

/** Columns of a file that has changed since it was listed are not kept: the list is read again instead. */
async function load({ item, version }: Item, features: string[], stop: AbortController): Promise<void> {
  try {
    const found = await readEvents(item, features, 'float64', stop.signal);
    if (forgotten.has(stop)) return;
    if (found.version !== version) return await readRecordings();
    found.features.forEach((feature, k) => kept.set(keyOf(item, feature), found.columns[k] as Column));
  } catch (failure) {
    if (forgotten.has(stop)) return;
    // An empty column stands for one that cannot be had: it is not asked for again until it is forgotten.
    if (!stop.signal.aborted) notifyFailure(failure);
    for (const feature of features) kept.set(keyOf(item, feature), new Float64Array(0));
  } finally {
    for (const feature of features)
      if (underWay.get(keyOf(item, feature)) === stop) underWay.delete(keyOf(item, feature));
    changed();
  }
}

/** Starts to fetch what is missing of these features, as far as the recording has them. */
export function wantColumns(item: Item, features: string[]): void {
  const offered = new Set(item.features ?? []);
  const missing = [...new Set(features)].filter(
    (feature) => offered.has(feature) && !kept.has(keyOf(item.item, feature)) && !underWay.has(keyOf(item.item, feature)),
  );
  if (missing.length === 0) return;
  const stop = new AbortController();
  for (const feature of missing) underWay.set(keyOf(item.item, feature), stop);
  loadingColumns.set(new Set(underWay.values()).size);
  void load(item, missing, stop);
}

export function stopLoading(): void {
  for (const stop of new Set(underWay.values())) stop.abort();
}

function forget(item: number, isMeant: (feature: string, values: Column) => boolean): void {
  const start = keyOf(item, '');
  for (const [key, values] of [...kept]) if (key.startsWith(start) && isMeant(key.slice(start.length), values)) kept.delete(key);
  changed();
}

/** Forgets the moduli of a recording: they are computed anew. */
export const forgetComputed = (item: number): void => forget(item, (feature, values) => isComputed(feature) || values.length === 0);

/** Forgets all columns of a recording, those that are on their way, too: its file has changed. */
export function forgetColumns(item: number): void {
  for (const [key, stop] of [...underWay]) {
    if (!key.startsWith(keyOf(item, ''))) continue;
    forgotten.add(stop);
    underWay.delete(key);
    stop.abort();
  }
  forget(item, () => true);
}
