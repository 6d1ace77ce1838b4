// The built site finds what it holds, and shows it without asking anybody: SITE is its folder, RHEOCYTE the program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import vm from 'node:vm';

const top = fileURLToPath(new URL('../..', import.meta.url));
const site = process.env.SITE ?? path.join(top, 'build/site');
const program = process.env.RHEOCYTE ?? path.join(top, 'build/rheocyte');
const help = (...words) => execFileSync(program, words, { encoding: 'utf8' });

const index = () => JSON.parse(/^Search\.setIndex\((.*)\)$/s.exec(readFileSync(path.join(site, 'searchindex.js'), 'utf8').trim())[1]);

/** The site's own search, as its page runs it: names of the pages that it finds for a text, the best first. */
function makeSearch() {
  const context = vm.createContext({ _ready: () => {}, _: (text) => text, document: { documentElement: {}, getElementById: () => null } });
  context.window = context;
  context.SPHINX_HIGHLIGHT_ENABLED = false;
  for (const file of ['language_data.js', 'searchtools.js']) {
    vm.runInContext(readFileSync(path.join(site, '_static', file), 'utf8'), context, { filename: file });
  }
  context.index = index();
  vm.runInContext('Search._index = index', context);
  return (text) => {
    context.text = text;
    return vm.runInContext('Search._performSearch(...Search._parseQuery(text))', context).map(([page]) => page).reverse();
  };
}

/** Names of the keys that `rheocyte help TOPIC` explains: lines that begin with two blanks below a heading. */
const keysOf = (topic) => [...help('help', topic).matchAll(/^ {2}([A-Za-z_][\w.]*)(?= )/gm)].map((match) => match[1]);

test('every key, number and column that help explains is found on the page of its reference', () => {
  const search = makeSearch();
  for (const topic of ['case', 'table', 'dynamic', 'synth', 'result']) {
    const keys = keysOf(topic);
    assert.ok(keys.length > 10, `${topic}: ${keys}`);
    const missed = keys.filter((key) => !search(key).includes(`docs/${topic}-reference`));
    assert.deepEqual(missed, [], topic);
  }
});

test('every command is found on its page, and so is every option', () => {
  const search = makeSearch();
  const commands = [...help('--help').split('Subcommands:')[1].matchAll(/^ {2}(\S+)/gm)].map((match) => match[1]);
  assert.ok(commands.includes('extract') && commands.includes('dclab-plugin'), commands.join());
  for (const command of commands) {
    const page = `commands/${command}`;
    assert.equal(search(`rheocyte ${command}`)[0], page);
    const options = [...help(command, '--help').matchAll(/^ {2}(?:-\w,)?(--[\w-]+)/gm)].map((match) => match[1]);
    assert.deepEqual(options.filter((option) => !search(option).includes(page)), [], command);
  }
});

test('every public name of the Python package is found on a page of its functions', () => {
  const search = makeSearch();
  const stub = readFileSync(path.join(top, 'python/rheocyte/__init__.pyi'), 'utf8');
  const names = [...stub.matchAll(/ import \w+ as (\w+)/g)].map((match) => match[1]);
  assert.ok(names.includes('extract') && names.includes('Table'), names.join());
  assert.deepEqual(names.filter((name) => !search(`rheocyte.${name}`)[0]?.startsWith('python/')), []);
});

const playwright = path.join(top, 'page/node_modules/playwright-core/index.mjs');
const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const noBrowser = [playwright, chromium].find((file) => !existsSync(file));

test('pages opened from the folder load nothing from elsewhere, show their equations, and search', { skip: noBrowser && `there is no ${noBrowser}` }, async () => {
  const browser = await (await import(pathToFileURL(playwright))).chromium.launch({ executablePath: chromium, args: ['--no-sandbox', '--disable-gpu'] });
  try {
    const page = await browser.newPage({ viewport: { width: 820, height: 1180 } });
    const foreign = [], failures = [];
    page.on('request', (request) => request.url().startsWith('file:') || request.url().startsWith('data:') || foreign.push(request.url()));
    page.on('requestfailed', (request) => request.resourceType() !== 'fetch' && failures.push(request.url()));
    page.on('pageerror', (error) => failures.push(error.message));
    const wide = [];
    for (const name of [...index().docnames, 'search', 'genindex']) {
      await page.goto(pathToFileURL(path.join(site, `${name}.html`)).href, { waitUntil: 'domcontentloaded' });
      const [width, room] = await page.evaluate(async () => {
        await document.fonts.ready;  // leaving the page would end their loading, which is no failure
        return [document.documentElement.scrollWidth, document.documentElement.clientWidth];
      });
      if (width > room) wide.push(`${name}: ${width} of ${room}`);
    }
    assert.deepEqual(wide, [], 'wider than a tablet');

    await page.goto(pathToFileURL(path.join(site, 'docs/theory.html')).href);
    assert.ok(await page.locator('.equation .katex').count() > 20);
    const fonts = await page.evaluate(async () => [...await document.fonts.ready].filter((font) => font.status === 'loaded').map((font) => font.family));
    assert.ok(fonts.some((name) => name.includes('KaTeX_Math')), fonts.join());
    assert.ok(await page.locator('#eq-momentum').boundingBox());

    await page.goto(`${pathToFileURL(path.join(site, 'search.html')).href}?q=young_modulus_kPa`);
    await page.locator('#search-results a', { hasText: 'Case reference' }).waitFor();
    assert.deepEqual([foreign, failures], [[], []]);
  } finally {
    await browser.close();
  }
});
