import assert from 'node:assert/strict';
import { readFile, readdir, stat } from 'node:fs/promises';
import { createRequire } from 'node:module';
import test from 'node:test';
import { skip } from './browser.mjs';
import { openCell } from './cell_page.mjs';

const dist = new URL('../dist/', import.meta.url);
const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

test('The whole page weighs at most 600 kB compressed', async () => {
  const names = (await readdir(dist)).filter((name) => name.endsWith('.gz'));
  const sizes = await Promise.all(names.map(async (name) => (await stat(new URL(name, dist))).size));
  const total = sizes.reduce((sum, size) => sum + size, 0);
  assert.ok(total <= 600_000, `${total} bytes`);
});

test('three.js is loaded when a shape in three dimensions is shown, not before', async () => {
  const first = await readFile(new URL('app.js', dist), 'utf8');
  assert.ok(!first.includes('WebGLRenderer'));
});

test('The lock file names no host of packages', async () => {
  const lock = await readFile(new URL('../package-lock.json', import.meta.url), 'utf8');
  assert.ok(!lock.includes('"resolved"'));
});

/** Findings of axe-core that are serious or worse, as "rule: places". */
async function findings(page) {
  await page.evaluate(await readFile(axe, 'utf8'));
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  const grave = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
  return grave.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join(', ')}`);
}

for (const colorScheme of ['light', 'dark']) {
  for (const workspace of ['Cell', 'Recordings']) {
    test(`axe-core has no serious finding: ${workspace}, ${colorScheme}`, { skip }, async () => {
      const { page, end } = await openCell({ colorScheme });
      try {
        await page.getByRole('button', { name: workspace, exact: true }).click();
        assert.deepEqual(await findings(page), []);
      } finally {
        await end();
      }
    });
  }
}

test('At 1024 x 700 nothing is cut off at the right, and the picture has room', { skip }, async () => {
  const { page, end } = await openCell({ viewport: { width: 1024, height: 700 } });
  try {
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 1024);
    const box = await page.locator('.channel').boundingBox();
    assert.ok(box.width > 400 && box.height > 180, JSON.stringify(box));
  } finally {
    await end();
  }
});

test('The chosen theme outlives a reload', { skip }, async () => {
  const { page, end } = await openCell({ colorScheme: 'light' });
  try {
    await page.locator('.theme select').selectOption('dark');
    await page.reload();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  } finally {
    await end();
  }
});
