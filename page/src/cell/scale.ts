// Sliders: which span of a key's range they cover and how places on them become numbers.
import type { Case, KeyDescription } from '../api';
import { rounded, roundStep } from '../draw/numbers';

/** Places of a slider are whole numbers from 0 to this. */
export const steps = 1000;

export interface SliderScale {
  low: number;
  high: number;
  kind: 'linear' | 'log' | 'log-from-zero';
}

const boltzmann_mN_um = 4.116e-12; // k_B T at 25 degrees C as mN/m x um^2
const tubeRadius = (values: Case) =>
  Number(values['channel.radius_um'] ?? 0.547 * Number(values['channel.width_um'] ?? 20));

/** Size of a quantity for this cell that may be zero, by its unit: modulus, modulus x radius, modulus x radius^3. */
function naturalSize(key: KeyDescription, values: Case): number | null {
  const radius = Number(values['cell.radius_um'] ?? 7);
  const modulus = Number(values['cell.bulk.young_modulus_kPa'] ?? 0);
  const tension = Math.max(modulus * radius, Number(values['cell.cortex.modulus_mN_per_m'] ?? 0)) || 30;
  if (key.unit === 'Pa') return (1000 * tension) / radius;
  if (key.unit === 'mN/m') return tension;
  if (key.unit === 'kBT') return (tension * radius * radius) / (100 * boltzmann_mN_um * 1e6);
  return null;
}

function fromZero(key: KeyDescription, values: Case, anchor: number): SliderScale {
  const greatest = key.greatest ?? 1;
  const size = naturalSize(key, values);
  if (size !== null) {
    const high = Math.min(greatest, roundStep(Math.max(size, 3 * anchor)));
    return { low: high * 1e-4, high, kind: 'log-from-zero' };
  }
  const usual = Math.max(anchor, Number(key.default ?? 0), Math.min(greatest, 1));
  return { low: 0, high: Math.min(greatest, greatest <= 10 ? greatest : 2 * usual), kind: 'linear' };
}

/** The whole declared range where it is short; around the anchor where it spans decades. */
export function sliderScale(key: KeyDescription, values: Case, anchor: number): SliderScale {
  const { least = 0, greatest = 1 } = key;
  if (key.name === 'cell.radius_um') {
    const wall = tubeRadius(values);
    return { low: rounded(0.2 * wall, 3), high: rounded(0.965 * wall, 3), kind: 'linear' };
  }
  if (least <= 0) return fromZero(key, values, anchor);
  if (greatest / least <= 30) return { low: least, high: greatest, kind: 'linear' };
  return { low: Math.max(least, anchor / 8), high: Math.min(greatest, anchor * 8), kind: 'log' };
}

export function placeOf(scale: SliderScale, value: number): number {
  const { low, high, kind } = scale;
  if (kind === 'linear') return Math.round((steps * (value - low)) / (high - low));
  if (value <= 0) return 0;
  const fraction = Math.log(value / low) / Math.log(high / low);
  return Math.round(Math.max(kind === 'log' ? 0 : 1, Math.min(steps, steps * fraction)));
}

export function valueOf(scale: SliderScale, place: number, whole = false): number {
  const { low, high, kind } = scale;
  if (kind === 'log-from-zero' && place <= 0) return 0;
  const fraction = place / steps;
  const value = kind === 'linear' ? low + fraction * (high - low) : low * (high / low) ** fraction;
  return whole ? Math.round(value) : rounded(value, 4);
}

/** Whether the slider stands so near an end that it should be centred anew. */
export const isAtEnd = (scale: SliderScale, place: number) =>
  scale.kind === 'log' && (place < 0.04 * steps || place > 0.96 * steps);
