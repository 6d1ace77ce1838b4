// build/rheocyte.html on this machine: time until it answers, states of a slider that moves, moduli of a recording, and the
// memory of its process; beside them the same requests to `rheocyte view`. Times of the clock suffer from whatever else
// runs; the ratios are those of processor time.
//     build/rheocyte synth examples/recordings/virtual-cells.toml --set recording.cells=20000 -o cells.rtdc
//     RECORDING=cells.rtdc node page/bench/page_file.mjs
import { execFile } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { openWindow } from '../tests/browser.mjs';
import { program, startTarget } from '../tests/target.mjs';

const file = fileURLToPath(new URL('../../build/rheocyte.html', import.meta.url));
const page = await openWindow();
const begin = performance.now();
await page.goto(pathToFileURL(file).href);
await page.waitForFunction(() => window.rheocyte);
await page.evaluate(() => window.rheocyte.answer('/api/health', {}).then((answer) => answer.text()));
console.log(`answers after ${((performance.now() - begin) / 1000).toFixed(2)} s`);

const target = await startTarget();
const native = await openWindow();
await native.goto(`${target.address}#cell`);
await native.locator('.cell[data-working="idle"] .numbers .lead').waitFor();

const session = await page.context().browser().newBrowserCDPSession();
/** The process in which page and workers of the file are. */
const { processInfo } = await session.send('SystemInfo.getProcessInfo');
const inFile = processInfo.filter(({ type }) => type === 'renderer').sort((a, b) => b.cpuTime - a.cpuTime)[0].id;

/** Seconds of processor time that a process has taken. */
async function taken(process) {
  const text = await readFile(`/proc/${process}/stat`, 'utf8');
  const [, , ...fields] = text.slice(text.lastIndexOf(')')).split(' ');
  const user = 10, system = 11, ticks = 100;
  return (Number(fields[user]) + Number(fields[system])) / ticks;
}

/** Seconds of states of a cell whose modulus changes in small steps. */
const states = (where, [section, accuracy], count) =>
  where.evaluate(async ([form, error, steps]) => {
    const times = [];
    for (let k = 0; k < steps; ++k) {
      const cell = { radius_um: 7.66, bulk: { law: 'neo-hookean', young_modulus_kPa: 3.4 + 0.03 * k } };
      const body = JSON.stringify({ channel: { section: form, width_um: 20 }, flow: { rate_ul_per_s: 0.04, viscosity_mPas: 15 }, cell });
      const start = performance.now();
      const how = { method: 'POST', body, headers: { 'Content-Type': 'application/json' } };
      const path = `/api/state?stream=bench-${form}-${error}&accuracy=${error}`;
      const answer = await (window.rheocyte ? window.rheocyte.answer(path, how) : fetch(path, how));
      await answer.text();
      if (!answer.ok) throw new Error(`status ${answer.status}`);
      times.push((performance.now() - start) / 1000);
    }
    return times;
  }, [section, accuracy, count]);
const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

/** The same states in both, once warm: seconds of the clock in the file, and how processor times compare. */
async function compare(kind, warm, count) {
  const [first, ...others] = await states(page, kind, warm);
  await states(native, kind, warm);
  const before = [await taken(inFile), await taken(target.process)];
  const times = await states(page, kind, count);
  await states(native, kind, count);
  const after = [await taken(inFile), await taken(target.process)];
  const [ours, theirs] = after.map((seconds, k) => (seconds - before[k]) / count);
  const clock = `first ${first.toFixed(2)} s, then ${(1000 * median([...others, ...times])).toFixed(0)} ms`;
  console.log(`${kind.join(', ')}: ${clock}; processor time ${(1000 * ours).toFixed(0)} ms, native ${(1000 * theirs).toFixed(0)} ms, ratio ${(ours / theirs).toFixed(2)}`);
}
await compare(['square', 3e-2], 3, 4);
await compare(['tube', 1e-3], 20, 60);
await compare(['tube', 1e-4], 10, 30);
if (process.env.SQUARE) await compare(['square', 1e-3], 1, 2);

async function moduli(recording) {
  await page.getByRole('button', { name: 'Recordings', exact: true }).click();
  await page.locator('.open-files input').setInputFiles(recording);
  await page.locator('.recording .numbers').waitFor();
  const before = await taken(inFile), start = performance.now();
  const { state, error, lines } = await page.evaluate(async () => {
    const ask = async (method) => (await window.rheocyte.answer('/api/items/0/moduli', { method, ...(method === 'POST' ? { body: '{}' } : {}) })).json();
    let found = await ask('POST');
    for (; found.state === 'running'; found = await ask('GET')) await new Promise((next) => setTimeout(next, 50));
    return found;
  });
  if (state !== 'ready') throw new Error(error);
  const clock = (performance.now() - start) / 1000, ours = (await taken(inFile)) - before;
  const timed = 'TIMEFORMAT="%U %S"; time "$0" extract "$1" -o "$2" >/dev/null 2>&1';
  const { stderr } = await promisify(execFile)('bash', ['-c', timed, program, recording, join(tmpdir(), 'rheocyte-bench')]);
  const theirs = stderr.trim().split(/\s+/).map(Number).reduce((sum, one) => sum + one, 0);
  console.log(`moduli: ${clock.toFixed(2)} s; processor time ${ours.toFixed(2)} s, native ${theirs.toFixed(2)} s; ${lines[0]}`);
}
if (process.env.RECORDING) await moduli(process.env.RECORDING);
const memory = /VmHWM:\s*(\d+)/.exec(await readFile(`/proc/${inFile}/status`, 'utf8'))[1];
console.log(`peak memory of the page's process: ${(memory / 1024).toFixed(0)} MB`);
await native.context().close();
await target.stop();
await page.context().browser().close();
