// The browser under the tests: Debian's chromium, headless and without traffic of its own; one for a file of tests.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { noProgram, patience_ms } from './target.mjs';

const chromiumFile = process.env.CHROMIUM ?? '/usr/bin/chromium';
/** Why tests in the browser are skipped, or false. */
export const skip = noProgram || (existsSync(chromiumFile) ? false : `there is no ${chromiumFile}; CHROMIUM can name another one`);

const flags = [
  '--headless',
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

let browser = null;
const isTest = process.argv[1].endsWith('.test.mjs'); // bench/ ends by itself, and prints nothing but its numbers
if (isTest) (await import('node:test')).after(async () => (await browser)?.close());

/** A window with nothing kept from others, in the one browser of a file of tests. */
export async function openWindow(options = {}) {
  browser ??= chromium.launch({ executablePath: chromiumFile, args: flags, timeout: patience_ms });
  const context = await (await browser).newContext({ viewport: { width: 1280, height: 800 }, ...options });
  context.setDefaultTimeout(patience_ms);
  return context.newPage();
}

/** Opens a window on what a test asks (of target.mjs); `end` closes both, and so does a failure of `prepare`. */
export async function openPage(target, options, prepare) {
  let page = null;
  const end = async () => {
    try {
      await page?.unrouteAll({ behavior: 'ignoreErrors' }); // what is under way answers nobody any more
      await page?.context().close();
    } finally {
      await target.stop();
    }
  };
  try {
    page = await openWindow(options);
    const failures = [];
    page.on('pageerror', (failure) => failures.push(failure.message));
    page.on('console', (message) => /Content Security Policy/.test(message.text()) && failures.push(message.text()));
    await prepare(page);
    return { page, target, failures, end };
  } catch (failure) {
    await end();
    throw failure;
  }
}
