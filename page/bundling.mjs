// How esbuild makes scripts of the page's sources, whatever they become part of.
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';

export const here = dirname(fileURLToPath(import.meta.url));

export const bundling = {
  absWorkingDir: here,
  bundle: true,
  target: ['es2022'],
  minify: true,
  jsx: 'automatic',
  jsxImportSource: 'preact',
  legalComments: 'none',
  loader: { '.svg': 'text' },
  logLevel: 'warning',
};
