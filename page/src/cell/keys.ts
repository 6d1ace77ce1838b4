// What the declared keys of a case mean for its controls: which ones have effect, what they start with, how they are called.
import type { Case, KeyDescription, Value } from '../api';

export type Keys = Map<string, KeyDescription>;

export const keysByName = (keys: KeyDescription[]): Keys => new Map(keys.map((key) => [key.name, key]));

/** The option in force: that of the case, else the default, with the declarations' implied scheme of [time]. */
export function optionOf(keys: Keys, values: Case, name: string): Value | null {
  return values[name] ?? keys.get(name)?.default ?? null;
}

export function hasEffect(keys: Keys, values: Case, key: KeyDescription): boolean {
  const condition = key.only_for;
  if (!condition) return true;
  return (optionOf(keys, values, condition.key) === condition.option) !== condition.negated;
}

// Where a quantity starts that a law needs and no default gives; only the start, any value may follow.
const starts: Record<string, (values: Case) => Value> = {
  'channel.width_um': () => 20,
  'channel.radius_um': (values) => 0.547 * Number(values['channel.width_um'] ?? 20),
  'channel.length_um': () => 300,
  'flow.rate_ul_per_s': () => 0.04,
  'flow.pressure_drop_Pa': () => 35000,
  'flow.viscosity_mPas': () => 15,
  'flow.consistency_Pa_sn': () => 0.179,
  'flow.exponent': () => 0.677,
  'flow.zero_shear_viscosity_mPas': () => 30,
  'flow.relaxation_time_ms': () => 0.1,
  'cell.viscosity_mPas': () => 15,
  'cell.bulk.young_modulus_kPa': () => 3.437,
  'cell.cortex.modulus_mN_per_m': (values) => Number(values['cell.radius_um'] ?? 7) * 4,
  'cell.cortex.tension_ratio': () => 0.1,
  'time.end_us': () => 1000,
};

const startOf = (key: KeyDescription, values: Case): Value => starts[key.name]?.(values) ?? key.least ?? 1;

function isNeeded(keys: Keys, values: Case, key: KeyDescription): boolean {
  if (!key.required || !hasEffect(keys, values, key) || key.name in values) return false;
  const other = key.alternative ? keys.get(key.alternative) : undefined;
  if (!other) return true;
  // Of two alternatives the first declared one is needed, and neither where the other is given or has a default.
  return !(other.name in values) && other.default === null && hasProfile(values) === false && !declaredBefore(keys, other, key);
}

const hasProfile = (values: Case) => 'channel.profile.x_um' in values;

function declaredBefore(keys: Keys, a: KeyDescription, b: KeyDescription): boolean {
  const names = [...keys.keys()];
  return names.indexOf(a.name) < names.indexOf(b.name);
}

/** The case without keys that lost their effect and with all that are needed; `earlier` remembers former values. */
export function completed(keys: Keys, values: Case, earlier: Case = {}): Case {
  const next: Case = {};
  for (const key of keys.values()) {
    if (key.name in values && hasEffect(keys, values, key)) next[key.name] = values[key.name];
  }
  for (const key of keys.values()) {
    if (isNeeded(keys, next, key)) next[key.name] = earlier[key.name] ?? startOf(key, { ...earlier, ...next });
  }
  return next;
}

// What is set together with a choice: a cortex without tension wrinkles in most flows.
const companions: Record<string, (values: Case) => Case> = {
  'cell.cortex.law': (values): Case => (values['cell.cortex.tension_mN_per_m'] ? {} : { 'cell.cortex.tension_ratio': 0.1 }),
};

function withCompanions(values: Case, name: string): Case {
  const next = { ...values, ...companions[name]?.(values) };
  if ('cell.cortex.tension_ratio' in next) delete next['cell.cortex.tension_mN_per_m'];
  return next;
}

/** The case with one key changed: its alternative gives way, other keys come and go with the laws. */
export function withKey(keys: Keys, values: Case, name: string, value: Value, earlier: Case = {}): Case {
  const wasNone = optionOf(keys, values, name) === 'none';
  const changed = { ...values, [name]: value };
  const next = wasNone ? withCompanions(changed, name) : changed;
  const other = keys.get(name)?.alternative;
  if (other) delete next[other];
  if (name.startsWith('channel.profile.')) {
    delete next['channel.width_um'];
    delete next['channel.radius_um'];
  }
  return completed(keys, next, earlier);
}

/** The one of two alternatives that is set, or that stands for both when none is. */
export function isShown(keys: Keys, values: Case, key: KeyDescription): boolean {
  if (!hasEffect(keys, values, key)) return false;
  const other = key.alternative ? keys.get(key.alternative) : undefined;
  if (!other || !hasEffect(keys, values, other)) return true;
  if (key.name in values || other.name in values) return key.name in values;
  return declaredBefore(keys, key, other);
}

/** Rarely changed numbers: those that start with a default other than nothing. They stand behind "More". */
export const isRare = (key: KeyDescription) =>
  (key.kind === 'number' && typeof key.default === 'number' && key.default !== 0) || key.kind === 'list';

const proper: Record<string, string> = { young: 'Young’s', kbt: 'kBT' };

/** "cell.bulk.young_modulus_kPa" -> "Young's modulus": the last part without its unit. */
export function titleOf(key: KeyDescription): string {
  const last = key.name.split('.').pop()!;
  const unit = key.unit.replace('/', '_per_').replace(/[ ^]/g, '_');
  const endings = [unit, unit.replace('_s_n', '_sn'), unit.replace('_', '')].map((ending) => `_${ending}`);
  const ending = key.unit ? endings.find((text) => last.endsWith(text)) : undefined;
  const words = (ending ? last.slice(0, -ending.length) : last).split('_').map((word) => proper[word] ?? word);
  const text = words.join(' ');
  return text[0].toUpperCase() + text.slice(1);
}

const sectionTitles: Record<string, string> = {
  channel: 'Channel',
  'channel.profile': 'Profile of the wall',
  flow: 'Flow',
  cell: 'Cell',
  'cell.bulk': 'Interior',
  'cell.cortex': 'Cortex',
  time: 'Time',
  numerics: 'Accuracy',
};
export const sectionTitle = (section: string) => sectionTitles[section] ?? section;
