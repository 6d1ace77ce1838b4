import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import test from 'node:test';
import { skip } from './browser.mjs';
import { inPage } from './prepared_page.mjs';
import * as recordings from './recordings_page.mjs';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

const press = async (page, keys) => {
  for (const key of keys) await page.keyboard.press(key);
};
const times = (count, key) => Array(count).fill(key);
const axisOf = (page) => page.locator('[data-plot="1"] .plot-axes').first().textContent();

test('By keys alone a plot is moved, stretched and shown whole again', { skip }, () =>
  inPage(async (page) => {
    const whole = await axisOf(page);
    await recordings.plotOf(page).focus();
    await press(page, ['ArrowRight', 'ArrowUp', '+', '+']);
    assert.notEqual(await axisOf(page), whole);
    await press(page, ['0']);
    assert.equal(await axisOf(page), whole);
  }),
);

test('By keys alone an event is chosen with the crosshair', { skip }, () =>
  inPage(async (page) => {
    await recordings.plotOf(page).focus();
    await press(page, [...times(8, 'Shift+ArrowLeft'), ...times(6, 'Shift+ArrowDown'), 'Enter']);
    await page.locator('.event-image .model-contour').waitFor();
    const first = await page.getByLabel('Number of the event').inputValue();
    await press(page, ['n']);
    assert.equal(Number(await page.getByLabel('Number of the event').inputValue()), Number(first) + 1);
  }),
);

test('By keys alone a box and a polygon become gates', { skip }, () =>
  inPage(async (page) => {
    await recordings.plotOf(page).focus();
    await press(page, ['b', 'Enter', ...times(10, 'Shift+ArrowLeft'), ...times(8, 'Shift+ArrowDown'), 'Enter']);
    await page.locator('.gate-shapes rect').waitFor();
    await press(page, ['g', 'Enter', ...times(6, 'Shift+ArrowRight'), 'Enter', ...times(6, 'Shift+ArrowUp'), 'Enter', 'c']);
    await page.locator('.gate-shapes path').waitFor();
    assert.equal((await recordings.gatesOf(page)).length, 3);
  }),
);

test('By keys alone a gate gets its limits as numbers', { skip }, () =>
  inPage(async (page) => {
    await page.getByRole('tab', { name: 'Statistics' }).focus();
    await press(page, ['ArrowRight']);
    await page.getByLabel('Limit').selectOption('area_um');
    await page.getByLabel('Maximum Area').fill('70');
    await press(page, ['Enter']);
    await page.getByText(/^\d+ of \d+ events/).waitFor();
  }),
);

for (const colorScheme of ['light', 'dark'])
  test(`axe-core has no serious finding with moduli, gates and an event, ${colorScheme}`, { skip }, () =>
    inPage(
      async (page) => {
        await recordings.computeModuli(page);
        await recordings.drawBox(page, [0.3, 0.35], [0.55, 0.85]);
        await recordings.plotOf(page).focus();
        await press(page, ['n']);
        await page.locator('.event-image .model-contour').waitFor();
        await page.evaluate(await readFile(axe, 'utf8'));
        for (const tab of ['Statistics', 'Gates', 'Populations']) {
          await page.getByRole('tab', { name: tab }).click();
          const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
          const grave = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
          assert.deepEqual(grave.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' '))}`), []);
        }
      },
      { colorScheme },
    ),
  );

test('At 1024 x 700 nothing is cut off at the right and two plots have room', { skip }, () =>
  inPage(
    async (page) => {
      await page.getByLabel('Two plots').check();
      await recordings.drawn(page, 2);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 1024);
      const cut = await page.locator('.toolbar').evaluate((bar) => bar.scrollWidth - bar.clientWidth);
      assert.equal(cut, 0);
      const box = await recordings.plotOf(page, 2).boundingBox();
      assert.ok(box.width > 200 && box.height > 130, JSON.stringify(box));
    },
    { viewport: { width: 1024, height: 700 } },
  ),
);
