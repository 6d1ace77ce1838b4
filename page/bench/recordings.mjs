// A recording of a million events in the browser: time to its first plot, frames of moving and stretching, a gate's
// statistics. Against the mock, or the program with the recording that RECORDING names:
//     RHEOCYTE=build/rheocyte RECORDING=million.rtdc node bench/recordings.mjs
import { resetRecordings } from '../mock/recording_routes.mjs';
import { openBrowser } from '../tests/browser.mjs';
import { drawn } from '../tests/recordings_page.mjs';
import { program, startTarget } from '../tests/target.mjs';

const events = Number(process.env.EVENTS ?? 1e6);
const name = program ? process.env.RECORDING.split('/').pop() : 'treated_1.rtdc';

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

const summary = (times) => {
  const sorted = [...times].sort((a, b) => a - b);
  const at = (share) => sorted[Math.floor(share * (times.length - 1))].toFixed(0);
  return `median ${at(0.5)} ms, 95 % ${at(0.95)} ms`;
};

const target = await startTarget(program ? [process.env.RECORDING] : []);
if (!program) resetRecordings(events);
const { context, close } = await openBrowser({ viewport: { width: 1440, height: 900 } });
const page = context.pages()[0] ?? (await context.newPage());
await page.goto(target.address);
await page.getByRole('button', { name: 'Recordings', exact: true }).click();
const title = page.getByRole('button', { name, exact: true });
await title.waitFor();
if (!program) {
  await drawn(page);
  await page.evaluate((wanted) => {
    const canvas = document.querySelector('[data-plot="1"] canvas');
    window.firstPlot = new Promise((done) => {
      const start = performance.now();
      const look = () => (Number(canvas.dataset.events) > wanted / 2 ? done(performance.now() - start) : setTimeout(look));
      document.querySelectorAll('.recording-name')[1].click();
      look();
    });
  }, events);
  console.log(`first plot after the choice of the recording: ${(await page.evaluate(() => window.firstPlot)).toFixed(0)} ms`);
} else {
  await drawn(page);
  console.log(`first plot after the page was asked for: ${(await page.evaluate(() => performance.now())).toFixed(0)} ms`);
}
await page.evaluate(frames, 5);
const { pan, zoom, size } = await page.evaluate(frames, 60);
console.log(`${size} pixels; pan: ${summary(pan)}; zoom: ${summary(zoom)}`);
await page.getByRole('tab', { name: /^Gates/ }).click();
await page.getByLabel('Limit').selectOption('area_um');
const gates = [];
for (let k = 0; k < 15; ++k) gates.push(await page.evaluate(gate, 40 + 2 * k));
console.log(`a gate's counts on the screen: ${summary(gates.map(({ time }) => time))}; last: ${gates.at(-1).says}`);
await close();
await target.stop();
process.exit(0);
