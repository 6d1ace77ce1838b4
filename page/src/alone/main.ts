// The page with the program in it: one file, opened without a server.
import { askOf } from '../api';
import { notify, notifyFailure } from '../shell/notices';
import { opener } from '../shell/OpenFiles';
import { place, replacePlace } from '../shell/place';
import { leaveSession, startSession } from '../shell/session';
import { forgetComputed } from '../recordings/columns';
import { items, readRecordings, recordings } from '../recordings/model';
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

async function open(files: File[]): Promise<void> {
  const openings = await Promise.all(files.map((file) => file.slice(0, 100).text()));
  const hasSession = openings.some(isSession);
  if (hasSession) leaveSession();
  // A breakdown has been told already.
  for (const sentence of await program.open(files).catch(() => [])) notify(sentence, 'failed');
  if (place.get().workspace !== 'recordings') replacePlace({ workspace: 'recordings', query: new URLSearchParams() });
  if (!hasSession) return readRecordings();
  await startSession();
  await readAnew();
}

function takeDrops(): void {
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) void open(files).catch(notifyFailure);
  });
}

askOf(program);
Object.assign(window, { rheocyte: program }); // for scripts: rheocyte.answer('/api/state', { method: 'POST', body })
opener.set(open);
takeDrops();
await import('../main');
document.getElementById('starting')!.remove();
