// Three recordings have the numbers of the command line to the last digit; of 20 cases numbers.test.mjs says so.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { promisify } from 'node:util';
import { synthesise } from './prepared.mjs';
import { noProgram, program, startTarget } from './target.mjs';

const run = promisify(execFile);

/** What the page asks for, with the token of the address. */
function interfaceOf({ address }) {
  const { origin, searchParams } = new URL(address);
  const headers = { Authorization: `Bearer ${searchParams.get('token')}` };
  return async (method, path, body) => {
    const answer = await fetch(origin + path, { method, headers, body: body && JSON.stringify(body) });
    const text = await answer.text();
    assert.ok(answer.ok, `${path}: ${text}`);
    return JSON.parse(text);
  };
}

async function inFolder(work) {
  const folder = await mkdtemp(join(tmpdir(), 'rheocyte-numbers-'));
  try {
    await work(folder);
  } finally {
    await rm(folder, { recursive: true });
  }
}

test('3 recordings have the events and the summary of `rheocyte extract`', { skip: noProgram }, () =>
  inFolder(async (folder) => {
    const files = [];
    for (const [name, settings] of [
      ['small', ['recording.cells=300', 'recording.seed=3']],
      ['large', ['recording.cells=500', 'recording.seed=4']],
      ['other', ['recording.cells=200', 'recording.seed=5']],
    ]) {
      files.push(join(folder, `${name}.rtdc`));
      await synthesise(files.at(-1), settings);
    }
    const target = await startTarget(files);
    try {
      const ask = interfaceOf(target);
      for (const [item, file] of files.entries()) {
        while ((await ask('GET', `/api/items/${item}`)).state === 'loading') await new Promise((done) => setTimeout(done, 20));
        await ask('POST', `/api/items/${item}/moduli`, {});
        let moduli;
        do {
          await new Promise((done) => setTimeout(done, 50));
          moduli = await ask('GET', `/api/items/${item}/moduli`);
        } while (moduli.state === 'running');
        assert.equal(moduli.state, 'ready', moduli.error);
        const exported = await ask('POST', '/api/export', { what: 'events', item, name: `${item}.tsv` });
        const command = moduli.command.replace(/^rheocyte /, `"${program}" `);
        await run('sh', ['-c', `${command} --quiet -o ${join(folder, `${item}`)}`]);
        const written = await readFile(join(folder, `${item}`, file.split('/').pop().replace('.rtdc', '_rheocyte.tsv')), 'utf8');
        assert.equal(await readFile(exported.file, 'utf8'), written);
        const [heads, values] = (await readFile(join(folder, `${item}`, 'rheocyte_summary.tsv'), 'utf8')).trim().split('\n').map((line) => line.split('\t'));
        assert.ok(Number(values[heads.indexOf('valid')]) > 50);
        const told = heads.map((head) => moduli.summary[head]);
        assert.deepEqual(told, values.map((text, k) => (text === '' ? null : typeof told[k] === 'number' ? Number(text) : text)), moduli.command);
      }
    } finally {
      await target.stop();
    }
  }),
);
