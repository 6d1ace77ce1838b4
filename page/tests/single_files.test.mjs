// build/rheocyte.html (tools/page) and files: given, damaged, odd, exported, and opened by others.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import test from 'node:test';
import { fileURLToPath } from 'node:url';
import { settled, shownDeformation, until } from './cell_page.mjs';
import { oddRecordings } from './odd_recordings.mjs';
import { synthesise } from './prepared.mjs';
import { computeModuli, drawn } from './recordings_page.mjs';
import { answered, computed, exported, give, inPage, run, scratch, skip } from './single_page.mjs';

/** Lists the recordings once no more are being opened. */
async function listed(page, name) {
  await page.locator('.recording', { hasText: name }).waitFor();
  return answered(page, '/api/items');
}

test('A companion is a download that opens as a recording; a session finds its recordings again by their names', { skip }, async () => {
  const recording = join(scratch.folder, "M\u00fcller's cells.rtdc");
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
    await give(page, join(scratch.folder, 'session.toml'), recording);
    await drawn(page);
    assert.ok(await page.getByLabel('Two plots').isChecked());
    assert.equal((await answered(page, '/api/items')).length, 1);
    assert.equal((await answered(page, '/api/items/0/moduli')).state, 'ready');
  });
});

const python = process.env.RHEOCYTE_PYTHON ?? fileURLToPath(new URL('../../build/python-environment/bin/python', import.meta.url));
function noDclab() {
  try {
    execFileSync(python, ['-c', 'import dclab'], { stdio: 'ignore' });
    return false;
  } catch {
    return `${python} has no dclab; RHEOCYTE_PYTHON can name another Python`;
  }
}
/** Events, columns and median of the moduli as dclab sees them, and the area of the recording that the companion refers to. */
const readByDclab = `
import json, sys
import dclab, numpy
with dclab.new_dataset(sys.argv[1]) as ds:
    print(json.dumps({"events": len(ds), "stored": "emodulus" in ds.features_innate,
                      "median": float(numpy.nanmedian(ds["emodulus"])), "area": float(numpy.median(ds["area_um"]))}))
`;
test('dclab opens a companion of the page, with its moduli and the columns of its recording', { skip: skip || noDclab() }, async () => {
  const recording = join(scratch.folder, 'for-dclab.rtdc');
  await synthesise(recording, ['recording.cells=80', 'recording.seed=9']);
  await inPage(async (page) => {
    await give(page, recording);
    await drawn(page);
    await computeModuli(page);
    const companion = await exported(page, 'Companion .rtdc', 'for-dclab_rheocyte.rtdc');
    const found = JSON.parse((await run(python, ['-c', readByDclab, companion])).stdout);
    const { summary } = await answered(page, '/api/items/0/moduli');
    assert.deepEqual([found.events, found.stored], [80, true]);
    assert.ok(found.area > 20 && found.area < 400, `${found.area}`);
    assert.ok(Math.abs(found.median / summary.young_modulus_median_kPa - 1) < 1e-5, JSON.stringify([found, summary]));
  });
});

test('A hundred recordings are given at once', { skip }, () =>
  inPage(async (page) => {
    const one = join(scratch.folder, 'one.rtdc');
    await synthesise(one, ['recording.cells=20', 'recording.seed=6', 'recording.pictures="none"']);
    const names = Array.from({ length: 100 }, (_, k) => join(scratch.folder, `one of many ${k}.rtdc`));
    for (const name of names) await copyFile(one, name);
    await give(page, ...names);
    await page.locator('.recording', { hasText: 'one of many 99' }).locator('.numbers').waitFor();
    assert.ok((await answered(page, '/api/items')).every(({ state, events }) => state === 'ready' && events === 20));
  }));

test('A damaged recording is told, and leaves the page and the other recordings as they are', { skip }, () =>
  inPage(async (page) => {
    const sound = join(scratch.folder, 'sound.rtdc'), cut = join(scratch.folder, 'cut.rtdc'), text = join(scratch.folder, 'text.rtdc');
    await synthesise(sound, ['recording.cells=50', 'recording.seed=4']);
    const bytes = await readFile(sound);
    await writeFile(cut, bytes.subarray(0, bytes.length / 2));
    await writeFile(text, 'no recording\n');
    await give(page, cut, text, sound);
    await drawn(page);
    assert.equal(await page.locator('.recording.failed .alarm').count(), 2);
  }));

test('Of fifty odd recordings each is read or told in a sentence, and the page goes on', { skip }, () =>
  inPage(async (page) => {
    const odd = await oddRecordings(join(scratch.folder, 'odd'));
    assert.equal(odd.length, 50);
    const last = join(scratch.folder, 'last of all.rtdc');
    await copyFile(odd.at(-1), last);
    await give(page, ...odd, last);
    const items = await listed(page, 'last of all');
    assert.equal(items.length, 51);
    for (const { name, state, error } of items) {
      assert.ok(['ready', 'failed'].includes(state), `${name}: ${state}`);
      assert.ok(state === 'ready' || /^[^\n]{10,600}\.$/.test(error), `${name}: ${error}`);
    }
    assert.equal(items.at(-1).state, 'ready');
    for (const { item, state } of items) if (state === 'ready') await computed(page, item); // what breaks down is left out
    assert.equal((await computed(page, 50)).state, 'ready');
    assert.ok(await page.locator('.recording', { hasText: 'last of all' }).isVisible());
  }));

/** As a person drops them: with the browser's own events, which know folders. */
async function drop(page, ...files) {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop']) await session.send('Input.dispatchDragEvent', { type, x: 600, y: 400, data });
}
const told = (page, text) => page.locator('.notice', { hasText: text }).waitFor();

test('A case that is dropped is shown; what is none, and a folder, is told in a sentence', { skip }, () =>
  inPage(async (page) => {
    const path = (name) => join(scratch.folder, name);
    await mkdir(path('many'));
    await writeFile(path('note.txt'), 'a note\n');
    await writeFile(path('odd.toml'), 'x = [\n');
    const text = await readFile(fileURLToPath(new URL('../../examples/small-linear-cell.toml', import.meta.url)), 'utf8');
    await writeFile(path('a case.toml'), text.replaceAll('\n', '\r\n'));
    const before = await shownDeformation(page);
    await drop(page, path('many'), path('note.txt'), path('odd.toml'));
    await told(page, 'many is a folder: open it, and drop the files that are in it.');
    await told(page, /^note\.txt:1: /);
    await told(page, /^odd\.toml:1: not valid TOML/);
    assert.equal(await shownDeformation(page), before);
    await drop(page, path('a case.toml'));
    await until(async () => (await shownDeformation(page)) !== before);
    assert.notEqual(await shownDeformation(page), before);
  }));

test('Closed while it computes, and opened again, the page begins anew and takes the same files', { skip }, () =>
  inPage(async (page) => {
    const recording = join(scratch.folder, 'again.rtdc');
    await synthesise(recording, ['recording.cells=300', 'recording.seed=10', 'recording.pictures="none"']);
    for (let time = 0; time < 3; ++time) {
      await give(page, recording);
      await drawn(page);
      await page.evaluate(() => void window.rheocyte.answer('/api/items/0/moduli', { method: 'POST', body: '{}' }).catch(() => undefined));
      await page.reload();
      await page.locator('header h1').waitFor();
      assert.deepEqual(await answered(page, '/api/items'), []);
    }
    await page.getByRole('button', { name: 'Cell', exact: true }).click();
    await settled(page);
  }));
