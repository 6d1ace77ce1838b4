// The workspace "Recordings" with the prepared recordings: written once for a file of tests.
import assert from 'node:assert/strict';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';
import { skip } from './browser.mjs';
import { prepareRecordings } from './prepared.mjs';
import { openRecordings } from './recordings_page.mjs';

const folder = skip ? null : await mkdtemp(join(tmpdir(), 'rheocyte-recordings-'));
after(() => folder && rm(folder, { recursive: true, force: true }));
const files = folder ? await prepareRecordings(folder) : [];

/** A test in the page, which must report no error; with the prepared recordings, or others. */
export async function inPage(work, options, shown = files) {
  const opened = await openRecordings(options, shown);
  try {
    await work(opened.page, opened);
    assert.deepEqual(opened.failures, []);
  } finally {
    await opened.end();
  }
}

/** Columns of a recording by their names, as the program answers: arrays of numbers. */
export function columnsOf(page, item, ...features) {
  const read = async ([number, names]) => {
    const answer = await fetch(`/api/items/${number}/events?type=float64&features=${names}`);
    const { events } = JSON.parse(answer.headers.get('X-Rheocyte-Columns'));
    const values = new Float64Array(await answer.arrayBuffer());
    return Object.fromEntries(names.map((name, k) => [name, [...values.subarray(k * events, (k + 1) * events)]]));
  };
  return page.evaluate(read, [item, features]);
}
