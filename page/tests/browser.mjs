// The browser under the tests: Debian's chromium, headless, with an empty profile and no traffic of its own.
import { existsSync } from 'node:fs';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { patience_ms } from './target.mjs';

export const program = process.env.CHROMIUM ?? '/usr/bin/chromium';
/** Why tests in the browser are skipped, or false. */
export const noBrowser = existsSync(program) ? false : `there is no ${program}`;

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

/** Opens a browser; `close` removes its profile as well. */
export async function openBrowser(options = {}, more = []) {
  const profile = await mkdtemp(join(tmpdir(), 'rheocyte-page-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: program,
    args: [...flags, ...more],
    viewport: { width: 1280, height: 800 },
    timeout: patience_ms,
    ...options,
  });
  context.setDefaultTimeout(patience_ms);
  const close = async () => {
    await context.close();
    await rm(profile, { recursive: true, force: true, maxRetries: 20 }); // its processes may still write
  };
  return { context, close };
}

/** Opens a browser on what a test asks (of target.mjs); `end` closes both, and so does a failure of `prepare`. */
export async function openPage(target, options, prepare) {
  let close = async () => {};
  const end = async () => {
    try {
      await close();
    } finally {
      await target.stop();
    }
  };
  try {
    const browser = await openBrowser(options);
    close = browser.close;
    const page = browser.context.pages()[0] ?? (await browser.context.newPage());
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
