// build/rheocyte.html (tools/page): the same numbers as the program's, without a server and without the network.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { mkdtemp, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { openWindow, skip as noPage } from './browser.mjs';
import { moveSlider, settled, shownDeformation } from './cell_page.mjs';
import { synthesise } from './prepared.mjs';
import { computeModuli, drawn } from './recordings_page.mjs';
import { program } from './target.mjs';

const file = fileURLToPath(new URL('../../build/rheocyte.html', import.meta.url));
const skip = noPage || (existsSync(file) ? false : `there is no ${file}; tools/page makes it`);
const run = promisify(execFile);
let folder;
before(async () => (folder = skip ? null : await mkdtemp(join(tmpdir(), 'rheocyte-single-'))));
after(() => folder && rm(folder, { recursive: true, force: true }));

async function inPage(work) {
  const page = await openWindow({ acceptDownloads: true });
  const outside = [], failures = [];
  page.on('request', (request) => !/^(file|blob|data):/.test(request.url()) && outside.push(request.url()));
  page.on('pageerror', (failure) => failures.push(failure.message));
  try {
    await page.goto(pathToFileURL(file).href);
    await settled(page);
    await work(page);
    assert.deepEqual([outside, failures], [[], []]);
  } finally {
    await page.context().close();
  }
}

const answered = (page, path, body) =>
  page.evaluate(async ([target, content]) => {
    const how = content === undefined ? {} : { method: 'POST', body: JSON.stringify(content) };
    return (await window.rheocyte.answer(target, how)).json();
  }, [path, body]);

async function give(page, ...files) {
  await page.getByRole('button', { name: 'Recordings', exact: true }).click();
  await page.locator('.open-files input').setInputFiles(files);
}

/** Deformation by `rheocyte solve`. */
async function solved(settings) {
  const example = fileURLToPath(new URL('../../examples/paper-cell.toml', import.meta.url));
  const target = join(folder, `solved-${Object.values(settings).join('-')}`);
  await run(program, ['solve', example, '-o', target, '--no-picture', ...Object.entries(settings).flatMap(([key, value]) => ['--set', `${key}=${value}`])]);
  return JSON.parse(await readFile(join(target, 'result.json'), 'utf8'));
}

test('A slider moves the cell', { skip }, () =>
  inPage(async (page) => {
    const before = await shownDeformation(page);
    await moveSlider(page, 'cell.bulk.young_modulus_kPa', 900);
    assert.notEqual(await shownDeformation(page), before);
  }));

test('States in tube and square channel are those of the program', { skip }, () =>
  inPage(async (page) => {
    for (const section of ['tube', 'square']) {
      const native = await solved({ 'channel.section': `"${section}"`, 'numerics.accuracy': section === 'tube' ? 1e-3 : 3e-2 });
      const { deformation } = await answered(page, '/api/state', native.case);
      // Processors multiply and add in other orders, which rounding shows, and so do Newton's last steps.
      assert.ok(Math.abs(deformation / native.deformation - 1) < 1e-10, `${section}: ${deformation} and ${native.deformation}`);
    }
  }));

test('Moduli of a recording are those of rheocyte extract, and its table of events is a download', { skip }, () =>
  inPage(async (page) => {
    const recording = join(folder, 'cells.rtdc');
    await synthesise(recording, ['recording.cells=200', 'recording.seed=3']);
    await give(page, recording);
    await drawn(page);
    await computeModuli(page);
    const download = page.waitForEvent('download');
    await page.getByLabel('Export').selectOption({ label: 'Table of events' });
    await (await download).saveAs(join(folder, 'events.tsv'));
    await run(program, ['extract', recording, '-o', join(folder, 'native'), '--quiet']);
    const name = (await readdir(join(folder, 'native'))).find((each) => each === 'cells_rheocyte.tsv');
    const numbers = async (path) =>
      (await readFile(path, 'utf8')).split('\n').filter((line) => line && !line.startsWith('#')).slice(1).flatMap((line) => line.split('\t').map(Number));
    const [ours, theirs] = [await numbers(join(folder, 'events.tsv')), await numbers(join(folder, 'native', name))];
    assert.equal(ours.length, theirs.length);
    // The table has six digits, of which rounding may turn the last.
    ours.forEach((value, k) => assert.ok(Object.is(value, theirs[k]) || Math.abs(value - theirs[k]) <= 2e-6 * Math.abs(theirs[k]), `${value} and ${theirs[k]}`));
  }));

test('A damaged recording is told, and leaves the page and the other recordings as they are', { skip }, () =>
  inPage(async (page) => {
    const sound = join(folder, 'sound.rtdc'), cut = join(folder, 'cut.rtdc'), text = join(folder, 'text.rtdc');
    await synthesise(sound, ['recording.cells=50', 'recording.seed=4']);
    const bytes = await readFile(sound);
    await writeFile(cut, bytes.subarray(0, bytes.length / 2));
    await writeFile(text, 'no recording\n');
    await give(page, cut, text, sound);
    await drawn(page);
    assert.equal(await page.locator('.recording.failed .alarm').count(), 2);
  }));
