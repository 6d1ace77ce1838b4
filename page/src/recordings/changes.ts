// Files that change while the page is open: what was read of them is forgotten and read again.
import type { Item } from '../api';
import { notify, notifyFailure } from '../shell/notices';
import { forgetColumns, forgetComputed } from './columns';
import { choice, items, recordings, refreshItem, titleOf } from './model';
import { moduli, moduliVersion, readKnownModuli } from './moduli';

/** Of each item, once it could be read. */
const versions = new Map<number, string>();

async function readAnew(item: Item): Promise<void> {
  const hadModuli = moduli.get()[item.item]?.state === 'ready';
  await readKnownModuli(item.item);
  await refreshItem(item.item);
  moduliVersion.update((version) => version + 1);
  const again = hadModuli ? ' Its moduli are those of the file before: compute them again.' : '';
  notify(`${titleOf(item)} has changed on disk and was read again.${again}`);
}

/** Moduli from a table that is another one now. */
async function leaveModuli(item: Item): Promise<void> {
  if (moduli.get()[item.item]?.state !== 'ready') return;
  await readKnownModuli(item.item);
  forgetComputed(item.item);
  await refreshItem(item.item);
}

function takeChange(item: Item, all: Item[]): void {
  if (item.kind === 'recording') {
    forgetColumns(item.item);
    if (choice.get()?.item === item.item) choice.set(null);
    void readAnew(item).catch(notifyFailure);
  } else if (item.kind === 'table' || item.kind === 'combined') {
    void Promise.all(recordings(all).map(leaveModuli)).catch(notifyFailure);
  }
}

/** To be called once. */
export function watchChanges(): void {
  items.subscribe((all) => {
    for (const item of all ?? []) {
      if (item.state !== 'ready' || !item.version) continue;
      const before = versions.get(item.item);
      versions.set(item.item, item.version);
      if (before !== undefined && before !== item.version) takeChange(item, all!);
    }
  });
}
