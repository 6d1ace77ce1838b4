// Columns of events, fetched once and kept: in double precision, so that gates and statistics agree with the command line.
import { readEvents, type Item } from '../api';
import { notifyFailure } from '../shell/notices';
import { store } from '../shell/store';
import { isComputed } from './features';

type Column = Float64Array;

const kept = new Map<string, Column>();
const underWay = new Map<string, AbortController>();
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

async function load(item: number, features: string[], stop: AbortController): Promise<void> {
  try {
    const found = await readEvents(item, features, 'float64', stop.signal);
    found.features.forEach((feature, k) => kept.set(keyOf(item, feature), found.columns[k] as Column));
  } catch (failure) {
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
  void load(item.item, missing, stop);
}

export function stopLoading(): void {
  for (const stop of new Set(underWay.values())) stop.abort();
}

/** Forgets the moduli of a recording: they are computed anew. */
export function forgetComputed(item: number): void {
  for (const key of [...kept.keys()]) {
    const [number, feature] = key.split('/', 2);
    if (Number(number) === item && (isComputed(feature) || kept.get(key)!.length === 0)) kept.delete(key);
  }
  changed();
}
