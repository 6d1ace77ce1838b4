import assert from 'node:assert/strict';
import test from 'node:test';
import { skip } from './browser.mjs';
import { openCell, until } from './cell_page.mjs';
import { loadModule } from './load_module.mjs';
import { inPage } from './prepared_page.mjs';
import * as recordings from './recordings_page.mjs';

const { held, stageOf, pixelFrame, wholePicture, xOf, yOf } = await loadModule('cell/frame.ts');

const tablets = [[820, 1180], [1180, 820]].map(([width, height]) => ({ viewport: { width, height }, hasTouch: true, isMobile: true }));
const upright = tablets[0];

/** Fingers on the page: each call says where they are from now on; none: they are lifted. */
async function makeFingers(page) {
  const session = await page.context().newCDPSession(page);
  return (type, ...places) =>
    session.send('Input.dispatchTouchEvent', { type, touchPoints: places.map(({ x, y }, id) => ({ x, y, id })) });
}

/** Two fingers about a place, from one distance to another, and moved meanwhile. */
async function pinch(page, { x, y }, from, to, by = { x: 0, y: 0 }) {
  const touch = await makeFingers(page);
  const pair = (distance, fraction) => [-1, 1].map((side) => ({ x: x + fraction * by.x + (side * distance) / 2, y: y + fraction * by.y }));
  await touch('touchStart', pair(from, 0)[0]);
  await touch('touchStart', ...pair(from, 0));
  for (const fraction of [0.25, 0.5, 0.75, 1]) await touch('touchMove', ...pair(from + fraction * (to - from), fraction));
  await touch('touchEnd', pair(to, 1)[0]);
  await touch('touchEnd');
}

async function dragFinger(page, from, to) {
  const touch = await makeFingers(page);
  await touch('touchStart', from);
  for (const fraction of [0.3, 0.6, 1]) await touch('touchMove', { x: from.x + fraction * (to.x - from.x), y: from.y + fraction * (to.y - from.y) });
  await touch('touchEnd');
}

const middleOf = ({ x, y, width, height }) => ({ x: x + width / 2, y: y + height / 2 });
const near = (a, b, within) => Math.hypot(a.x - b.x, a.y - b.y) < within;
const widthOf = (page) => page.evaluate(() => document.documentElement.scrollWidth);

/** Buttons and menus in sight that are too low for a finger. */
const lowControls = (page) =>
  page.locator('button:visible, select:visible').evaluateAll((all) =>
    all.filter((each) => each.getBoundingClientRect().height < 34 && !each.matches('.alternative, .notice *')).map((each) => each.outerHTML.slice(0, 80)),
  );

test('What two fingers hold in the picture of the cell stays under them, and no more is painted than is seen', () => {
  const fields = { places: new Float32Array([-60, 0, 60, 11]) };
  const stage = stageOf(800, 400, 10.94, fields);
  const from = { middle: [300, 150], distance: 100 };
  const to = { middle: [340, 170], distance: 250 };
  const lens = held(stage, wholePicture, from, to);
  const seen = stageOf(800, 400, 10.94, fields, lens);
  assert.equal(lens.zoom, 2.5);
  const place = [stage.middle_um + (300 - 400) / stage.scale, (stage.axis - 150) / stage.scale];
  assert.ok(Math.abs(xOf(seen, place[0]) - 340) < 1e-9 && Math.abs(yOf(seen, place[1]) - 170) < 1e-9);
  assert.ok(pixelFrame(seen, 1, false).height <= 400);
  assert.deepEqual(stageOf(800, 400, 10.94, fields, held(seen, lens, to, { ...to, distance: 1 })), stage);
});

for (const options of tablets) {
  const { width, height } = options.viewport;
  test(`At ${width} x ${height} the workspace "Cell" is whole, its controls fit a finger, and the picture has room`, { skip }, async () => {
    const { page, end } = await openCell(options);
    try {
      assert.equal(await widthOf(page), width);
      assert.deepEqual(await lowControls(page), []);
      const box = await page.locator('.channel').boundingBox();
      assert.ok(box.width > 450 && box.height > 250, JSON.stringify(box));
      const controls = await page.locator('.controls').boundingBox();
      assert.ok(controls.height > 300, JSON.stringify(controls));
    } finally {
      await end();
    }
  });

  test(`At ${width} x ${height} the workspace "Recordings" is whole, also with an event and two plots`, { skip }, () =>
    inPage(async (page) => {
      await page.getByLabel('Two plots').check();
      await recordings.drawn(page, 2);
      const places = await recordings.pixelIn(page, 0.4, 0.7);
      await page.touchscreen.tap(places.x, places.y);
      await page.locator('.event-image').waitFor();
      assert.equal(await widthOf(page), width);
      for (const part of ['.toolbar', '.recordings-right', '.recordings-middle', '.plots'])
        assert.equal(await page.locator(part).evaluate((each) => Math.max(0, each.scrollWidth - each.clientWidth)), 0, part);
      const box = await recordings.plotOf(page, 2).boundingBox();
      assert.ok(box.width > 200 && box.height > 130, JSON.stringify(box));
    }, options));
}

test('A tap chooses an event, which stays under two fingers that stretch and move the plot', { skip }, () =>
  inPage(async (page) => {
    const at = await recordings.pixelIn(page, 0.45, 0.8);
    await page.touchscreen.tap(at.x, at.y);
    const chosen = page.locator('.chosen-event circle').first();
    await chosen.waitFor();
    const event = await page.getByLabel('Number of the event').inputValue();
    const before = middleOf(await chosen.boundingBox());
    await pinch(page, before, 80, 200, { x: 40, y: -60 });
    const wanted = { x: before.x + 40, y: before.y - 60 };
    assert.ok(await until(async () => near(middleOf(await chosen.boundingBox()), wanted, 2)), JSON.stringify([await chosen.boundingBox(), wanted]));
    assert.equal(await page.getByLabel('Number of the event').inputValue(), event);
    await dragFinger(page, wanted, { x: wanted.x - 50, y: wanted.y + 30 });
    assert.ok(await until(async () => near(middleOf(await chosen.boundingBox()), { x: wanted.x - 50, y: wanted.y + 30 }, 8)));
    assert.equal(await page.getByLabel('Number of the event').inputValue(), event);
  }, upright),
);

test('A finger draws a box gate; two fingers move the plot instead, and leave no gate', { skip }, () =>
  inPage(async (page) => {
    await page.getByRole('button', { name: 'Box', exact: true }).tap();
    await pinch(page, await recordings.pixelIn(page, 0.5, 0.5), 80, 120);
    assert.equal(await page.locator('.gate-shapes rect').count(), 0);
    await dragFinger(page, await recordings.pixelIn(page, 0.3, 0.3), await recordings.pixelIn(page, 0.7, 0.9));
    await page.locator('.gate-shapes rect').first().waitFor();
    assert.equal((await recordings.gatesOf(page)).length, 2);
  }, upright),
);

test('Two fingers stretch the picture of the cell, one finger then moves it, and all of it comes back', { skip }, async () => {
  const { page, end, failures } = await openCell(upright);
  try {
    const zoom = () => page.locator('.channel').getAttribute('data-zoom').then(Number);
    const box = await page.locator('.channel').boundingBox();
    const contour = page.locator('.channel .contour');
    const whole = await contour.boundingBox();
    const front = { x: whole.x + whole.width, y: whole.y + whole.height / 2 };
    await pinch(page, front, 60, 180);
    assert.ok(await until(async () => Math.abs((await zoom()) - 3) < 0.01), String(await zoom()));
    const stretched = await contour.boundingBox();
    assert.ok(Math.abs(stretched.width / whole.width - 3) < 0.1, JSON.stringify([whole, stretched]));
    assert.ok(Math.abs(stretched.x + stretched.width - front.x) < 4, JSON.stringify([front, stretched]));
    await dragFinger(page, middleOf(box), { x: middleOf(box).x + 70, y: middleOf(box).y });
    const moved = async () => (await contour.boundingBox()).x - stretched.x;
    assert.ok(await until(async () => Math.abs((await moved()) - 70) < 2), String(await moved()));
    // The browser may take a tap that follows a quick drag for the end of the drag: then it is tapped again.
    const showAll = () => page.getByRole('button', { name: 'Show all' }).tap({ timeout: 2000 }).catch(() => undefined);
    assert.ok(await until(async () => (await zoom()) === 1 || showAll().then(() => false)));
    assert.deepEqual(await contour.boundingBox(), whole);
    assert.deepEqual(failures, []);
  } finally {
    await end();
  }
});

test('A tap on the picture reads values out, also when it is stretched by keys', { skip }, async () => {
  const { page, end } = await openCell(upright);
  try {
    const box = await page.locator('.channel').boundingBox();
    const at = middleOf(box);
    await page.touchscreen.tap(at.x, at.y);
    const first = await page.locator('.readout').innerText();
    assert.match(first, /x -?0\.\d+ µm, r -?0\.\d+ µm/);
    await page.locator('.channel').press('+');
    await page.touchscreen.tap(at.x + 125, at.y);
    const second = () => page.locator('.readout').innerText({ timeout: 1000 }).catch(() => '');
    const x = (text) => Number(/x (-?[\d.]+)/.exec(text)?.[1]);
    const stage = stageOf(1, box.height, 10.94, null);
    assert.ok(await until(async () => Math.abs(x(await second()) - x(first) - 100 / stage.scale) < 0.2), `${first} ${await second()}`);
  } finally {
    await end();
  }
});
