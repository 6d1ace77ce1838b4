// The page with the program in it as one file: single.mjs ENGINE TABLES OUT. ENGINE is the folder with engine.js and
// engine.wasm, TABLES that of the tables.
import { build } from 'esbuild';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { bundling, here } from './bundling.mjs';

const [engine, tables, out] = process.argv.slice(2);

const packed = async (file) => gzipSync(await readFile(file), { level: 9 }).toString('base64');
/** Within a script of the page nothing may end it. */
const within = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

async function bundled(entry, format) {
  const { outputFiles } = await build({
    ...bundling,
    entryPoints: { part: entry },
    outdir: 'none',
    write: false,
    format,
  });
  const ending = (end) => outputFiles.find(({ path }) => path.endsWith(end))?.text ?? '';
  return { script: ending('.js'), style: ending('.css') };
}

const page = await bundled('src/alone/main.ts', 'esm');
const worker = await bundled('src/alone/worker.ts', 'iife');
const names = (await readdir(tables)).filter((name) => /\.cbor$/.test(name)).sort();
const packedTables = await Promise.all(names.map(async (name) => [name, await packed(join(tables, name))]));
const loader = await readFile(join(engine, 'engine.js'), 'utf8');
const scripts = [
  `<script id="engine-wasm" type="text/plain">${await packed(join(engine, 'engine.wasm'))}</script>`,
  `<script id="engine-tables" type="application/json">${JSON.stringify(packedTables)}</script>`,
  `<script id="engine-worker" type="text/plain">${within(`${loader}\n${worker.script}`)}</script>`,
  `<script type="module">${within(page.script)}</script>`,
];
const html = (await readFile(join(here, 'src/index.html'), 'utf8'))
  .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${page.style}</style>`)
  .replace(/ *<script type="module"[^>]*><\/script>\n/, '')
  .replace('<div id="page"></div>', '<p id="starting">rheocyte is starting …</p><div id="page"></div>')
  .replace('</body>', () => `${scripts.join('\n')}\n</body>`);
await writeFile(out, html);
console.log(`${(html.length / 1e6).toFixed(1)} MB  ${out}`);
