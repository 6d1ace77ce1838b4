// From a slider's movement to the new contour on the screen, over 200 moves: median and 95 %, in the browser's own clock.
// Once as a hand drags it (3 % of Young's modulus a move, to and fro), once in jumps of 17 to 28 %, which the solver mostly
// begins from the sphere.
//     RHEOCYTE=build/rheocyte npm run bench
//     PAGE=build/rheocyte.html node page/bench/slider.mjs      # the view as one file
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { openPage } from '../tests/browser.mjs';
import { openCell, settled } from '../tests/cell_page.mjs';

const moves = Number(process.env.MOVES ?? 200);

/** One movement after the other; each ends in the first frame after its contour was drawn. */
async function measure({ count, drags }) {
  const slider = document.querySelector('[data-key="cell.bulk.young_modulus_kPa"] input[type="range"]');
  const picture = document.querySelector('.channel');
  const frame = () => new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
  const shown = (former) =>
    new Promise((done) => {
      const observer = new MutationObserver(() => {
        if (picture.dataset.shown === former) return;
        observer.disconnect();
        done();
      });
      observer.observe(picture, { attributes: true, attributeFilter: ['data-shown'] });
    });
  const times = [];
  for (let k = 0; k < count; ++k) {
    const drawn = shown(picture.dataset.shown);
    const late = new Promise((_, fail) => setTimeout(() => fail(new Error(`move ${k} was not drawn within 10 s`)), 10000));
    const start = performance.now();
    slider.value = String(drags ? 470 + Math.abs((((k + 1) * 8) % 192) - 96) : 470 + ((k * 37 + 11) % 97));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await Promise.race([drawn, late]);
    await frame();
    times.push(performance.now() - start);
  }
  return times;
}

const openFile = (file) =>
  openPage({ stop: () => undefined }, {}, async (page) => {
    await page.goto(pathToFileURL(resolve(file)).href);
    await settled(page);
  });
const { page, end } = await (process.env.PAGE ? openFile(process.env.PAGE) : openCell());
const session = await page.context().newCDPSession(page);
await session.send('Performance.enable', { timeDomain: 'threadTicks' });
const processorTime = async () => {
  const { metrics } = await session.send('Performance.getMetrics');
  return metrics.find(({ name }) => name === 'TaskDuration').value;
};
for (const drags of [true, false]) {
  await page.evaluate(measure, { count: 10, drags });
  await settled(page);
  const before = await processorTime();
  const times = (await page.evaluate(measure, { count: moves, drags })).sort((a, b) => a - b);
  const own = (await processorTime()) - before;
  const at = (fraction) => times[Math.min(times.length - 1, Math.floor(fraction * times.length))].toFixed(0);
  console.log(`${drags ? 'dragged' : 'jumps'}, slider to contour over ${moves} moves: median ${at(0.5)} ms, 95 % ${at(0.95)} ms, greatest ${at(1)} ms`);
  console.log(`    the page's own work: ${((1000 * own) / moves).toFixed(0)} ms of processor time a move`);
}
await end();
process.exit(0);
