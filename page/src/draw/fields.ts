// The fields of an answer as arrays: a triangle mesh of the half plane and values at its points.
import type { EncodedFields } from '../api';

export interface Fields {
  /** x, r of each point, um */
  places: Float32Array;
  triangles: Uint32Array;
  /** per point: 0 liquid, 1 cell */
  region: Uint8Array;
  values: Record<string, Float32Array>;
  surface: EncodedFields['surface'];
  wall: EncodedFields['wall'];
  surface3d: { places: Float32Array; triangles: Uint32Array } | null;
}

function bytes(base64: string): ArrayBuffer {
  const text = window.atob(base64);
  const found = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) found[k] = text.charCodeAt(k);
  return found.buffer;
}

const floats = (base64: string) => new Float32Array(bytes(base64));
const indices = (base64: string) => new Uint32Array(bytes(base64));

export function decodeFields(encoded: EncodedFields): Fields {
  const values = Object.entries(encoded.values).map(([name, text]) => [name, floats(text)] as const);
  const solid = encoded.surface3d;
  return {
    places: floats(encoded.xy_um),
    triangles: indices(encoded.index),
    region: new Uint8Array(bytes(encoded.region)),
    values: Object.fromEntries(values),
    surface: encoded.surface,
    wall: encoded.wall,
    surface3d: solid ? { places: floats(solid.xyz_um), triangles: indices(solid.index) } : null,
  };
}

/** One number per point; a vector field gives its length. Null for a name that is not there. */
export function scalarField(fields: Fields, name: string): Float32Array | null {
  const found = fields.values[name];
  const points = fields.region.length;
  if (!found || found.length === points) return found ?? null;
  return Float32Array.from({ length: points }, (_, k) => Math.hypot(found[2 * k], found[2 * k + 1]));
}

/** Least and greatest value over the points of a region. */
export function fieldRange(fields: Fields, values: Float32Array, region: number): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let k = 0; k < values.length; ++k) {
    if (fields.region[k] !== region || !Number.isFinite(values[k])) continue;
    if (values[k] < low) low = values[k];
    if (values[k] > high) high = values[k];
  }
  return low <= high ? [low, high] : [0, 1];
}
