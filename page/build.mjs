// Builds the page into dist: one module, one style sheet, parts that are loaded on demand, each with a compressed copy.
import { build } from 'esbuild';
import { copyFile, mkdir, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';
import { bundling, here } from './bundling.mjs';

const dist = join(here, 'dist');

async function bundle() {
  await build({
    ...bundling,
    entryPoints: { app: 'src/main.tsx' },
    outdir: 'dist',
    splitting: true,
    format: 'esm',
    chunkNames: '[name]-[hash]',
  });
}

async function compress() {
  let total = 0;
  for (const name of (await readdir(dist)).sort()) {
    const bytes = gzipSync(await readFile(join(dist, name)), { level: 9 });
    total += bytes.length;
    await writeFile(join(dist, `${name}.gz`), bytes);
    console.log(`${(bytes.length / 1000).toFixed(1).padStart(8)} kB  ${name}`);
  }
  console.log(`${(total / 1000).toFixed(1).padStart(8)} kB  in all, compressed`);
}

await rm(dist, { recursive: true, force: true });
await mkdir(dist, { recursive: true });
await bundle();
await copyFile(join(here, 'src/index.html'), join(dist, 'index.html'));
await compress();
