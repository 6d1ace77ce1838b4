// build/rheocyte.html (tools/page): the same numbers as the program's, without a server and without the network.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { copyFile, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
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

const example = (name) => fileURLToPath(new URL(`../../examples/${name}.toml`, import.meta.url));

/** What `rheocyte solve` finds. */
async function solved(name, settings) {
  const target = join(folder, `solved-${name}-${Object.values(settings).join('-').replaceAll('"', '')}`);
  await run(program, ['solve', example(name), '-o', target, '--no-picture', ...Object.entries(settings).flatMap(([key, value]) => ['--set', `${key}=${value}`])]);
  return JSON.parse(await readFile(join(target, 'result.json'), 'utf8'));
}

/** The numbers of a table of events. */
async function numbersIn(path) {
  const lines = (await readFile(path, 'utf8')).split('\n').filter((line) => line && !line.startsWith('#'));
  return lines.slice(1).flatMap((line) => line.split('\t').map(Number));
}

/** Chooses an entry of the menu of exports, and saves the download. */
async function exported(page, title, name) {
  const download = page.waitForEvent('download');
  await page.getByLabel('Export').selectOption({ label: title });
  await (await download).saveAs(join(folder, name));
  return join(folder, name);
}

/** Moduli of the only recording in the page are those of `rheocyte extract`. */
async function assertSameModuli(page, recording) {
  await give(page, recording);
  await drawn(page);
  await computeModuli(page);
  const ours = await numbersIn(await exported(page, 'Table of events', 'events.tsv'));
  const target = join(folder, `native-${basename(recording)}`);
  await run(program, ['extract', recording, '-o', target, '--quiet']);
  const theirs = await numbersIn(join(target, `${basename(recording, '.rtdc')}_rheocyte.tsv`));
  assert.equal(ours.length, theirs.length);
  // The table has six digits, of which rounding may turn the last; what is nought but for rounding has none.
  const rounding = (value) => Math.max(2e-6 * Math.abs(value), 1e-12);
  ours.forEach((value, k) => assert.ok(Object.is(value, theirs[k]) || Math.abs(value - theirs[k]) <= rounding(theirs[k]), `${value} and ${theirs[k]}`));
}

test('A slider moves the cell', { skip }, () =>
  inPage(async (page) => {
    const before = await shownDeformation(page);
    await moveSlider(page, 'cell.bulk.young_modulus_kPa', 900);
    assert.notEqual(await shownDeformation(page), before);
  }));

test('States in tube and square channel, of all kinds of cells and liquids, are those of the program', { skip }, () =>
  inPage(async (page) => {
    const tube = ['paper-cell', 'shell-cell', 'mooney-rivlin-cell', 'power-law-liquid', 'small-linear-cell'].map((name) => [name, { 'numerics.accuracy': 1e-3 }]);
    const square = ['paper-cell', { 'channel.section': '"square"', 'numerics.accuracy': 3e-2 }];
    for (const [name, settings] of [...tube, square]) {
      const native = await solved(name, settings);
      const state = await answered(page, '/api/state', native.case);
      for (const measure of ['deformation', 'area_um2', 'cell_velocity_m_per_s', 'pressure_drop_Pa'])
        // Processors multiply and add in other orders, which rounding shows, and so do Newton's last steps.
        assert.ok(Math.abs(state[measure] / native[measure] - 1) < 1e-10, `${name}, ${measure}: ${state[measure]} and ${native[measure]}`);
    }
  }));

test('Moduli of a recording are those of rheocyte extract, and its table of events is a download', { skip }, () =>
  inPage(async (page) => {
    const recording = join(folder, 'cells.rtdc');
    await synthesise(recording, ['recording.cells=200', 'recording.seed=3']);
    await assertSameModuli(page, recording);
  }));

const measured = fileURLToPath(new URL('../../../shared/reference/rtdc/', import.meta.url));
const hasMeasured = skip || (existsSync(measured) ? false : `there is no ${measured}`);
test('Moduli of a measured recording are those of rheocyte extract', { skip: hasMeasured }, () =>
  inPage((page) => assertSameModuli(page, join(measured, 'wide_channel_issue_212.rtdc'))));

test('A companion is a download that opens as a recording; a session finds its recordings again by their names', { skip }, async () => {
  const recording = join(folder, "M\u00fcller's cells.rtdc");
  await synthesise(recording, ['recording.cells=60', 'recording.seed=5']);
  await inPage(async (page) => {
    await give(page, recording);
    await drawn(page);
    await computeModuli(page);
    await page.getByLabel('Two plots').check();
    await exported(page, 'Session', 'session.toml');
    await give(page, await exported(page, 'Companion .rtdc', 'companion.rtdc'));
    await page.locator('.recording', { hasText: 'companion' }).locator('.numbers').waitFor();
    assert.ok((await answered(page, '/api/items/1')).features.includes('emodulus_stored'));
  });
  await inPage(async (page) => {
    await give(page, join(folder, 'session.toml'), recording);
    await drawn(page);
    assert.ok(await page.getByLabel('Two plots').isChecked());
    assert.equal((await answered(page, '/api/items')).length, 1);
    assert.equal((await answered(page, '/api/items/0/moduli')).state, 'ready');
  });
});

test('A hundred recordings are given at once', { skip }, () =>
  inPage(async (page) => {
    const one = join(folder, 'one.rtdc');
    await synthesise(one, ['recording.cells=20', 'recording.seed=6', 'recording.pictures="none"']);
    const names = Array.from({ length: 100 }, (_, k) => join(folder, `one of many ${k}.rtdc`));
    for (const name of names) await copyFile(one, name);
    await give(page, ...names);
    await page.locator('.recording', { hasText: 'one of many 99' }).locator('.numbers').waitFor();
    assert.ok((await answered(page, '/api/items')).every(({ state, events }) => state === 'ready' && events === 20));
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
