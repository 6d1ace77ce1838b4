// The workspace "Cell" as a person uses it, for the tests: its numbers, sliders, and waiting for the answer.
import { openPage } from './browser.mjs';
import { patience_ms, startTarget } from './target.mjs';

/** Opens the workspace and waits for its first state of the wanted accuracy. */
export async function openCell(options = {}, hash = '', items = []) {
  const target = await startTarget(items);
  return openPage(target, options, async (page) => {
    // Without an address of its own the page begins with what the program was given.
    await page.goto(items.length ? target.address : `${target.address}#cell`);
    if (hash) {
      await page.goto(new URL(hash, target.address).href);
      await page.reload();
    }
    await settled(page);
  });
}

/** Nothing is being solved, and a state is shown. */
export async function settled(page) {
  await page.locator('.cell[data-working="idle"] .numbers .lead').waitFor();
}

/** Asks until the answer is yes, or the test's patience ends. */
export async function until(question) {
  for (const end = Date.now() + patience_ms; Date.now() < end; await new Promise((next) => setTimeout(next, 50)))
    if (await question()) return true;
  return false;
}

export async function shownDeformation(page) {
  return Number(await page.locator('[data-measure="Deformation"] .value').textContent());
}

export const slider = (page, key) => page.locator(`[data-key="${key}"] input[type="range"]`);
export const field = (page, key) => page.locator(`[data-key="${key}"] input.number`);

/** Moves a slider to a place (0..1000) and lets it go. */
export async function moveSlider(page, key, place) {
  await slider(page, key).fill(String(place));
  await settled(page);
}

export async function typeNumber(page, key, text) {
  await field(page, key).fill(text);
  await field(page, key).press('Enter');
}
