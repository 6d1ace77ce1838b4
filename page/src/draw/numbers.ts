// Numbers as the page writes them: always as many digits, so that nothing jumps; ticks at round values.

const minus = (text: string) => text.replace('-', '−');

/** A fixed number of significant digits, trailing zeros kept; powers of ten only far from 1. */
export function significant(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return (0).toFixed(digits - 1);
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent < -4 || exponent > 6) return minus(value.toExponential(digits - 1));
  return minus(value.toFixed(Math.max(0, digits - 1 - exponent)));
}

/** "1.860 ± 0.093 ± 0.020": two digits of the greatest error, and all to the same place. */
export function withErrors(value: number, errors: (number | null)[]): string {
  const known = errors.filter((error): error is number => error !== null && error > 0);
  if (known.length === 0) return significant(value, 3);
  const decimals = Math.max(0, 1 - Math.floor(Math.log10(Math.max(...known))));
  return [value, ...known].map((each) => minus(each.toFixed(decimals))).join(' ± ');
}

/** The shortest text of a number that a person set: 3.437, 0.04, 1e-7. */
export function plain(value: number): string {
  if (value !== 0 && (Math.abs(value) < 1e-4 || Math.abs(value) >= 1e7)) {
    return value.toExponential().replace('e+', 'e');
  }
  return String(Number(value.toPrecision(12)));
}

/** The number that a person wrote, with a point or a comma; null if it is none. */
export function numberIn(text: string): number | null {
  const value = Number(text.replace(',', '.'));
  return text.trim() === '' || !Number.isFinite(value) ? null : value;
}

export const rounded = (value: number, digits: number) => Number(value.toPrecision(digits));

/** One, two or five times a power of ten, at most `value`. */
export function roundStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

/** One, two or five times a power of ten, at least `value`. */
function roundStepAbove(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10) * power;
}

/** Round values within [low, high], at most `count` steps. */
export function ticks(low: number, high: number, count = 5): number[] {
  if (!(high > low)) return [low];
  const step = roundStepAbove(((high - low) / count) * (1 - 1e-9));
  const found: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) found.push(k * step);
  return found;
}

/** Ticks with as many decimals as their step needs. */
export function tickLabels(values: number[]): string[] {
  const step = values.length > 1 ? values[1] - values[0] : values[0] || 1;
  const size = Math.max(...values.map(Math.abs), Math.abs(step));
  if (size >= 1e5 || size < 1e-3) return values.map((value) => (value === 0 ? '0' : minus(plain(rounded(value, 4)))));
  const decimals = Math.max(0, -Math.floor(Math.log10(Math.abs(step)) + 1e-9));
  return values.map((value) => minus(value.toFixed(decimals)));
}

const unitSigns: [RegExp, string][] = [
  [/^um(\d?)/, 'µm$1'],
  [/^ul/, 'µl'],
  [/^degC$/, '°C'],
  [/^us$/, 'µs'],
  [/m3/, 'm³'],
  [/m2/, 'm²'],
  [/s\^n/, 'sⁿ'],
  [/\/s$/, '/s'],
];
/** Units as they are printed: um -> µm. */
export const unitText = (unit: string) => unitSigns.reduce((text, [from, to]) => text.replace(from, to), unit);
