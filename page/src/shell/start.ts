// Where the page begins: at its address, or at what the program was given.
import { readItem, readItems, type Item } from '../api';
import { caseOf } from '../cell/case';
import { openCase } from '../cell/model';
import { notify } from './notices';
import { replacePlace } from './place';

const attempts = 10;
const pause = (milliseconds: number) => new Promise((done) => window.setTimeout(done, milliseconds));

/** The case of a file or a result; it may still be read when the page is there. */
async function openItem(item: number): Promise<void> {
  for (let k = 0; k < attempts; ++k) {
    const found = await readItem(item);
    if (found.case) return openCase(caseOf(found.case));
    if (found.state === 'failed') return notify(found.error ?? `${found.name} cannot be read.`, 'failed');
    await pause(100);
  }
}

/** Recordings go before cells: who names a recording wants to see it. A session holds its case already. */
export async function startAtItems(hasSession: boolean): Promise<void> {
  if (window.location.hash) return;
  const items = await readItems().catch((): Item[] => []);
  if (items.some(({ kind }) => kind === 'recording')) return replacePlace({ workspace: 'recordings', query: new URLSearchParams() });
  const first = items.find(({ kind }) => kind === 'case' || kind === 'result');
  if (first && !hasSession) await openItem(first.item).catch(() => undefined);
}
