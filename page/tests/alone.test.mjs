// The page without a server, with a stand-in for the program: requests, stops, breakdowns, files in and out.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdir, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test, { after, before } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { openWindow, skip } from './browser.mjs';
import { until } from './cell_page.mjs';

const here = (name) => fileURLToPath(new URL(name, import.meta.url));
let folder;
before(async () => {
  if (skip) return;
  folder = await mkdtemp(join(tmpdir(), 'rheocyte-alone-'));
  await mkdir(join(folder, 'tables'));
  await writeFile(join(folder, 'tables', 'one.cbor'), 'a table');
  await makePage('page with blanks', await readFile(here('stand_in_engine.js'), 'utf8'));
});
after(() => folder && rm(folder, { recursive: true, force: true }));

async function makePage(name, engine) {
  const place = join(folder, `engine of ${name}`);
  await mkdir(place);
  await writeFile(join(place, 'engine.js'), engine);
  await writeFile(join(place, 'engine.wasm'), Buffer.from('\0asm\x01\0\0\0', 'latin1')); // an empty program
  execFileSync(process.execPath, [here('../single.mjs'), place, join(folder, 'tables'), join(folder, `${name}.html`)]);
}

/** Runs `work` with the page; whatever it asks of the network is an error. */
async function inPage(work, name = 'page with blanks') {
  const page = await openWindow();
  const outside = [];
  page.on('request', (request) => !/^(file|blob|data):/.test(request.url()) && outside.push(request.url()));
  try {
    await page.goto(pathToFileURL(join(folder, `${name}.html`)).href);
    await page.locator('header h1').waitFor();
    await work(page);
    assert.deepEqual(outside, []);
  } finally {
    await page.context().close();
  }
}

const ask = (page, path, options = {}) =>
  page.evaluate(async ([target, how]) => {
    const answer = await window.rheocyte.answer(target, how);
    return { status: answer.status, kind: answer.headers.get('X-Kind'), text: await answer.text() };
  }, [path, options]);

const give = (page, ...names) =>
  page.locator('.open-files input').setInputFiles(names.map((name) => ({ name, mimeType: 'application/octet-stream', buffer: Buffer.from('content') })));

const notice = (page, text) => page.locator('.notice', { hasText: text }).waitFor();

async function openRecordings(page) {
  await page.getByRole('button', { name: 'Recordings', exact: true }).click();
}

test('A request is answered by the worker with status, headers and body', { skip }, () =>
  inPage(async (page) => {
    const { status, kind, text } = await ask(page, '/api/echo', { method: 'POST', body: '{"x": 1}' });
    assert.deepEqual([status, kind, JSON.parse(text)], [200, 'stand-in', { method: 'POST', body: '{"x": 1}' }]);
    assert.equal((await ask(page, '/api/none')).status, 404);
  }));

test('The program finds the tables as they were before they were packed', { skip }, () =>
  inPage(async (page) => {
    assert.equal((await ask(page, '/api/table')).text, 'a table');
  }));

test('What nobody waits for any more ends by itself, if it is short, and the next is answered by the same worker', { skip }, () =>
  inPage(async (page) => {
    const found = await page.evaluate(async () => {
      const control = new AbortController();
      const short = window.rheocyte.answer('/api/short', { signal: control.signal }).catch((reason) => reason.name);
      const waits = window.rheocyte.answer('/api/echo', { signal: control.signal }).catch((reason) => reason.name);
      const next = window.rheocyte.answer('/api/echo', {});
      setTimeout(() => control.abort(), 200);
      return [await short, await waits, (await next).status];
    });
    assert.deepEqual(found, ['AbortError', 'AbortError', 200]);
    assert.equal(await page.locator('.notice', { hasText: 'Stopped' }).count(), 0);
  }));

test('DELETE of an address stops what was posted there, however long that would take', { skip }, () =>
  inPage(async (page) => {
    await openRecordings(page);
    await give(page, 'a.rtdc');
    await page.locator('.recording', { hasText: 'a.rtdc' }).waitFor();
    const found = await page.evaluate(async () => {
      const posted = window.rheocyte.answer('/api/long', { method: 'POST', body: '' }).catch((reason) => reason.name);
      await new Promise((next) => setTimeout(next, 200));
      void window.rheocyte.answer('/api/long', { method: 'DELETE' }).catch(() => undefined);
      return posted;
    });
    assert.equal(found, 'AbortError');
    await notice(page, 'Stopped; moduli that were computed before must be computed again.');
    const { text } = await ask(page, '/api/items');
    assert.deepEqual(JSON.parse(text).map(({ name }) => name), ['a.rtdc']);
  }));

test('Moduli tell how far they have come, and are stopped without the loss of what was computed before', { skip }, () =>
  inPage(async (page) => {
    await openRecordings(page);
    await give(page, 'a.rtdc');
    await page.locator('.recording', { hasText: 'a.rtdc' }).waitFor();
    const found = await page.evaluate(async () => {
      const ask = async (method) => {
        const answer = await window.rheocyte.answer('/api/items/0/moduli', { method, ...(method === 'POST' ? { body: '{}' } : {}) });
        return [answer.status, (await answer.json()).state];
      };
      return [await ask('POST'), await ask('GET'), await ask('DELETE'), await ask('GET')];
    });
    assert.deepEqual(found, [[202, 'running'], [200, 'running'], [200, 'none'], [200, 'none']]);
    assert.equal(await page.locator('.notice', { hasText: 'Stopped' }).count(), 0);
  }));

test('A breakdown is told in a sentence, and the program goes on with the same files', { skip }, () =>
  inPage(async (page) => {
    await openRecordings(page);
    await give(page, 'a.rtdc', 'b.rtdc');
    await page.locator('.recording', { hasText: 'b.rtdc' }).waitFor();
    await ask(page, '/api/breaks').catch(() => undefined);
    await notice(page, 'The program broke down and was started again');
    const { text } = await ask(page, '/api/items');
    assert.deepEqual(JSON.parse(text).map(({ name, state }) => [name, state]), [['a.rtdc', 'ready'], ['b.rtdc', 'ready']]);
    await ask(page, '/api/items/1/odd').catch(() => undefined);
    await notice(page, 'Reading b.rtdc broke the program down');
    const after = await ask(page, '/api/items');
    assert.deepEqual(JSON.parse(after.text).map(({ name, state }) => [name, state]), [['a.rtdc', 'ready'], ['b.rtdc', 'failed']]);
    await ask(page, '/api/items/0/gone').catch(() => undefined);
    await notice(page, 'a.rtdc has been changed, moved or removed since it was given: give it again.');
  }));

test('Of many files that are given at once the one that breaks the program down is left out, and the others are opened', { skip }, () =>
  inPage(async (page) => {
    await openRecordings(page);
    await give(page, ...Array.from({ length: 100 }, (_, k) => `${k}.rtdc`), 'breaks.rtdc', 'last.rtdc');
    await notice(page, 'Reading breaks.rtdc broke the program down; it was started again without that file.');
    const { text } = await ask(page, '/api/items');
    const states = JSON.parse(text).map(({ state }) => state);
    assert.deepEqual(states, [...Array(100).fill('ready'), 'failed', 'ready']);
  }));

test('A file whose reading never ends is left out after a minute', { skip }, () =>
  inPage(async (page) => {
    await page.clock.install();
    await openRecordings(page);
    await give(page, 'a.rtdc');
    await page.locator('.recording', { hasText: 'a.rtdc' }).waitFor();
    await give(page, 'hangs.rtdc', 'b.rtdc');
    const sentence = 'Nothing could be read of hangs.rtdc for 60 s; the program was started again without that file.';
    const told = page.locator('.notice', { hasText: sentence });
    // The minute passes once, before b.rtdc is read, however long the program takes to start again.
    const isTold = async () => {
      await page.clock.fastForward(61_000);
      return told.waitFor({ timeout: 10_000 }).then(() => true, () => false);
    };
    assert.ok(await until(isTold));
    const { text } = await ask(page, '/api/items');
    assert.deepEqual(JSON.parse(text).map(({ state }) => state), ['ready', 'failed', 'ready']);
  }));

test('A file that cannot be opened is told, and the others are listed', { skip }, () =>
  inPage(async (page) => {
    await openRecordings(page);
    await give(page, 'odd.rtdc', 'even.rtdc');
    await notice(page, 'odd.rtdc: is odd.');
    await page.locator('.recording', { hasText: 'even.rtdc' }).waitFor();
  }));

test('Exports become downloads, a folder as an archive that Python opens', { skip }, () =>
  inPage(async (page) => {
    for (const [name, saved] of [['cells.tsv', 'cells.tsv'], ['folder', 'folder.zip']]) {
      const download = page.waitForEvent('download');
      const { text } = await ask(page, '/api/export', { method: 'POST', body: JSON.stringify({ name }) });
      assert.deepEqual(JSON.parse(text), { file: `${saved}, among the downloads` });
      const got = await download;
      assert.equal(got.suggestedFilename(), saved);
      await got.saveAs(join(folder, saved));
    }
    assert.equal(await readFile(join(folder, 'cells.tsv'), 'utf8'), 'content');
    const check = 'import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); assert z.testzip() is None; print({n: z.read(n).decode() for n in z.namelist()})';
    const listed = execFileSync('python3', ['-c', check, join(folder, 'folder.zip')], { encoding: 'utf8' }).trim();
    assert.equal(listed, "{'folder/a.txt': 'content of a.txt', 'folder/b.txt': 'content of b.txt'}");
  }));

test('A cell that is solved and left alone keeps nobody waiting and takes no recording with it', { skip }, () =>
  inPage(async (page) => {
    await openRecordings(page);
    await give(page, 'a.rtdc');
    await page.locator('.recording', { hasText: 'a.rtdc' }).waitFor();
    const found = await page.evaluate(async () => {
      const control = new AbortController();
      const slow = window.rheocyte.answer('/api/state?endless', { method: 'POST', body: '{}', signal: control.signal }).catch((reason) => reason.name);
      const meanwhile = await (await window.rheocyte.answer('/api/items', {})).json();
      control.abort();
      const next = await window.rheocyte.answer('/api/state', { method: 'POST', body: '{}' });
      return [meanwhile.length, await slow, next.status];
    });
    assert.deepEqual(found, [1, 'AbortError', 200]);
    assert.equal(await page.locator('.notice', { hasText: 'Stopped' }).count(), 0);
  }));

test('In a browser that cannot run the program the page says so once, and refuses what is asked later', { skip }, async () => {
  await makePage('none', 'const rheocyteEngine = () => Promise.reject(new Error("no SIMD"));');
  await inPage(async (page) => {
    const sentence = 'The program cannot run in this browser (no SIMD); it needs WebAssembly with SIMD and exceptions';
    await notice(page, sentence);
    const reason = await page.evaluate(() => window.rheocyte.answer('/api/keys', {}).catch(({ message }) => message));
    assert.ok(reason.startsWith(sentence), reason);
    assert.equal(await page.locator('.notice', { hasText: sentence }).count(), 1);
  }, 'none');
});
