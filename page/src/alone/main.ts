// The page with the program in it: one file, opened without a server.
import { askOf, readItem, readItems, type Item } from '../api';
import { notify, notifyFailure } from '../shell/notices';
import { opener } from '../shell/OpenFiles';
import { openInCell } from '../shell/open_in_cell';
import { place, replacePlace } from '../shell/place';
import { leaveSession, startSession } from '../shell/session';
import { forgetComputed } from '../recordings/columns';
import { failureOf, items, readRecordings, recordings } from '../recordings/model';
import { moduliVersion, readKnownModuli } from '../recordings/moduli';
import type { Saved } from './messages';
import { isSession } from './session_paths';
import { PairOfPrograms } from './pair';
import { unpacked, unpackedText } from './unpacked';

const content = (id: string) => document.getElementById(id)!.textContent!;

function download({ name, bytes }: Saved): void {
  const link = document.createElement('a');
  link.download = name;
  link.href = URL.createObjectURL(new Blob([bytes as BlobPart]));
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

const program = new PairOfPrograms(
  {
    script: await unpackedText(content('engine-worker')),
    code: unpacked(content('engine-wasm')).then((bytes) => WebAssembly.compile(bytes)),
    tables: JSON.parse(content('engine-tables')),
  },
  { saved: download, restarted: (sentence) => (notify(sentence, 'failed'), void readAnew().catch(() => undefined)) },
);

/** What was computed of recordings has gone with the worker, or comes with a session. */
async function readAnew(): Promise<void> {
  await readRecordings();
  for (const { item } of recordings(items.get())) {
    forgetComputed(item);
    await readKnownModuli(item);
  }
  moduliVersion.update((version) => version + 1);
}

/** What has been given since there were `known` items: recordings are listed, a case is shown, other failures are told. */
async function show(known: number): Promise<void> {
  const given = (await readItems()).slice(known);
  const isLost = ({ kind, state }: Item) => kind !== 'recording' && state === 'failed';
  for (const item of given.filter(isLost)) notify(failureOf(item), 'failed');
  const found = given.filter((item) => !isLost(item));
  if (found.length === 0) return;
  const cell = found.find(({ kind, state }) => state === 'ready' && (kind === 'case' || kind === 'result'));
  const sections = cell && recordings(found).length === 0 && (await readItem(cell.item)).case;
  if (sections) return openInCell(sections);
  if (place.get().workspace !== 'recordings') replacePlace({ workspace: 'recordings', query: new URLSearchParams() });
  return readRecordings();
}

async function open(files: File[]): Promise<void> {
  const openings = await Promise.all(files.map((file) => file.slice(0, 100).text()));
  const hasSession = openings.some(isSession);
  if (hasSession) leaveSession();
  const known = (await readItems()).length;
  // A breakdown has been told already.
  for (const sentence of await program.open(files).catch(() => [])) notify(sentence, 'failed');
  if (!hasSession) return show(known);
  if (place.get().workspace !== 'recordings') replacePlace({ workspace: 'recordings', query: new URLSearchParams() });
  await startSession();
  await readAnew();
}

/** Of folders a browser hands over the name alone. */
function takeDrops(): void {
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    const dropped = [...(event.dataTransfer?.items ?? [])].filter(({ kind }) => kind === 'file');
    const isFolder = (item: DataTransferItem) => item.webkitGetAsEntry()?.isDirectory ?? false;
    for (const item of dropped.filter(isFolder))
      notify(`${item.getAsFile()?.name ?? 'This'} is a folder: open it, and drop the files that are in it.`, 'failed');
    const files = dropped.filter((item) => !isFolder(item)).flatMap((item) => item.getAsFile() ?? []);
    if (files.length > 0) void open(files).catch(notifyFailure);
  });
}

askOf(program);
Object.assign(window, { rheocyte: program }); // for scripts: rheocyte.answer('/api/state', { method: 'POST', body })
opener.set(open);
takeDrops();
await import('../main');
document.getElementById('starting')!.remove();
