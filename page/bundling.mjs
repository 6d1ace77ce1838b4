// How esbuild makes scripts of the page's sources, whatever they become part of.
import { readdir } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const here = dirname(fileURLToPath(import.meta.url));

/** `import all from 'every:./folder'`: what its scripts export as default, in the order of their names. */
const every = {
  name: 'every',
  setup(build) {
    build.onResolve({ filter: /^every:/ }, ({ path, resolveDir }) => ({ path: join(resolveDir, path.slice('every:'.length)), namespace: 'every' }));
    build.onLoad({ filter: /./, namespace: 'every' }, async ({ path }) => {
      const names = (await readdir(path)).filter((name) => /\.tsx?$/.test(name)).sort();
      const imports = names.map((name, k) => `import one${k} from './${name}';`);
      return { contents: `${imports.join('\n')}\nexport default [${names.map((_, k) => `one${k}`)}];`, resolveDir: path };
    });
  },
};

export const bundling = {
  absWorkingDir: here,
  bundle: true,
  target: ['es2022'],
  minify: true,
  plugins: [every],
  jsx: 'automatic',
  jsxImportSource: 'preact',
  legalComments: 'none',
  loader: { '.svg': 'text' },
  logLevel: 'warning',
};
