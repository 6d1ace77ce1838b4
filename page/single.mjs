// The page with the program in it as one file: single.mjs ENGINE TABLES OUT. ENGINE is the folder with engine.js and
// engine.wasm, TABLES that of the tables. All parts are packed but the script that unpacks them.
import { build } from 'esbuild';
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { bundling, here } from './bundling.mjs';

const [engine, tables, out] = process.argv.slice(2);

/** Those that neither end a script nor a text of JSON. */
const letters = Array.from({ length: 94 }, (_, k) => String.fromCharCode(33 + k)).filter((letter) => !'<"\\'.includes(letter));

/** 13 bits as two of 91 letters: a tenth shorter than base64. src/alone/unpacked.ts reads it. */
function inLetters(bytes) {
  const text = [];
  let held = 0, bits = 0;
  for (const byte of bytes) {
    held |= byte << bits;
    bits += 8;
    if (bits < 13) continue;
    const value = held & 8191;
    text.push(letters[value % 91], letters[Math.floor(value / 91)]);
    held >>= 13;
    bits -= 13;
  }
  if (bits > 0) text.push(letters[held % 91]);
  if (bits > 6) text.push(letters[Math.floor(held / 91)]);
  return text.join('');
}

const packed = (content) => inLetters(gzipSync(content, { level: 9 }));
/** Of numbers the first bytes, the second ones and so on stand together: so they are packed better. */
const byPlanes = (bytes, size) => Buffer.concat(Array.from({ length: size }, (_, plane) => bytes.filter((_, k) => k % size === plane)));
/** Bytes of most numbers (docs/tables.md, "The grid"). */
const numberSize = (name) => (name.startsWith('grid_') ? 4 : 8);
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
const packedTables = await Promise.all(
  names.map(async (name) => {
    const size = numberSize(name);
    return { name, size, content: packed(byPlanes(await readFile(join(tables, name)), size)) };
  }),
);
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
