// Names of the features as people read them; what is not listed appears as the file names it.
// No plain object: a file may call a feature "constructor".
const known = new Map<string, [string, string]>(Object.entries({
  area_um: ['Area', 'µm²'],
  area_cvx: ['Area of the convex hull', 'px'],
  area_msd: ['Area of the contour', 'px'],
  area_ratio: ['Area ratio', ''],
  aspect: ['Aspect ratio of the box', ''],
  bright_avg: ['Brightness, mean', ''],
  bright_sd: ['Brightness, sd', ''],
  circ: ['Circularity', ''],
  deform: ['Deformation', ''],
  emodulus: ["Young's modulus E", 'kPa'],
  emodulus_stored: ["Young's modulus stored in the file", 'kPa'],
  frame: ['Frame', ''],
  index: ['Index', ''],
  inert_ratio_cvx: ['Inertia ratio of the hull', ''],
  inert_ratio_prnc: ['Principal inertia ratio', ''],
  inert_ratio_raw: ['Inertia ratio of the contour', ''],
  pos_x: ['Position along the channel', 'µm'],
  pos_y: ['Position across the channel', 'µm'],
  odd_share: ['Odd share of the outline', ''],
  shape_excess: ['Shape excess', ''],
  flank_slope: ['Slope of the flanks', ''],
  sine_mode_2: ['Sine mode s2 of the outline', ''],
  sine_mode_3: ['Sine mode s3 of the outline', ''],
  sine_mode_4: ['Sine mode s4 of the outline', ''],
  size_x: ['Length of the box', 'µm'],
  size_y: ['Height of the box', 'µm'],
  standard_error: ['Standard error of E', 'kPa'],
  standard_error_asymmetry: ['Standard error of E as of an elongated cell', 'kPa'],
  state: ['State of the modulus', ''],
  temp: ['Temperature', '°C'],
  axial_tension: ['Axial tension of the liquid', 'Pa'],
  axial_tension_error: ['Standard error of the axial tension', 'Pa'],
  elongation: ['Elongation by the axial tension', ''],
  elongation_error: ['Standard error of the elongation', ''],
  standard_error_inertia: ['Standard error of E as of an elongated cell', 'kPa'],
  young_modulus_inertia: ['E as of an elongated cell', 'kPa'],
  tilt: ['Tilt', 'rad'],
  time: ['Time', 's'],
  volume: ['Volume', 'µm³'],
  young_modulus_asymmetry: ['E as of an elongated cell', 'kPa'],
  young_modulus_with_cortex_kPa: ['E beside a cortex', 'kPa'],
  stiffness_kPa: ['Stiffness E + E2D/r0', 'kPa'],
  cortex_modulus_mN_per_m: ['Cortex modulus E2D', 'mN/m'],
  tension_mN_per_m: ['Cortex tension', 'mN/m'],
}));

const spoken: [RegExp, string][] = [
  [/_kPa$/, 'kPa'],
  [/_mN_per_m$/, 'mN/m'],
  [/_um2$/, 'µm²'],
  [/_um$/, 'µm'],
];

export function unitOf(feature: string): string {
  return known.get(feature)?.[1] ?? spoken.find(([ending]) => ending.test(feature))?.[1] ?? '';
}

export function nameOf(feature: string): string {
  const own = known.get(feature);
  if (own) return own[0];
  const bare = spoken.reduce((text, [ending]) => text.replace(ending, ''), feature).replace(/_/g, ' ');
  return bare.charAt(0).toUpperCase() + bare.slice(1);
}

/** "Area (µm²)" */
export function labelOf(feature: string): string {
  const unit = unitOf(feature);
  return unit === '' ? nameOf(feature) : `${nameOf(feature)} (${unit})`;
}

export const youngModulus = 'emodulus';
/** A modulus that the recording brings along: of another program, or of a companion that is opened as a recording. */
export const storedModulus = 'emodulus_stored';
const computed = new Set([
  youngModulus,
  'state',
  'standard_error',
  'young_modulus_asymmetry',
  'standard_error_asymmetry',
  'young_modulus_inertia',
  'standard_error_inertia',
  'elongation',
  'elongation_error',
  'axial_tension',
  'axial_tension_error',
  'shape_excess',
  'odd_share',
  'sine_mode_2',
  'flank_slope',
  'sine_mode_3',
  'sine_mode_4',
  'young_modulus_with_cortex_kPa',
  'cortex_modulus_mN_per_m',
  'tension_mN_per_m',
  'stiffness_kPa',
]);
/** What the program computes with the moduli; all else is in the file. */
export const isComputed = (feature: string): boolean => computed.has(feature);
