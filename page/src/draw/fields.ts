// The fields of an answer as arrays: a triangle mesh of the half plane, or of the whole one, and values at its points.
import type { EncodedFields, FieldsHead, FieldsText } from '../api';

export interface Fields {
  /** x, r of each point, um */
  places: Float32Array;
  /** both sides of the axis: what is below is not the mirror image of what is above */
  whole: boolean;
  triangles: Uint32Array;
  /** per point: 0 liquid, 1 cell */
  region: Uint8Array;
  values: Record<string, Float32Array>;
  surface: FieldsHead['surface'];
  wall: FieldsHead['wall'];
  surface3d: { places: Float32Array; triangles: Uint32Array } | null;
}

function areOfBothSides(places: Float32Array): boolean {
  for (let k = 1; k < places.length; k += 2) if (places[k] < -1e-3) return true;
  return false;
}

export function decodeFields({ head, bytes }: EncodedFields): Fields {
  const kinds = { float32: Float32Array, uint32: Uint32Array, uint8: Uint8Array };
  const found = new Map<string, Float32Array | Uint32Array | Uint8Array>();
  let at = 0;
  for (const { name, type, count } of head.arrays) {
    const array = new kinds[type](bytes, at, count);
    found.set(name, array);
    at += array.byteLength;
  }
  const values = [...found].filter(([name]) => name.startsWith('values/')).map(([name, array]) => [name.slice(7), array]);
  const solid = found.get('surface3d/xyz_um') as Float32Array | undefined;
  const places = found.get('xy_um') as Float32Array;
  return {
    places,
    whole: areOfBothSides(places),
    triangles: found.get('index') as Uint32Array,
    region: found.get('region') as Uint8Array,
    values: Object.fromEntries(values) as Record<string, Float32Array>,
    surface: head.surface,
    wall: head.wall,
    surface3d: solid ? { places: solid, triangles: found.get('surface3d/index') as Uint32Array } : null,
  };
}

function bytesOf(base64: string): ArrayBuffer {
  const text = window.atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes.buffer;
}

export function fieldsOfText({ xy_um, index, region, values, surface, wall, surface3d }: FieldsText): Fields {
  const places = new Float32Array(bytesOf(xy_um));
  return {
    places,
    whole: areOfBothSides(places),
    triangles: new Uint32Array(bytesOf(index)),
    region: new Uint8Array(bytesOf(region)),
    values: Object.fromEntries(Object.entries(values).map(([name, text]) => [name, new Float32Array(bytesOf(text))])),
    surface,
    wall,
    surface3d: surface3d
      ? { places: new Float32Array(bytesOf(surface3d.xyz_um)), triangles: new Uint32Array(bytesOf(surface3d.index)) }
      : null,
  };
}

/** The ends of the mesh along the channel, um. */
export function extentOf({ places }: Fields): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let k = 0; k < places.length; k += 2) {
    if (places[k] < low) low = places[k];
    if (places[k] > high) high = places[k];
  }
  return [low, high];
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
