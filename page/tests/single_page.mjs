// build/rheocyte.html (tools/page) as a person and as a script uses it, for the tests.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { openWindow, skip as noPage } from './browser.mjs';
import { settled, until } from './cell_page.mjs';

const file = fileURLToPath(new URL('../../build/rheocyte.html', import.meta.url));
export const address = pathToFileURL(file).href;
export const skip = noPage || (existsSync(file) ? false : `there is no ${file}; tools/page makes it`);
export const run = promisify(execFile);

/** A folder of a file of tests, which is removed at its end. */
export const scratch = { folder: null };
before(async () => (scratch.folder = skip ? null : await mkdtemp(join(tmpdir(), 'rheocyte-single-'))));
after(() => scratch.folder && rm(scratch.folder, { recursive: true, force: true }));

/** Opens the file; whatever it asks of the network, and whatever fails in the page, is an error. */
export async function inPage(work) {
  const page = await openWindow({ acceptDownloads: true });
  const outside = [], failures = [];
  page.on('request', (request) => !/^(file|blob|data):/.test(request.url()) && outside.push(request.url()));
  page.on('pageerror', (failure) => failures.push(failure.message));
  try {
    await page.goto(address);
    await settled(page);
    await work(page);
    assert.deepEqual([outside, failures], [[], []]);
  } finally {
    await page.context().close();
  }
}

/** What the program within the page answers: [status, content]. */
export const answer = (page, path, { method = 'GET', body } = {}) =>
  page.evaluate(async ([target, how]) => {
    const found = await window.rheocyte.answer(target, how);
    return [found.status, await found.json()];
  }, [path, { method, ...(body === undefined ? {} : { body: JSON.stringify(body) }) }]);

/** The content alone, of GET or of POST. */
export const answered = async (page, path, body) =>
  (await answer(page, path, body === undefined ? {} : { method: 'POST', body }))[1];

/** The state of the moduli of an item after they have been computed; null if the program broke down meanwhile. */
export async function computed(page, item) {
  const path = `/api/items/${item}/moduli`;
  let state = await answered(page, path, {}).catch(() => null);
  await until(async () => {
    if (state?.state === 'running') state = await answered(page, path).catch(() => null);
    return state?.state !== 'running';
  });
  return state;
}

export async function give(page, ...files) {
  await page.getByRole('button', { name: 'Recordings', exact: true }).click();
  await page.locator('.open-files input').setInputFiles(files);
}

/** Chooses an entry of the menu of exports, and saves the download. */
export async function exported(page, title, name) {
  const download = page.waitForEvent('download');
  await page.getByLabel('Export').selectOption({ label: title });
  await (await download).saveAs(join(scratch.folder, name));
  return join(scratch.folder, name);
}
