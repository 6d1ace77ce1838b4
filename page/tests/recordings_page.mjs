// The workspace "Recordings" as a person uses it, for the tests.
import assert from 'node:assert/strict';
import { openPage } from './browser.mjs';
import { startTarget } from './target.mjs';

/** Opens the workspace with these items and waits until the events of the recording in focus are drawn. */
export async function openRecordings(options, items) {
  const target = await startTarget(items);
  return openPage(target, options, async (page) => {
    await page.goto(target.address);
    await page.getByRole('button', { name: 'Recordings', exact: true }).click();
    await drawn(page);
  });
}

/** Events of the plot are on the screen. */
export const drawn = (page, plot = 1) => page.locator(`[data-plot="${plot}"] canvas[data-events]:not([data-events="0"])`).waitFor();

export const plotOf = (page, plot = 1) => page.locator(`[data-plot="${plot}"]`);

/** Pixel of a place within the plot, by fractions of its frame from the left and from above. */
export async function pixelIn(page, right, down, plot = 1) {
  const box = await page.locator(`[data-plot="${plot}"] canvas`).boundingBox();
  return { x: box.x + right * box.width, y: box.y + down * box.height };
}

export async function drag(page, from, to) {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
  await page.mouse.move(to.x, to.y);
  await page.mouse.up();
}

/** Draws a box gate over a part of the plot. */
export async function drawBox(page, from, to) {
  await page.getByRole('button', { name: 'Box', exact: true }).click();
  await drag(page, await pixelIn(page, ...from), await pixelIn(page, ...to));
  await page.locator('.gate-shapes rect').first().waitFor();
}

/** The cells of a recording's row in the table of statistics, by the heads of their columns. */
export async function statisticsOf(page, item) {
  const heads = await page.locator('.statistics thead th').allTextContents();
  const cells = await page.locator(`.statistics tr[data-item="${item}"] > *`).allTextContents();
  return Object.fromEntries(heads.map((head, k) => [head, cells[k]]));
}

/** Those of the first recording to ten digits, by the heads of their columns. */
export async function exactStatistics(page) {
  const heads = await page.locator('.statistics thead th').allTextContents();
  const titles = await page.locator('.statistics tr[data-item="0"] > *').evaluateAll((cells) => cells.map((cell) => cell.title || cell.textContent));
  return Object.fromEntries(heads.map((head, k) => [head, titles[k]]));
}

export const numberIn = (text) => Number(text.replace(/[\u202f\s]/g, '').replace('\u2212', '-'));

/** Computes the moduli of the recording in focus and waits for their statistics. */
export async function computeModuli(page, item = 0) {
  await page.getByRole('button', { name: 'Compute moduli', exact: true }).click();
  await page.waitForFunction((number) => {
    const cell = document.querySelector(`.statistics tr[data-item="${number}"] td:nth-child(5)`);
    return cell && cell.textContent !== '–';
  }, item);
}

/** The gates as they are listed: name and ends. */
export async function gatesOf(page) {
  await page.getByRole('tab', { name: /^Gates/ }).click();
  const rows = await page.locator('.gate').all();
  return Promise.all(
    rows.map(async (row) => ({
      name: (await row.locator('.gate-name span').textContent()).trim(),
      values: await row.locator('input[type="text"]').evaluateAll((inputs) => inputs.map((input) => input.value)),
    })),
  );
}

/** The next request to write a file. */
export async function exportRequest(page, title) {
  const request = page.waitForRequest((each) => each.url().endsWith('/api/export'));
  await page.getByLabel('Export').selectOption({ label: title });
  return JSON.parse((await request).postData());
}

/** A window that is opened at the same address while the recordings are shown, asserted to show them, too. */
export async function aSecondWindowShowsTheRecordings(page, address) {
  const saved = page.waitForRequest((each) => each.method() === 'PUT' && each.url().endsWith('/api/session'));
  await page.getByLabel('Two plots').check();
  await saved;
  const second = await page.context().newPage();
  await second.goto(address);
  await drawn(second);
  assert.equal(new URL(second.url()).hash, '#recordings');
}
