// What the picture shows: the field in the liquid, the field in the cell, and the lines over them.
import type { ColorMap } from '../draw/colormap';
import { cellMap, liquidMap } from '../draw/colormap';
import { fieldRange, scalarField, type Fields } from '../draw/fields';
import type { Paint } from '../draw/raster';
import { roundStep } from '../draw/numbers';
import { keepInSession, sessionChanged } from '../shell/session';
import { store } from '../shell/store';

export interface FieldChoice {
  name: string;
  title: string;
  unit: string;
  factor: number;
}

export const liquidFields: FieldChoice[] = [
  { name: 'speed_m_per_s', title: 'Speed relative to the cell', unit: 'm/s', factor: 1 },
  { name: 'pressure_Pa', title: 'Pressure', unit: 'Pa', factor: 1 },
  { name: 'shear_rate_per_s', title: 'Shear rate', unit: '1/ms', factor: 1e-3 },
];
export const cellFields: FieldChoice[] = [
  { name: 'stress_Pa', title: 'Elastic stress', unit: 'kPa', factor: 1e-3 },
  { name: 'stretch', title: 'Stretch', unit: '', factor: 1 },
  { name: 'displacement_um', title: 'Displacement', unit: 'µm', factor: 1 },
];

export interface Looks {
  liquid: string;
  cell: string;
  streamlines: boolean;
  undeformed: boolean;
  hull: boolean;
  tension: boolean;
  solid: boolean;
}

export const looks = store<Looks>({
  liquid: 'speed_m_per_s',
  cell: 'stress_Pa',
  streamlines: true,
  undeformed: true,
  hull: false,
  tension: true,
  solid: false,
});

export function changeLooks(change: Partial<Looks>): void {
  looks.update((now) => ({ ...now, ...change }));
  sessionChanged();
}

keepInSession('looks', { save: () => looks.get(), restore: (kept) => looks.update((now) => ({ ...now, ...(kept as Looks) })) });

export interface Legend {
  field: FieldChoice;
  map: ColorMap;
  low: number;
  high: number;
}

// Ranges stay while values move within them: colours and ticks then do not flicker under a moving slider.
const held = new Map<string, { low: number; high: number }>();

function roundRange(low: number, high: number): { low: number; high: number } {
  if (low >= 0 && low < 0.5 * high) {
    const step = roundStep(high / 4);
    return { low: 0, high: Math.ceil(high / step - 1e-9) * step };
  }
  const step = roundStep(Math.max((high - low) / 4, 1e-9));
  return { low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step };
}

function heldRange(name: string, low: number, high: number): { low: number; high: number } {
  const now = held.get(name);
  const fits = now && low >= now.low && high <= now.high && high - low > 0.4 * (now.high - now.low);
  if (fits) return now;
  const next = roundRange(low, high);
  held.set(name, next);
  return next;
}

function legendOf(fields: Fields, choice: FieldChoice | undefined, region: number): [Legend, Paint] | null {
  const values = choice && scalarField(fields, choice.name);
  if (!choice || !values) return null;
  const range = heldRange(choice.name, ...fieldRange(fields, values, region));
  const map = region === 0 ? liquidMap : cellMap;
  return [{ field: choice, map, ...range }, { values, map, ...range }];
}

/** Legends and paints of liquid and cell; null where a field is not there, as in the interior of a shell. */
export function paintsOf(fields: Fields, now: Looks): { legends: (Legend | null)[]; paints: (Paint | null)[] } {
  const both = [
    legendOf(fields, liquidFields.find(({ name }) => name === now.liquid), 0),
    legendOf(fields, cellFields.find(({ name }) => name === now.cell), 1),
  ];
  return { legends: both.map((one) => one && one[0]), paints: both.map((one) => one && one[1]) };
}
