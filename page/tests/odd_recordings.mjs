// Fifty recordings that are damaged, cut, none at all, or have names that text may be broken by.
import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { synthesise } from './prepared.mjs';

/** The same numbers every time, in [0, 1). */
function randomNumbers(seed) {
  let state = seed;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}

function withChanges(bytes, count, seed) {
  const random = randomNumbers(seed), changed = Buffer.from(bytes);
  for (let k = 0; k < count; ++k) changed[Math.floor(random() * changed.length)] = Math.floor(256 * random());
  return changed;
}

const signature = Buffer.from('\x89HDF\r\n\x1a\n', 'latin1');
const names = ['Zellen \u00e4\u00f6\u00fc \u00df.rtdc', 'no ending', 'two  blanks .rtdc', 'quotes \' ".rtdc', '%41%00.rtdc', 'smile \u{1f600}.rtdc',
  '.hidden.rtdc', '<img src=x onerror=alert(1)>.rtdc', 'back\\slash.rtdc', 'e\u0301.rtdc', `${'long '.repeat(40)}.rtdc`, 'sound.rtdc'];

/** Their paths; the last one is sound. */
export async function oddRecordings(folder) {
  await mkdir(folder);
  const sound = join(folder, 'source of all.rtdc');
  await synthesise(sound, ['recording.cells=30', 'recording.seed=12']);
  const bytes = await readFile(sound);
  const contents = [
    ...Array.from({ length: 12 }, (_, k) => withChanges(bytes, 3, k)),
    ...Array.from({ length: 10 }, (_, k) => withChanges(bytes, 300, 100 + k)),
    ...Array.from({ length: 10 }, (_, k) => bytes.subarray(0, (bytes.length * (k + 1)) / 11)),
    Buffer.alloc(0),
    Buffer.from('no recording\n'),
    signature,
    Buffer.concat([signature, Buffer.alloc(100_000)]),
    Buffer.concat([bytes.subarray(0, 2048), Buffer.alloc(bytes.length - 2048, 255)]),
    Buffer.alloc(100_000),
  ];
  const files = [];
  for (const [k, content] of contents.entries()) {
    files.push(join(folder, `odd ${k}.rtdc`));
    await writeFile(files.at(-1), content);
  }
  for (const name of names) {
    files.push(join(folder, name));
    await copyFile(sound, files.at(-1));
  }
  return files;
}
