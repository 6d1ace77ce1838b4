// The keys of a case as the program declares them, read from the generated case reference.
import { readFileSync } from 'node:fs';

const reference = new URL('../../docs/case-reference.md', import.meta.url);

function conditionOf(text) {
  const found = /only for ([\w.]+) (=|other than) "([\w-]+)"/.exec(text);
  return found ? { key: found[1], option: found[3], negated: found[2] !== '=' } : null;
}

function rangeOf(text) {
  const options = [...text.matchAll(/"([\w-]+)"/g)].map((match) => match[1]);
  if (options.length) return { kind: 'choice', unit: '', options };
  const found = /(?:a list of numbers )?(\S+) \.\. ([^\s,]+)(?:,? (.+))?$/.exec(text);
  const whole = found[3] === 'a whole number';
  const kind = text.startsWith('a list') ? 'list' : 'number';
  return { kind, unit: whole ? '' : (found[3] ?? ''), least: Number(found[1]), greatest: Number(found[2]), whole };
}

function defaultOf(text, kind) {
  const first = text.split(',')[0];
  if (/^(required|not given)/.test(first)) return null;
  return kind === 'choice' ? first.replace(/"/g, '') : Number(first);
}

function keyOf(section, line) {
  const [, name, sentence, range, rest] = /^\| `(\w+)` \| (.*) \| (.*) \| (.*) \|$/.exec(line);
  const described = rangeOf(range);
  const other = /^(?:required|not given|\S+), or ([\w.]+)/.exec(rest);
  return {
    name: `${section}.${name}`,
    section,
    sentence,
    ...described,
    default: defaultOf(rest, described.kind),
    required: rest.startsWith('required'),
    only_for: conditionOf(rest),
    alternative: other ? other[1] : null,
  };
}

export function readKeys() {
  const keys = [];
  let section = '';
  for (const line of readFileSync(reference, 'utf8').split('\n')) {
    const head = /^## `\[([\w.]+)\]`/.exec(line);
    if (head) section = head[1];
    else if (section && line.startsWith('| `')) keys.push(keyOf(section, line));
  }
  return keys;
}
