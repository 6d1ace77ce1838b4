// From a slider's movement to the new contour on the screen, over 200 moves: median and 95 %, in the browser's own clock.
//     RHEOCYTE=build/rheocyte npm run bench
import { openCell, settled } from '../tests/cell_page.mjs';

const moves = 200;

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
    const start = performance.now();
    slider.value = String(500 + Math.round(120 * Math.sin(0.13 * k)));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await drawn;
    await frame();
    times.push(performance.now() - start);
  }
  return times;
}

const { page, end } = await openCell();
await page.evaluate(measure, 10);
await settled(page);
const times = (await page.evaluate(measure, moves)).sort((a, b) => a - b);
const at = (share) => times[Math.min(times.length - 1, Math.floor(share * times.length))].toFixed(0);
console.log(`slider to contour over ${moves} moves: median ${at(0.5)} ms, 95 % ${at(0.95)} ms, greatest ${at(1)} ms`);
await end();
process.exit(0);
