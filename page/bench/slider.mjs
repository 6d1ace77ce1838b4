// From a slider's movement to the new contour on the screen, over 200 moves: median and 95 %, in the browser's own clock.
//     RHEOCYTE=build/rheocyte npm run bench
import { openCell, settled } from '../tests/cell_page.mjs';

const moves = Number(process.env.MOVES ?? 200);

/** One movement after the other; each ends in the first frame after its contour was drawn. */
async function measure(count) {
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
    slider.value = String(470 + ((k * 37 + 11) % 97));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await Promise.race([drawn, late]);
    await frame();
    times.push(performance.now() - start);
  }
  return times;
}

const { page, end } = await openCell();
const session = await page.context().newCDPSession(page);
await session.send('Performance.enable', { timeDomain: 'threadTicks' });
const processorTime = async () => {
  const { metrics } = await session.send('Performance.getMetrics');
  return metrics.find(({ name }) => name === 'TaskDuration').value;
};
await page.evaluate(measure, 10);
await settled(page);
const before = await processorTime();
const times = (await page.evaluate(measure, moves)).sort((a, b) => a - b);
const own = (await processorTime()) - before;
const at = (share) => times[Math.min(times.length - 1, Math.floor(share * times.length))].toFixed(0);
console.log(`the page's own work: ${((1000 * own) / moves).toFixed(0)} ms of processor time a move`);
console.log(`slider to contour over ${moves} moves: median ${at(0.5)} ms, 95 % ${at(0.95)} ms, greatest ${at(1)} ms`);
await end();
process.exit(0);
