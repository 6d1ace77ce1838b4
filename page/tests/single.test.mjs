// build/rheocyte.html (tools/page): the same numbers as the program's, without a server and without the network. What it
// does with files: single_files.test.mjs.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { basename, join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { moveSlider, shownDeformation } from './cell_page.mjs';
import { synthesise } from './prepared.mjs';
import { computeModuli, drawn } from './recordings_page.mjs';
import { answer, answered, computed, exported, give, inPage, run, scratch, skip } from './single_page.mjs';
import { program } from './target.mjs';

const example = (name) => fileURLToPath(new URL(`../../examples/${name}.toml`, import.meta.url));

/** What `rheocyte solve` finds. */
async function solved(name, settings) {
  const target = join(scratch.folder, `solved-${name}-${Object.entries(settings).join('-').replaceAll(/[^\w.,-]/g, '')}`);
  await run(program, ['solve', example(name), '-o', target, '--no-picture', ...Object.entries(settings).flatMap(([key, value]) => ['--set', `${key}=${value}`])]);
  return JSON.parse(await readFile(join(target, 'result.json'), 'utf8'));
}

/** Relative to the second. */
const assertNear = (one, other, limit, what) => assert.ok(Math.abs(one / other - 1) < limit, `${what}: ${one} and ${other}`);

/** The numbers of a table of events. */
async function numbersIn(path) {
  const lines = (await readFile(path, 'utf8')).split('\n').filter((line) => line && !line.startsWith('#'));
  return lines.slice(1).flatMap((line) => line.split('\t').map(Number));
}

/** Moduli of the only recording in the page are those of `rheocyte extract`. */
async function assertSameModuli(page, recording) {
  await give(page, recording);
  await drawn(page);
  await computeModuli(page);
  const ours = await numbersIn(await exported(page, 'Table of events', 'events.tsv'));
  const target = join(scratch.folder, `native-${basename(recording)}`);
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

const tube = { 'numerics.accuracy': 1e-3 }, square = { 'channel.section': '"square"', 'numerics.accuracy': 3e-2 };
/** Examples with other settings: laws of bulk and cortex, liquids, sizes, stiffnesses, tensions, accuracies, sections. */
const twenty = [
  ['paper-cell', tube],
  ['paper-cell', { ...tube, 'cell.bulk.young_modulus_kPa': 2.5 }],
  ['paper-cell', { ...tube, 'cell.bulk.young_modulus_kPa': 12 }],
  ['paper-cell', { ...tube, 'cell.radius_um': 4 }],
  ['paper-cell', { ...tube, 'cell.bulk.law': '"linear"' }],
  ['paper-cell', { ...tube, 'flow.rate_ul_per_s': 0.02 }],
  ['paper-cell', { ...tube, 'flow.axial_tension_Pa': 40 }],
  ['paper-cell', { 'numerics.accuracy': 1e-2 }],
  ['paper-cell', { 'numerics.accuracy': 1e-4 }],
  ['shell-cell', tube],
  ['combined-cell', tube],
  ['combined-cell', { ...tube, 'cell.cortex.modulus_mN_per_m': 6 }],
  ['mooney-rivlin-cell', tube],
  ['large-stiff-cell', tube],
  ['small-linear-cell', tube],
  ['power-law-liquid', tube],
  ['carreau-liquid', tube],
  ['carreau-liquid', { ...tube, 'flow.exponent': 0.8, 'cell.bulk.young_modulus_kPa': 3 }],
  ['paper-cell', square],
  ['power-law-liquid', square],
];

/** What is exported as a result, which is solved from nothing as `rheocyte solve` does it. */
async function solvedInPage(page, input) {
  const download = page.waitForEvent('download');
  const body = { what: 'result', name: 'result', case: input };
  await answered(page, '/api/export', body);
  // A file of the archive, which is not compressed: sizes of content and name stand in the head before the name.
  const archive = await readFile(await (await download).path());
  const head = archive.lastIndexOf('PK\x03\x04', archive.indexOf('/result.json'), 'latin1');
  const from = head + 30 + archive.readUInt16LE(head + 26);
  return JSON.parse(archive.subarray(from, from + archive.readUInt32LE(head + 18)));
}

test('States of twenty cells, of all laws and liquids, in the tube and the square, are those of the program', { skip }, () =>
  inPage(async (page) => {
    assert.equal(twenty.length, 20);
    for (const [name, settings] of twenty) {
      const native = await solved(name, settings);
      const state = await solvedInPage(page, native.case);
      for (const measure of ['deformation', 'area_um2', 'cell_velocity_m_per_s', 'pressure_drop_Pa'])
        // Processors multiply and add in other orders, which rounding shows.
        assertNear(state[measure], native[measure], 1e-12, `${name}, ${measure}`);
    }
  }));

test('What is solved from the state before is as near as Newton\'s tolerance', { skip }, () =>
  inPage(async (page) => {
    for (const modulus of [3.4, 3.5, 3.6]) {
      const native = await solved('paper-cell', { ...tube, 'cell.bulk.young_modulus_kPa': modulus });
      const state = await answered(page, '/api/state?stream=slider', native.case);
      assertNear(state.deformation, native.deformation, 1e-9, `deformation at ${modulus} kPa`);
    }
  }));

/** Of virtual recordings: what is changed of examples/recordings/virtual-cells.toml. */
const changes = [
  ['recording.seed=3'],
  ['recording.seed=13', 'recording.pictures="masks"', 'flow.rate_ul_per_s=0.06'],
  ['recording.seed=14', 'flow.medium="0.59% MC-PBS"', 'cell.radius_um.mean=5.4'],
  ['recording.seed=15', 'recording.pixel_size_um=0.26', 'cell.bulk.young_modulus_kPa.mean=4'],
];
changes.forEach((settings, k) =>
  test(`Moduli of virtual recording ${k} are those of rheocyte extract, and its table of events is a download`, { skip }, () =>
    inPage(async (page) => {
      const recording = join(scratch.folder, `cells-${k}.rtdc`);
      await synthesise(recording, ['recording.cells=200', ...settings]);
      await assertSameModuli(page, recording);
    })));

const measured = fileURLToPath(new URL('../../../shared/reference/rtdc/', import.meta.url));
const hasMeasured = skip || (existsSync(measured) ? false : `there is no ${measured}`);
test('Moduli of a measured recording are those of rheocyte extract', { skip: hasMeasured }, () =>
  inPage((page) => assertSameModuli(page, join(measured, 'wide_channel_issue_212.rtdc'))));

test('Moduli that are stopped take none with them that were computed before', { skip }, () =>
  inPage(async (page) => {
    const [few, many] = ['few.rtdc', 'many.rtdc'].map((name) => join(scratch.folder, name));
    await synthesise(few, ['recording.cells=50', 'recording.seed=7']);
    await synthesise(many, ['recording.cells=3000', 'recording.seed=8', 'recording.pictures="none"']);
    await give(page, few, many);
    await drawn(page);
    assert.equal((await computed(page, 0)).state, 'ready');
    const [status] = await answer(page, '/api/items/1/moduli', { method: 'POST', body: {} });
    assert.equal(status, 202);
    assert.equal((await answer(page, '/api/items/1/moduli', { method: 'DELETE' }))[1].state, 'none');
    assert.equal((await answered(page, '/api/items/0/moduli')).state, 'ready');
    assert.equal(await page.locator('.notice', { hasText: 'Stopped' }).count(), 0);
  }));
