// What the page is tested against: the program that RHEOCYTE names, else the one in build/.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

export const program = process.env.RHEOCYTE ?? fileURLToPath(new URL('../../build/rheocyte', import.meta.url));
/** Why tests of the program are skipped, or false. */
export const noProgram = existsSync(program) ? false : `there is no ${program}; RHEOCYTE can name another one`;
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

/** Starts the view: the address to open first (with its token), the folder of exports, and a way to stop. */
export async function startTarget(items = []) {
  const output = await mkdtemp(join(tmpdir(), 'rheocyte-view-'));
  const child = spawn(program, ['view', ...items, '--no-browser', '--output', output]);
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
    return { address: await ready(child), output, process: child.pid, stop };
  } catch (failure) {
    await stop();
    throw failure;
  }
}
