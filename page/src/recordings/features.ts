// Names of the features as people read them; what nobody has named appears as the file names it.
import { readFeatures, type Feature } from '../api';

/** Those that the program computes, with its own labels. */
const computed = new Map<string, Feature>();
export const takeFeatures = (features: Feature[]): void => features.forEach((feature) => computed.set(feature.name, feature));
export const readComputed = async (): Promise<void> => takeFeatures(await readFeatures());

// No plain object: a file may call a feature "constructor".
const known = new Map<string, [string, string]>(Object.entries({
  area_um: ['Area', 'µm²'],
  area_cvx: ['Area of the convex hull', 'px'],
  area_msd: ['Area of the contour', 'px'],
  area_ratio: ['Area ratio', ''],
  aspect: ['Aspect ratio of the box', ''],
  bright_avg: ['Brightness, mean', ''],
  bright_sd: ['Brightness, SD', ''],
  circ: ['Circularity', ''],
  deform: ['Deformation', ''],
  emodulus_stored: ["Young's modulus stored in the file", 'kPa'],
  frame: ['Frame', ''],
  index: ['Index', ''],
  inert_ratio_cvx: ['Inertia ratio of the hull', ''],
  inert_ratio_prnc: ['Principal inertia ratio', ''],
  inert_ratio_raw: ['Inertia ratio of the contour', ''],
  pos_x: ['Position along the channel', 'µm'],
  pos_y: ['Position across the channel', 'µm'],
  size_x: ['Length of the box', 'µm'],
  size_y: ['Height of the box', 'µm'],
  temp: ['Temperature', '°C'],
  tilt: ['Tilt', 'rad'],
  time: ['Time', 's'],
  volume: ['Volume', 'µm³'],
}));

const spoken: [RegExp, string][] = [
  [/_kPa$/, 'kPa'],
  [/_mN_per_m$/, 'mN/m'],
  [/_um2$/, 'µm²'],
  [/_um$/, 'µm'],
];

export function unitOf(feature: string): string {
  return computed.get(feature)?.unit ?? known.get(feature)?.[1] ?? spoken.find(([ending]) => ending.test(feature))?.[1] ?? '';
}

export function nameOf(feature: string): string {
  const own = computed.get(feature)?.label ?? known.get(feature)?.[0];
  if (own) return own;
  const bare = spoken.reduce((text, [ending]) => text.replace(ending, ''), feature).replace(/_/g, ' ');
  return bare.charAt(0).toUpperCase() + bare.slice(1);
}

/** "Area (µm²)" */
export function labelOf(feature: string): string {
  const unit = unitOf(feature);
  return unit === '' ? nameOf(feature) : `${nameOf(feature)} (${unit})`;
}

/** In place of a number that no recording has. */
export const noValues = 'No recording has this quantity yet. “Compute moduli” on the left computes the moduli of its events.';
export const youngModulus = 'emodulus';
const effectiveModulus = 'effective_modulus_kPa';
const elongatedModuli = ['young_modulus_asymmetry_kPa', 'young_modulus_inertia_kPa'];
/** The moduli of which one is recommended for a recording. */
export const isRecommendable = (feature: string): boolean => [youngModulus, effectiveModulus, ...elongatedModuli].includes(feature);

export const recommendedName = 'Recommended modulus';
/** The modulus that a word of `recommended_modulus` means; none for "none". */
export const recommendedFeature = (by: string): string | undefined =>
  ({ deformation: youngModulus, elongated: elongatedModuli[0], effective: effectiveModulus })[by];

const fitted: Record<string, string> = {
  young_modulus: youngModulus,
  stiffness: 'stiffness_kPa',
  effective_modulus: effectiveModulus,
  cortex_modulus: 'cortex_modulus_mN_per_m',
  cortex_tension: 'tension_mN_per_m',
  axial_tension: 'axial_tension_Pa',
};
/** The number of events whose median a fit of populations determines; of cells with a cortex the Young's modulus is that of the bulk. */
export const featureOfQuantity = (quantity: string, model: string): string =>
  quantity === 'young_modulus' && model === 'cortex' ? 'young_modulus_with_cortex_kPa' : (fitted[quantity] ?? quantity);

/** A modulus that the recording brings along: of another program, or of a companion that is opened as a recording. */
export const storedModulus = 'emodulus_stored';
/** What the program computes with the moduli; all else is in the file. */
export const isComputed = (feature: string): boolean => feature === youngModulus || computed.has(feature);
