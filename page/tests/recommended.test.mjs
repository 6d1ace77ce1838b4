import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { promisify } from 'node:util';
import { skip } from './browser.mjs';
import { loadModule } from './load_module.mjs';
import { synthesise } from './prepared.mjs';
import * as recordings from './recordings_page.mjs';
import { program } from './target.mjs';

const { inShort, meanRecommended, recommendedOf } = await loadModule('recordings/recommended.ts');

const run = (recommended) => ({
  state: 'ready',
  done: 1,
  summary: Object.fromEntries(Object.entries(recommended).map(([name, value]) => [`recommended_${name}`, value])),
});
const some = (value, more = {}) =>
  recommendedOf(run({ modulus: 'elongated', young_modulus_median_kPa: value, young_modulus_median_kPa_error: 0.13, young_modulus_median_kPa_common_error: 0.064, text: 'report E', ...more }));

test('the modulus to report stands with its errors, a bound with its direction, and else none', () => {
  assert.equal(inShort(some(4.2094)), '4.21 ± 0.13 ± 0.06');
  assert.equal(inShort(some(4.2094, { young_modulus_median_kPa_common_error: null })), '4.21 ± 0.13');
  assert.equal(inShort(some(null)), 'none');
  assert.equal(inShort(some(null, { bound: 'softer', bound_kPa: 0.6 })), '< 0.600');
  assert.equal(inShort(some(null, { bound: 'stiffer', bound_kPa: 9 })), '> 9.00');
  assert.equal(recommendedOf({ state: 'running', done: 0.5 }), undefined);
});

test('a condition has a recommended mean only if all of its recordings have a number', () => {
  const of = (...values) => values.map((value) => ({ replicate: '', found: value === undefined ? undefined : some(value) }));
  assert.equal(meanRecommended(of(4, 5)).value, 4.5);
  for (const missing of [null, undefined]) assert.equal(meanRecommended(of(4, 5, missing)).value, NaN);
});

/** The number that `rheocyte extract` recommends, and its sentence. */
async function recommendedBy(file, folder, options = []) {
  await promisify(execFile)(program, ['extract', file, '-o', folder, '--quiet', ...options]);
  const [heads, values] = (await readFile(join(folder, 'rheocyte_summary.tsv'), 'utf8')).split('\n').map((line) => line.split('\t'));
  const said = (name) => values[heads.indexOf(`recommended_${name}`)];
  return { exact: Number(said('young_modulus_median_kPa')), text: said('text').replaceAll('+-', '±') };
}

const elongated = ['recording.cells=60', 'flow.axial_tension_Pa=400', 'flow.rate_ul_per_s=0.06', 'cell.bulk.young_modulus_kPa.mean=4'];

async function withElongatedCells(options, work) {
  const folder = await mkdtemp(join(tmpdir(), 'rheocyte-recommended-'));
  try {
    const files = ['control_of_today.rtdc', 'drug_of_today.rtdc'].map((name) => join(folder, name));
    for (const [k, file] of files.entries()) await synthesise(file, [...elongated, `recording.seed=${k + 1}`]);
    const opened = await recordings.openRecordings(options, files);
    try {
      await work(opened.page, files, folder);
      assert.deepEqual(opened.failures, []);
    } finally {
      await opened.end();
    }
  } finally {
    await rm(folder, { recursive: true });
  }
}

/** By how many pixels anything in the results lies outside their box. */
const beyond = (page) =>
  page.locator('#results-panel').evaluate((panel) => {
    const { right } = panel.getBoundingClientRect();
    return Math.max(...[...panel.querySelectorAll('th, td, text')].map((each) => each.getBoundingClientRect().right - right));
  });

/** What is left of a field beside its placeholder and the arrow of its list, in pixels. */
function roomBeside(input) {
  const { font, paddingLeft, paddingRight } = getComputedStyle(input);
  const ink = document.createElement('canvas').getContext('2d');
  ink.font = font;
  const arrow = input.list ? 18 : 0;
  return input.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight) - arrow - ink.measureText(input.placeholder).width;
}

for (const width of [1280, 1920])
  test(`the number of the command line is in all views of elongated cells, within their boxes, at ${width} pixels`, { skip }, () =>
    withElongatedCells({ viewport: { width, height: 900 } }, async (page, files, folder) => {
      const { exact } = await recommendedBy(files[0], folder);
      const number = exact.toPrecision(3);
      for (const [item, condition] of ['control', 'drug'].entries()) {
        const row = page.locator('.recording').nth(item);
        await row.locator('.recording-name').click();
        await row.getByLabel('Condition', { exact: true }).fill(condition);
        await page.keyboard.press('Enter');
      }
      await page.getByRole('button', { name: 'Compute the moduli of all 2 recordings' }).click();
      await page.locator('.recording-name').first().click();
      await page.locator('.to-report', { hasText: `Recommended modulus: ${number} ±` }).waitFor();
      await page.locator('.statistics tr[data-item="1"] .recommended', { hasText: '±' }).waitFor();
      const statistics = await recordings.statisticsOf(page, 0);
      assert.ok(statistics['Recommended modulus'].startsWith(number), statistics['Recommended modulus']);
      assert.ok(Number(statistics.Median) < 0.9 * Number(number), 'E from deformation is far too low, and stands beside it');
      assert.ok((await beyond(page)) <= 0, `statistics: ${await beyond(page)} pixels`);

      await page.getByRole('tab', { name: 'Populations' }).click();
      await page.locator('.violins .recommended').nth(1).waitFor();
      const rows = await page.locator('.conditions tbody').first().locator('tr').allTextContents();
      assert.equal(rows[0], 'control (1)');
      assert.ok(rows[1].startsWith(`Recommended modulus${exact.toPrecision(4)}`), rows[1]);
      assert.ok(rows[2].startsWith('Median of the events'), rows[2]);
      assert.ok((await beyond(page)) <= 0, `populations: ${await beyond(page)} pixels`);
      for (const name of ['control_of_today', 'drug_of_today', 'control', 'drug'])
        assert.equal(await page.locator('.violins .plot-axes text', { hasText: new RegExp(`${name}$`) }).count() > 0, true, name);

      await recordings.plotOf(page).focus();
      await page.keyboard.press('n');
      await page.locator('.modulus .large', { hasText: 'kPa' }).waitFor();
      assert.match(await page.locator('.modulus').textContent(), /E as of an elongated cell, recommended for the recordingE from deformation: \S+ ± \S+ kPa/);
      for (const field of await page.locator('.setting input[placeholder="automatic"]').all())
        if (await field.isVisible()) assert.ok((await field.evaluate(roomBeside)) >= 0, 'the word is whole');
    }));

test('within gates the page recommends what the command with the same gates does', { skip }, () =>
  withElongatedCells({}, async (page, files, folder) => {
    const cell = page.locator('.statistics tr[data-item="0"] .recommended');
    const shown = async () => ({ short: await cell.textContent(), text: await cell.getAttribute('title') });
    const said = ({ exact, text }) => page.waitForFunction(([number, sentence]) => {
      const own = document.querySelector('.statistics tr[data-item="0"] .recommended');
      const panel = document.querySelector('.to-report h3');
      return own?.title === sentence && own.textContent.startsWith(number) && panel?.textContent.includes(`: ${number} ±`);
    }, [exact.toPrecision(3), text]);
    await recordings.computeModuli(page);
    const all = await recommendedBy(files[0], folder);
    await said(all);

    await recordings.drawBox(page, [0.02, 0.02], [0.55, 0.98]);
    const command = await page.locator('.command code').first().textContent();
    const options = command.slice(command.indexOf('--min')).split(' ');
    assert.equal(options.filter((option) => /^--(min|max)$/.test(option)).length, 4, command);
    const within = await recommendedBy(files[0], folder, options);
    assert.notEqual(within.text, all.text, 'the gate leaves out some cells');
    await said(within);

    await page.getByRole('tab', { name: /^Gates/ }).click();
    for (const check of await page.locator('.gate input[type="checkbox"]').all()) await check.uncheck();
    await page.getByRole('tab', { name: 'Statistics' }).click();
    await said(all);
    assert.equal((await shown()).text, all.text);
  }));
