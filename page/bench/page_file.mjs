// build/rheocyte.html on this machine: time until it answers, a slider's median, the first answer in the square channel,
// the moduli of a recording, and the memory of the program.
//     build/rheocyte synth examples/recordings/virtual-cells.toml --set recording.cells=20000 -o cells.rtdc
//     RECORDING=cells.rtdc node page/bench/page_file.mjs
import { fileURLToPath, pathToFileURL } from 'node:url';
import { openWindow } from '../tests/browser.mjs';

const file = fileURLToPath(new URL('../../build/rheocyte.html', import.meta.url));
const page = await openWindow();
const begin = performance.now();
await page.goto(pathToFileURL(file).href);
await page.waitForFunction(() => window.rheocyte);
await page.evaluate(() => window.rheocyte.answer('/api/health', {}).then((answer) => answer.text()));
console.log(`answers after ${((performance.now() - begin) / 1000).toFixed(2)} s`);

/** Seconds of states of a cell whose modulus changes in small steps. */
const states = (section, accuracy, count) =>
  page.evaluate(async ([form, error, steps]) => {
    const times = [];
    for (let k = 0; k < steps; ++k) {
      const cell = { radius_um: 7.66, bulk: { law: 'neo-hookean', young_modulus_kPa: 3.4 + 0.03 * k } };
      const body = JSON.stringify({ channel: { section: form, width_um: 20 }, flow: { rate_ul_per_s: 0.04, viscosity_mPas: 15 }, cell });
      const start = performance.now();
      const answer = await window.rheocyte.answer(`/api/state?stream=bench&accuracy=${error}`, { method: 'POST', body });
      await answer.text();
      if (!answer.ok) throw new Error(`status ${answer.status}`);
      times.push((performance.now() - start) / 1000);
    }
    return times;
  }, [section, accuracy, count]);
const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

const [first, ...others] = await states('tube', 1e-3, 41);
console.log(`tube, 1e-3: first ${first.toFixed(2)} s, then ${(1000 * median(others)).toFixed(0)} ms`);
console.log(`tube, 1e-4: ${(1000 * median((await states('tube', 1e-4, 11)).slice(1))).toFixed(0)} ms`);
console.log(`square, 3e-2: first ${(await states('square', 3e-2, 1))[0].toFixed(2)} s`);

if (process.env.RECORDING) {
  await page.getByRole('button', { name: 'Recordings', exact: true }).click();
  await page.locator('.open-files input').setInputFiles(process.env.RECORDING);
  await page.locator('.recording .numbers').waitFor();
  const start = performance.now();
  const state = await page.evaluate(async () => (await window.rheocyte.answer('/api/items/0/moduli', { method: 'POST', body: '{}' })).json());
  console.log(`moduli: ${((performance.now() - start) / 1000).toFixed(2)} s; ${state.lines[0]}`);
}
await page.context().browser().close();
