import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { chmod, copyFile, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { skip as noPage } from './browser.mjs';
import * as recordings from './recordings_page.mjs';
import { program } from './target.mjs';

// Against the program, with a folder of seven recordings, the last of which states no temperature.
const cases = fileURLToPath(new URL('../../../shared/cases/', import.meta.url));
const skip = noPage || (existsSync(cases) ? false : `there is no ${cases}`);
const run = promisify(execFile);
const last = 6;

async function copied(from, to) {
  await copyFile(join(cases, from), to);
  await chmod(to, 0o644);
}

async function inFolder(work) {
  const folder = await mkdtemp(join(tmpdir(), 'rheocyte-folder-'));
  try {
    for (let k = 0; k < last; ++k) await copied('virtual.rtdc', join(folder, `2026-03-01_M00${k + 1}_control.rtdc`));
    await copied('no-temperature.rtdc', join(folder, '2026-03-01_M007_control.rtdc'));
    const opened = await recordings.openRecordings({}, [folder]);
    try {
      await work(opened.page, folder, opened.target);
      assert.deepEqual(opened.failures, []);
    } finally {
      await opened.end();
    }
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

const everyTitle = 'Compute the moduli of all 7 recordings';

async function computeAll(page) {
  await page.getByRole('button', { name: everyTitle }).click();
  await page.waitForFunction((item) => {
    const cell = document.querySelector(`.statistics tr[data-item="${item}"] td:nth-child(5)`);
    return cell && cell.textContent !== '–';
  }, last);
}

const fillIn = async (page, label, text) => {
  await page.getByLabel(label, { exact: true }).fill(text);
  await page.keyboard.press('Enter');
};

const medianOf = async (page, item) => Number((await recordings.statisticsOf(page, item)).Median);

/** Of `rheocyte extract`, to the four digits of the page. */
async function extractedMedian(file, ...options) {
  const output = await mkdtemp(join(tmpdir(), 'rheocyte-extract-'));
  await run(program, ['extract', file, '-o', output, '--quiet', ...options]);
  const [heads, values] = (await readFile(join(output, 'rheocyte_summary.tsv'), 'utf8')).split('\n').map((line) => line.split('\t'));
  await rm(output, { recursive: true });
  return Number(Number(values[heads.indexOf('young_modulus_median_kPa')]).toPrecision(4));
}

test('A temperature for recordings without one leaves the recorded ones', { skip }, () =>
  inFolder(async (page, folder) => {
    await fillIn(page, 'Temperature if missing, °C', '30');
    assert.equal(await page.locator('.caution').count(), 0);
    await computeAll(page);
    const first = join(folder, '2026-03-01_M001_control.rtdc');
    assert.equal(await medianOf(page, 0), await extractedMedian(first));
    assert.equal(await medianOf(page, last), await extractedMedian(join(folder, '2026-03-01_M007_control.rtdc'), '--temperature', '30'));
    assert.notEqual(await medianOf(page, 0), await medianOf(page, last));
    assert.match(await page.locator('.command code').textContent(), / --temperature-if-missing 30$/);
  }),
);

test('A temperature for all says how many recorded ones it replaces', { skip }, () =>
  inFolder(async (page) => {
    await fillIn(page, 'Temperature, °C', '23');
    await page.getByText('Replaces the recorded temperature of 6 of 7 recordings').waitFor();
  }),
);

test('A press on a button right after typing is not lost', { skip }, () =>
  inFolder(async (page) => {
    // The press ends the typing; what is said about it must not push the button away then.
    await page.getByLabel('Temperature, °C', { exact: true }).click();
    await page.keyboard.type('23');
    await page.getByText('Replaces the recorded temperature of 6 of 7 recordings').waitFor();
    const place = await page.getByRole('button', { name: everyTitle }).boundingBox();
    await page.mouse.move(place.x + place.width / 2, place.y + place.height / 2);
    await page.mouse.down();
    await page.mouse.up();
    await page.getByText('% of the events').or(page.locator('.command code')).first().waitFor();
  }),
);

test('With seven recordings the button for moduli is in sight and all seven distributions are shown', { skip }, () =>
  inFolder(async (page) => {
    const button = await page.getByRole('button', { name: 'Compute moduli', exact: true }).boundingBox();
    assert.ok(button.y + button.height <= 800, JSON.stringify(button));
    await page.locator('.results-head select').selectOption('area_um');
    await page.getByRole('tab', { name: 'Populations' }).click();
    await page.locator('.violin').nth(last).waitFor();
    const cut = await page.locator('.violins-scroll').evaluate((plot) => plot.scrollWidth - plot.clientWidth);
    assert.equal(cut, 0);
    const names = await page.locator('.violins .plot-axes text:has(title)').evaluateAll((all) => all.map((each) => each.childNodes[1].textContent));
    assert.equal(new Set(names).size, 7, names.join(' '));
  }),
);

test('A second window shows the recordings, too', { skip }, () =>
  inFolder((page, _, target) => recordings.aSecondWindowShowsTheRecordings(page, target.address)),
);

test('A recording that changes on disk is read again, and its moduli are gone', { skip }, () =>
  inFolder(async (page, folder) => {
    await recordings.computeModuli(page);
    await recordings.plotOf(page).focus();
    await page.keyboard.press('n');
    await page.locator('.modulus .large .symbol').waitFor();
    const file = join(folder, '2026-03-01_M001_control.rtdc');
    await writeFile(file, await readFile(join(folder, '2026-03-01_M007_control.rtdc')));
    await page.getByText('2026-03-01_M001_control.rtdc has changed on disk and was read again.').waitFor();
    await page.getByText('Choose an event in a plot').waitFor();
    await page.getByText('The recording or its table has changed since its moduli were computed; compute them again.').first().waitFor();
    assert.equal((await recordings.statisticsOf(page, 0)).Median, '–');
    assert.doesNotMatch(await page.locator('.recording.focused').textContent(), /23 °C|valid/);
  }),
);
