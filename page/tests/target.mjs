// What the page is tested against: the program that RHEOCYTE names, or the mock.
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { startMock } from '../mock/serve.mjs';

export const program = process.env.RHEOCYTE;
const built = process.env.RHEOCYTE_PAGE;
/** Machines that run other tests at the same time are slow, most of all at the first start of the browser. */
export const patience_ms = 180_000;

/** The line that the program prints when it is ready; a program that ends before is an error with its last words. */
function ready(child) {
  return new Promise((found, failed) => {
    const said = [];
    const read = (stream) =>
      createInterface({ input: stream }).on('line', (line) => {
        said.push(line);
        const address = /^view: (http\S+)/.exec(line);
        if (address) found(address[1]);
      });
    read(child.stdout);
    read(child.stderr);
    child.on('error', failed);
    child.on('exit', (code) => failed(new Error(`the program ended with ${code}: ${said.join('\n')}`)));
    setTimeout(() => failed(new Error(`the program is not ready: ${said.join('\n')}`)), patience_ms).unref();
  });
}

async function startProgram(items) {
  const output = await mkdtemp(join(tmpdir(), 'rheocyte-view-'));
  const environment = built ? { ...process.env, RHEOCYTE_PAGE: built } : process.env;
  const child = spawn(program, ['view', ...items, '--no-browser', '--output', output], { env: environment });
  const ended = new Promise((done) => child.once('close', done));
  const stop = async () => {
    child.kill('SIGINT');
    const giveUp = setTimeout(() => child.kill('SIGKILL'), patience_ms);
    await ended;
    clearTimeout(giveUp);
    await rm(output, { recursive: true, force: true });
    if (child.signalCode === 'SIGKILL') throw new Error('The program did not end after SIGINT.');
  };
  try {
    return { address: await ready(child), output, stop };
  } catch (failure) {
    await stop();
    throw failure;
  }
}

/** The address to open first (with its token), the folder of exports (null for the mock), and a way to stop. */
export async function startTarget(items = []) {
  if (program) return startProgram(items);
  const mock = await startMock();
  return { address: mock.address, output: null, stop: mock.stop };
}
