// A case by dotted names: to and from the program's sections, the address, and equality.
import type { Case, Sections, Value } from '../api';

export function sectionsOf(values: Case): Sections {
  const top: Sections = {};
  for (const [name, value] of Object.entries(values)) {
    const path = name.split('.');
    const last = path.pop()!;
    let section = top;
    for (const part of path) section = (section[part] ??= {}) as Sections;
    section[last] = value;
  }
  return top;
}

const isSection = (value: Value | Sections): value is Sections => typeof value === 'object' && !Array.isArray(value);

export function caseOf(sections: Sections, prefix = ''): Case {
  const values: Case = {};
  for (const [name, value] of Object.entries(sections)) {
    if (value === null) continue;
    if (isSection(value)) Object.assign(values, caseOf(value, `${prefix}${name}.`));
    else values[prefix + name] = value;
  }
  return values;
}

export const sameCase = (a: Case, b: Case) => textOf(a) === textOf(b);
const textOf = (values: Case) => JSON.stringify(Object.entries(values).sort(([a], [b]) => (a < b ? -1 : 1)));

/** The case as the address holds it: cell.radius_um=7.66&... */
export function queryOf(values: Case): URLSearchParams {
  return new URLSearchParams(Object.entries(values).map(([name, value]) => [name, String(value)]));
}

function valueOf(text: string, sample: 'number' | 'choice' | 'word' | 'list'): Value | null {
  if (sample === 'choice' || sample === 'word') return text;
  const numbers = text.split(',').map(Number);
  if (text.trim() === '' || numbers.some((number) => !Number.isFinite(number))) return null;
  return sample === 'list' ? numbers : numbers[0];
}

/** The case of an address; names that are no keys and values that are none are left out. */
export function caseOfQuery(query: URLSearchParams, kinds: Map<string, 'number' | 'choice' | 'word' | 'list'>): Case {
  const values: Case = {};
  for (const [name, text] of query) {
    const kind = kinds.get(name);
    const value = kind === undefined ? null : valueOf(text, kind);
    if (value !== null) values[name] = value;
  }
  return values;
}

/** The cell of the paper: what the page shows when nothing is asked for. */
export const firstCase: Case = {
  'channel.width_um': 20,
  'flow.rate_ul_per_s': 0.04,
  'flow.viscosity_mPas': 15,
  'cell.radius_um': 7.66,
  'cell.bulk.young_modulus_kPa': 3.437,
};
