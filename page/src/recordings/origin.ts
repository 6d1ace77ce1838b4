// Where numbers come from, in a sentence: moduli by their tables, temperatures by who states them.
import type { Item } from '../api';
import { numberIn } from '../draw/numbers';
import { isComputed, labelOf, storedModulus, youngModulus } from './features';

/** "HE-3D-26 (6 recordings), LE-2D-26 (1 recording)" */
function counts(names: string[]): string {
  const found = new Map<string, number>();
  for (const name of names) found.set(name, (found.get(name) ?? 0) + 1);
  return [...found].map(([name, count]) => `${name} (${count} recording${count === 1 ? '' : 's'})`).join(', ');
}

/** Whose moduli a recording brings along, as far as it says so. */
function originOfStored({ metadata = {} }: Item): string {
  if ('user:rheocyte emodulus' in metadata) return 'rheocyte';
  const table = metadata['calculation:emodulus lut'];
  return typeof table === 'string' ? `the table ${table}` : 'another program';
}

/**
 * Of a feature of several recordings; `tables` holds the table of those whose moduli were computed here. Empty if there
 * is nothing to say.
 */
export function originOf(feature: string, shown: Item[], tables: Map<number, string>): string {
  const offering = shown.filter((item) => item.features?.includes(feature));
  if (offering.length === 0) return '';
  if (feature === storedModulus)
    return `Stored in the recordings, not computed here: from ${counts(offering.map(originOfStored))}. rheocyte's own are “${labelOf(youngModulus)}”.`;
  if (!isComputed(feature)) return '';
  const own = offering.flatMap((item) => tables.get(item.item) ?? []);
  const differ = new Set(own).size > 1 ? ' Differences between tables are not differences between cells.' : '';
  return own.length > 0 ? `Computed here with the table ${counts(own)}.${differ}` : '';
}

const recordsTemperature = ({ conditions, features }: Item) =>
  typeof conditions?.temperature_C === 'number' || features?.includes('temp') === true;

/** How many of the recordings lose their own temperature to the one that is typed; empty if none does. */
export function replacedTemperatures(typed: string, all: Item[]): string {
  const replaced = numberIn(typed) === null ? [] : all.filter(recordsTemperature);
  if (replaced.length === 0) return '';
  const [first] = replaced.map(({ conditions }) => conditions?.temperature_C);
  const own = typeof first === 'number' ? ` (${first} °C)` : '';
  const whose = all.length === 1 ? own : ` of ${replaced.length} of ${all.length} recordings`;
  return `Replaces the recorded temperature${whose}; “Temperature if missing” leaves it.`;
}
