// Typesets formulas: typeset.mjs KATEX, the folder of the package. Reads lines of JSON {tex, display} and answers each with a
// line {html} or {error}.
import { createRequire } from 'node:module';
import path from 'node:path';
import readline from 'node:readline';

const katex = createRequire(import.meta.url)(path.resolve(process.argv[2]));

for await (const line of readline.createInterface({ input: process.stdin })) {
  const { tex, display } = JSON.parse(line);
  let answer;
  try {
    answer = { html: katex.renderToString(tex, { displayMode: display, strict: 'ignore' }) };
  } catch (error) {
    answer = { error: error.message };
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
}
