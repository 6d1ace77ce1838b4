// A large recording in the browser: time to its first plot, frames of moving and stretching, the next event, a gate's
// counts and statistics.
//     build/rheocyte synth examples/recordings/virtual-cells.toml --set recording.cells=1000000 -o million.rtdc
//     RECORDING=million.rtdc node page/bench/recordings.mjs
import { openWindow } from '../tests/browser.mjs';
import { computeModuli, drawn } from '../tests/recordings_page.mjs';
import { startTarget } from '../tests/target.mjs';

/** Moves the plot by the wheel and the arrow keys, one change a frame; seconds of each frame. */
async function frames(count) {
  const plot = document.querySelector('[data-plot="1"]');
  const canvas = plot.querySelector('canvas');
  const box = plot.getBoundingClientRect();
  const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const pan = (k) => plot.dispatchEvent(new KeyboardEvent('keydown', { key: k % 20 < 10 ? 'ArrowRight' : 'ArrowLeft', bubbles: true }));
  const zoom = (k) =>
    plot.dispatchEvent(
      new WheelEvent('wheel', { deltaY: k % 20 < 10 ? -60 : 60, clientX: box.x + box.width / 2, clientY: box.y + box.height / 2, bubbles: true, cancelable: true }),
    );
  const times = { pan: [], zoom: [] };
  for (const [kind, change] of [['pan', pan], ['zoom', zoom]])
    for (let k = 0; k < count; ++k) {
      const start = performance.now();
      change(k);
      await frame();
      times[kind].push(performance.now() - start);
    }
  return { ...times, size: `${canvas.width} x ${canvas.height}` };
}

/** Changes a limit and waits until the table of statistics has followed: milliseconds. */
async function gate(value) {
  const input = document.querySelector('.gate input.number');
  const count = () => document.querySelector(`.recording.focused .numbers`).textContent;
  const before = count();
  const start = performance.now();
  input.value = String(value);
  input.dispatchEvent(new Event('change', { bubbles: true }));
  while (count() === before) await new Promise((done) => setTimeout(done));
  return { time: performance.now() - start, says: count() };
}

/** From a key to the next event until what is known of it is shown: milliseconds. */
async function nextEvent() {
  const shown = () => document.querySelector('.event-features')?.textContent;
  const before = shown();
  const start = performance.now();
  document.querySelector('[data-plot="1"]').dispatchEvent(new KeyboardEvent('keydown', { key: 'n', bubbles: true }));
  while (!shown() || shown() === before) await new Promise((done) => setTimeout(done));
  return performance.now() - start;
}

/** From a changed limit until the statistics of the moduli have followed on the screen: milliseconds. */
async function statistics(value) {
  const input = document.querySelector('[aria-label="Minimum Area"]');
  input.value = String(value);
  const row = () => document.querySelector('.statistics tr[data-item="0"]')?.textContent ?? '';
  const start = performance.now();
  input.dispatchEvent(new Event('change', { bubbles: true }));
  [...document.querySelectorAll('[role=tab]')].find((tab) => tab.textContent.startsWith('Statistics')).click();
  while (!/\d\.\d/.test(row()) || row() === window.rowBefore) {
    if (performance.now() - start > 5000) throw new Error('the statistics did not follow within 5 s');
    await new Promise((done) => setTimeout(done));
  }
  window.rowBefore = row();
  await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  return performance.now() - start;
}

const summary = (times) => {
  const sorted = [...times].sort((a, b) => a - b);
  const at = (fraction) => sorted[Math.floor(fraction * (times.length - 1))].toFixed(0);
  return `median ${at(0.5)} ms, 95 % ${at(0.95)} ms`;
};

const target = await startTarget([process.env.RECORDING]);
const page = await openWindow({ viewport: { width: 1440, height: 900 } });
await page.goto(target.address);
await page.getByRole('button', { name: 'Recordings', exact: true }).click();
await drawn(page);
console.log(`first plot after the page was asked for: ${(await page.evaluate(() => performance.now())).toFixed(0)} ms`);
await page.evaluate(frames, 5);
const { pan, zoom, size } = await page.evaluate(frames, 60);
console.log(`${size} pixels; pan: ${summary(pan)}; zoom: ${summary(zoom)}`);
await page.getByRole('tab', { name: /^Gates/ }).click();
await page.getByLabel('Limit').selectOption('area_um');
const gates = [];
for (let k = 0; k < 15; ++k) gates.push(await page.evaluate(gate, 90 + k));
console.log(`a gate's counts on the screen: ${summary(gates.map(({ time }) => time))}; last: ${gates.at(-1).says}`);
const events_ms = [];
for (let k = 0; k < 15; ++k) events_ms.push(await page.evaluate(nextEvent));
console.log(`the next event with all that is known of it: ${summary(events_ms)}`);
const start = performance.now();
await page.getByRole('tab', { name: 'Statistics' }).click();
await computeModuli(page);
console.log(`moduli: ${(performance.now() - start).toFixed(0)} ms`);
const times = [];
for (let k = 0; k < 15; ++k) {
  await page.getByRole('tab', { name: /^Gates/ }).click();
  await page.getByLabel('Minimum Area').waitFor();
  times.push(await page.evaluate(statistics, 90.5 + k));
}
console.log(`a gate's statistics of the moduli on the screen: ${summary(times)}`);
await target.stop();
process.exit(0);
