import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { mkdtemp, readFile, readdir, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { skip as noPage } from './browser.mjs';
import * as recordings from './recordings_page.mjs';
import { program } from './target.mjs';

// Against the program, with recordings of the field: what the page shows is what the command line says.
const folder = fileURLToPath(new URL('../../../shared/reference/rtdc/', import.meta.url));
const many = join(folder, 'example.rtdc'); // 5000 events, no images, no temperature
const few = join(folder, 'mask_contour_reference.rtdc'); // 8 events with images
const skip = noPage || (existsSync(many) ? false : `there is no ${folder}`);
const run = promisify(execFile);

async function inPage(files, work) {
  const opened = await recordings.openRecordings({}, files);
  try {
    await work(opened.page, opened);
    assert.deepEqual(opened.failures, []);
  } finally {
    await opened.end();
  }
}

/** What `rheocyte extract` writes: its summary by columns, and the lines of its table of events. */
async function extracted(file, ...options) {
  const output = await mkdtemp(join(tmpdir(), 'rheocyte-extract-'));
  await run(program, ['extract', file, '-o', output, '--quiet', ...options]);
  const [heads, values] = (await readFile(join(output, 'rheocyte_summary.tsv'), 'utf8')).split('\n').map((line) => line.split('\t'));
  const name = (await readdir(output)).find((each) => each === `${basename(file, '.rtdc')}_rheocyte.tsv`);
  const events = eventLines(await readFile(join(output, name), 'utf8'));
  await rm(output, { recursive: true });
  return { summary: Object.fromEntries(heads.map((head, k) => [head, values[k]])), events };
}

const eventLines = (text) => text.split('\n').filter((line) => line !== '' && !line.startsWith('#'));

async function computeAt(page, degrees) {
  await page.getByLabel('Temperature, °C').fill(String(degrees));
  await page.keyboard.press('Enter');
  await recordings.computeModuli(page);
}

function assertSame(found, { summary }) {
  const six = (text) => Number(Number(text).toPrecision(6)); // the summary has six digits
  assert.equal(recordings.numberIn(found['With value']), Number(summary.valid) + Number(summary.regularised) + Number(summary.inertial));
  for (const [head, column] of [
    ['Median', 'median'],
    ['Mean', 'mean'],
    ['SD', 'standard_deviation'],
    ['25 %', 'first_quartile'],
    ['75 %', 'third_quartile'],
  ])
    assert.equal(six(found[head]), Number(summary[`young_modulus_${column}_kPa`]), head);
}

test('Each setting that the program declares has a field, but for gates, which the page has itself', { skip }, () =>
  inPage([few], async (page) => {
    const declared = await page.evaluate(() => fetch('/api/settings').then((answer) => answer.json()));
    const fields = await page.locator('.setting span').allTextContents();
    const wanted = declared.filter(({ kind }) => kind !== 'texts').map(({ label }) => label);
    assert.deepEqual(fields.map((field) => field.split(',')[0]).sort(), wanted.sort());
    assert.deepEqual(declared.filter(({ kind }) => kind === 'texts').map(({ name }) => name), ['min', 'max', 'polygon']);
    await page.getByText('More settings').click();
    await page.getByLabel('Section').selectOption('tube');
    await page.getByLabel('No pixelation').check();
    await computeAt(page, 23);
    assert.match(await page.locator('.command code').textContent(), / --section tube --temperature 23 --no-pixelation$/);
  }),
);

test("Statistics of the page are those of the command line's summary", { skip }, () =>
  inPage([many], async (page) => {
    await computeAt(page, 23);
    assertSame(await recordings.exactStatistics(page), await extracted(many, '--temperature', '23'));
  }),
);

test('A gate of the page is --min and --max of the command line', { skip }, () =>
  inPage([many], async (page) => {
    await computeAt(page, 23);
    await page.getByRole('tab', { name: /^Gates/ }).click();
    await page.getByLabel('Limit').selectOption('area_um');
    await page.getByLabel('Minimum Area').fill('40');
    await page.getByLabel('Maximum Area').fill('80');
    await page.keyboard.press('Enter');
    await page.getByText(/ of 5\u202f000 events/).waitFor();
    await page.getByRole('tab', { name: 'Statistics' }).click();
    assertSame(await recordings.exactStatistics(page), await extracted(many, '--temperature', '23', '--min', 'area_um=40', '--max', 'area_um=80'));
    const command = await page.locator('.command code').textContent();
    assert.ok(command.endsWith('--temperature 23 --min area_um=40 --max area_um=80'), command);
  }),
);

test('A polygon gate of the page is --polygon of the command line', { skip }, () =>
  inPage([many], async (page) => {
    await computeAt(page, 23);
    await page.getByRole('button', { name: 'log, horizontal axis' }).click();
    await recordings.drawn(page);
    await page.getByRole('button', { name: 'Polygon', exact: true }).click();
    for (const [right, down] of [[0.3, 0.9], [0.7, 0.9], [0.5, 0.4], [0.3, 0.9]]) {
      const { x, y } = await recordings.pixelIn(page, right, down);
      await page.mouse.click(x, y);
    }
    await page.getByText(/ of 5\u202f000 events/).waitFor();
    await page.getByRole('tab', { name: 'Statistics' }).click();
    const command = await page.locator('.command code').textContent();
    const polygon = / --polygon (log:area_um,deform=\S+)$/.exec(command)?.[1];
    assert.ok(polygon, command);
    const wanted = await extracted(many, '--temperature', '23', '--polygon', polygon);
    assert.ok(Number(wanted.summary.valid) > 100, 'the polygon holds some events');
    assertSame(await recordings.exactStatistics(page), wanted);
  }),
);

test("An exported table of events has the lines of the command line's", { skip }, () =>
  inPage([many], async (page) => {
    await computeAt(page, 23);
    const answer = page.waitForResponse((each) => each.url().endsWith('/api/export'));
    await page.getByLabel('Export').selectOption({ label: 'Table of events' });
    const { file } = await (await answer).json();
    const { events } = await extracted(many, '--temperature', '23');
    assert.deepEqual(eventLines(await readFile(file, 'utf8')), events);
  }),
);

test('A click on an event shows its image and outline, and the contour of the model where it has a modulus', { skip }, () =>
  inPage([few], async (page) => {
    await computeAt(page, 23);
    await recordings.plotOf(page).focus();
    await page.keyboard.press('n');
    await page.locator('.event-image image').waitFor();
    await page.locator('.event-image .event-outline').waitFor();
    const size = await page.locator('.event-image image').evaluate(async (image) => {
      const picture = new Image();
      picture.src = image.href.baseVal;
      await picture.decode();
      return [picture.naturalWidth, picture.naturalHeight];
    });
    assert.deepEqual(size, [250, 80]);
    for (let event = 0; event < 8 && (await page.locator('.modulus .symbol').count()) === 0; ++event) {
      await page.keyboard.press('n');
      await page.waitForTimeout(300);
    }
    if ((await page.locator('.modulus .symbol').count()) > 0) await page.locator('.event-image .model-contour').waitFor();
  }),
);

test('A session file restores gates and the names of conditions', { skip }, () =>
  inPage([many], async (page, { target }) => {
    await page.locator('.recording.focused').getByLabel('Condition').fill('control');
    await page.keyboard.press('Enter');
    await recordings.drawBox(page, [0.3, 0.35], [0.55, 0.85]);
    const gates = await recordings.gatesOf(page);
    const answer = page.waitForResponse((each) => each.url().endsWith('/api/export'));
    await page.getByLabel('Export').selectOption({ label: 'Session' });
    const { file } = await (await answer).json();
    assert.ok(file.startsWith(target.output));
    await inPage([file], async (restored) => {
      assert.deepEqual(await recordings.gatesOf(restored), gates);
      assert.equal(await restored.locator('.recording.focused').getByLabel('Condition').inputValue(), 'control');
    });
  }),
);
