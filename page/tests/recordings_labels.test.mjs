import assert from 'node:assert/strict';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { skip } from './browser.mjs';
import { synthesise } from './prepared.mjs';
import { inPage } from './prepared_page.mjs';

// Cells with all moduli, so that all labels are there; names of recordings and conditions as in a series of doses.
const cells = ['recording.cells=60', 'flow.axial_tension_Pa=400', 'flow.rate_ul_per_s=0.06', 'cell.bulk.young_modulus_kPa.mean=4'];
const doses = [['control', 0], ['LatB 0.001 uM', 0.001], ['LatB 0.025 uM', 0.025]];
const folder = skip ? null : await mkdtemp(join(tmpdir(), 'rheocyte-labels-'));
after(() => folder && rm(folder, { recursive: true, force: true }));
const files = folder ? doses.flatMap(([, dose]) => [1, 2].map((set) => join(folder, `LatB_set${set}_${dose}.rtdc`))) : [];
for (const [k, file] of files.entries()) await synthesise(file, [...cells, `recording.seed=${k + 1}`]);

/** Labels that are cut off, or lie outside their picture or panel. */
const cutIn = (page, places) =>
  page.evaluate((selectors) => {
    const ink = document.createElement('canvas').getContext('2d');
    const widthOf = (text, { font }) => ((ink.font = font), ink.measureText(text).width);
    const arrow = 18;
    const cut = [];
    for (const place of document.querySelectorAll(selectors)) {
      if (place.scrollWidth > place.clientWidth) cut.push(`${place.className || place.id}: ${place.scrollWidth} > ${place.clientWidth}`);
      for (const each of place.querySelectorAll('th, td, p, li, label, button, summary, h2, h3, select, text')) {
        const box = each.getBoundingClientRect();
        const isShown = each.checkVisibility() && !each.closest('.hidden') && box.width > 0;
        if (!isShown) continue;
        const style = getComputedStyle(each);
        if (each instanceof SVGElement) {
          const frame = each.closest('svg').getBoundingClientRect();
          const isOut = box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 1;
          if (isOut || each.textContent.includes('…')) cut.push(each.textContent);
        } else if (each instanceof HTMLSelectElement) {
          const room = each.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - arrow;
          if (widthOf(each.selectedOptions[0].textContent, style) > room) cut.push(`select: ${each.selectedOptions[0].textContent}`);
        } else if (style.display !== 'inline' && each.scrollWidth > each.clientWidth) cut.push(each.textContent);
      }
    }
    return cut;
  }, places);

const name = async (page, item, label, text) => {
  await page.locator('.recording').nth(item).getByLabel(label, { exact: true }).fill(text);
  await page.keyboard.press('Enter');
};

for (const width of [1280, 1920])
  test(`no label of the tabs and of the event is cut off at ${width} pixels`, { skip }, () =>
    inPage(
      async (page) => {
        for (let item = 0; item < files.length; ++item) {
          await page.locator('.recording-name').nth(item).click();
          await name(page, item, 'Condition', doses[Math.floor(item / 2)][0]);
          await name(page, item, 'Replicate', String(1 + (item % 2)));
        }
        await page.getByRole('button', { name: 'Compute the moduli of all 6 recordings' }).click();
        await page.locator('.statistics tr[data-item="5"] .recommended', { hasText: '±' }).waitFor();
        await page.locator('[data-plot="1"]').focus();
        await page.keyboard.press('n');
        await page.locator('.modulus .large', { hasText: 'kPa' }).waitFor();
        const places = '.results-head, #results-panel, .plot-keys, .violins-scroll, .inspector, .to-report';
        const whole = async (when) => assert.deepEqual(await cutIn(page, places), [], when);
        const quantities = await page.getByLabel('Quantity').locator('option').allTextContents();
        for (const quantity of quantities) {
          await page.getByLabel('Quantity').selectOption(quantity);
          await whole(`Statistics of ${quantity}`);
        }
        await page.getByRole('tab', { name: 'Populations' }).click();
        for (const quantity of quantities) {
          await page.getByLabel('Quantity').selectOption(quantity);
          await page.getByRole('img', { name: `Distributions of ${quantity} by recording` }).waitFor();
          await whole(`Populations by ${quantity}`);
        }
        await page.getByRole('button', { name: 'Fit populations' }).click();
        await page.locator('.violins .session').first().waitFor();
        await page.getByText('Doses of the conditions').click();
        await page.getByText('In words, and as a command').click();
        await whole('Populations, fitted');
        await page.getByRole('tab', { name: /^Gates/ }).click();
        for (const feature of ['area_um', 'young_modulus_asymmetry_kPa_error']) await page.getByLabel('Limit').selectOption(feature);
        await whole('Gates');
      },
      { viewport: { width, height: 900 } },
      files,
    ),
  );
