// The page with the program in it as one file: single.mjs ENGINE TABLES OUT. ENGINE is the folder with engine.js and
// engine.wasm, TABLES that of the tables. All parts are packed but the script that unpacks them.
import { build } from 'esbuild';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { bundling, here } from './bundling.mjs';

const [engine, tables, out] = process.argv.slice(2);

const packed = (content) => gzipSync(content, { level: 9 }).toString('base64');
/** Numbers of four bytes, mostly: their first bytes, their second ones and so on stand together, and are packed by a fifth more. */
const byPlanes = (bytes) => Buffer.concat([0, 1, 2, 3].map((plane) => bytes.filter((_, k) => k % 4 === plane)));
/** Tables that nothing in the page reads: cells on their way are no part of the view. */
const isLeftOut = (name) => name.startsWith('dynamic_');

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
const starter = await bundled('src/alone/starter.ts', 'esm');
const names = (await readdir(tables)).filter((name) => /\.cbor$/.test(name) && !isLeftOut(name)).sort();
const packedTables = await Promise.all(names.map(async (name) => [name, packed(byPlanes(await readFile(join(tables, name))))]));
const loader = await readFile(join(engine, 'engine.js'), 'utf8');
const scripts = [
  `<script id="engine-wasm" type="text/plain">${packed(await readFile(join(engine, 'engine.wasm')))}</script>`,
  `<script id="engine-tables" type="application/json">${JSON.stringify(packedTables)}</script>`,
  `<script id="engine-worker" type="text/plain">${packed(`${loader}\n${worker.script}`)}</script>`,
  `<script id="page-script" type="text/plain">${packed(page.script)}</script>`,
  `<script type="module">${starter.script}</script>`,
];
const html = (await readFile(join(here, 'src/index.html'), 'utf8'))
  .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${page.style}</style>`)
  .replace(/ *<script type="module"[^>]*><\/script>\n/, '')
  .replace('<div id="page"></div>', '<p id="starting">rheocyte is starting …</p><div id="page"></div>')
  .replace('</body>', () => `${scripts.join('\n')}\n</body>`);
await writeFile(out, html);
console.log(`${(html.length / 1e6).toFixed(1)} MB  ${out}`);
