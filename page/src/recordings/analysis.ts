// Events within the gates and their statistics: computed when asked for, kept until gates or columns change.
import type { Item } from '../api';
import { column, wantColumns } from './columns';
import { applyGates, featuresOfGates, type Gate } from './gates';
import { describe, type Statistics } from './statistics';

interface Mask {
  gates: Gate[];
  columns: (Float64Array | undefined)[];
  inside: Uint8Array | null;
}

/** Two of each recording, the latest first: numbers follow new gates at once, plots a picture later. */
const masks = new Map<number, Mask[]>();
const same = <T>(a: T[], b: T[]) => a.length === b.length && a.every((value, k) => value === b[k]);

/** Which events of a recording count; undefined while columns are still on their way. */
export function maskOf(item: Item, gates: Gate[]): Uint8Array | null | undefined {
  const features = featuresOfGates(gates);
  wantColumns(item, features);
  const columns = features.map((feature) => column(item.item, feature));
  const offered = new Set(item.features ?? []);
  if (features.some((feature, k) => offered.has(feature) && columns[k] === undefined)) return undefined;
  const known = masks.get(item.item) ?? [];
  const before = known.find((mask) => mask.gates === gates && same(mask.columns, columns));
  if (before) return before.inside;
  const filled = (feature: string) => {
    const values = column(item.item, feature);
    return values && values.length > 0 ? values : undefined;
  };
  const inside = applyGates(gates, item.events ?? 0, filled);
  masks.set(item.item, [{ gates, columns, inside }, ...known.slice(0, 1)]);
  return inside;
}

interface Described {
  inside: Uint8Array | null;
  values: Float64Array;
  statistics: Statistics;
}

const described = new Map<string, Described>();

/** Statistics of a feature over the events within the gates; undefined while columns are on their way or not there. */
export function statisticsOf(item: Item, feature: string, gates: Gate[]): Statistics | undefined {
  wantColumns(item, [feature]);
  const values = column(item.item, feature);
  const inside = maskOf(item, gates);
  if (values === undefined || values.length === 0 || inside === undefined) return undefined;
  const key = `${item.item}/${feature}`;
  const before = described.get(key);
  if (before && before.inside === inside && before.values === values) return before.statistics;
  const statistics = describe(values, inside);
  described.set(key, { inside, values, statistics });
  return statistics;
}

/** How many events lie within the gates. */
export function countWithin(item: Item, gates: Gate[]): number | undefined {
  const inside = maskOf(item, gates);
  if (inside === undefined) return undefined;
  if (inside === null) return item.events ?? 0;
  let count = 0;
  for (let i = 0; i < inside.length; ++i) count += inside[i];
  return count;
}
