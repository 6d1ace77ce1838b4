// Which triangle of a mesh covers which pixel of the upper half of the picture; from it colours and values anywhere.
// Runs at each movement of a slider: plain loops over arrays, nothing is allocated inside.
import type { ColorMap } from './colormap';
import type { Fields } from './fields';

/** How places in um become pixels: x to the right from the left edge, r upwards from the axis (the lower edge). */
export interface Frame {
  width: number;
  height: number;
  left_um: number;
  pixels_per_um: number;
}

export interface Cover {
  frame: Frame;
  /** triangle of each pixel, -1 for none; row 0 is at the top (greatest r) */
  triangle: Int32Array;
  /** places of the mesh's points in pixels */
  x: Float64Array;
  y: Float64Array;
}

function placePoints(fields: Fields, frame: Frame): Cover {
  const points = fields.region.length;
  const x = new Float64Array(points);
  const y = new Float64Array(points);
  for (let k = 0; k < points; ++k) {
    x[k] = (fields.places[2 * k] - frame.left_um) * frame.pixels_per_um;
    y[k] = frame.height - fields.places[2 * k + 1] * frame.pixels_per_um;
  }
  return { frame, triangle: new Int32Array(frame.width * frame.height).fill(-1), x, y };
}

/** Fills the rows of one triangle whose corners a, b, c are sorted by y. */
function fillTriangle({ frame, triangle, x, y }: Cover, id: number, a: number, b: number, c: number): void {
  const { width, height } = frame;
  const from = Math.max(0, Math.ceil(y[a] - 0.5));
  const to = Math.min(height - 1, Math.ceil(y[c] - 0.5) - 1);
  for (let row = from; row <= to; ++row) {
    const level = row + 0.5;
    const long = x[a] + ((level - y[a]) / (y[c] - y[a])) * (x[c] - x[a]);
    const [p, q] = level < y[b] ? [a, b] : [b, c];
    const short = x[p] + ((level - y[p]) / (y[q] - y[p])) * (x[q] - x[p]);
    const first = Math.max(0, Math.ceil((long < short ? long : short) - 0.501));
    const last = Math.min(width - 1, Math.floor((long < short ? short : long) - 0.499));
    for (let at = row * width + first; at <= row * width + last; ++at) triangle[at] = id;
  }
}

export function coverPixels(fields: Fields, frame: Frame): Cover {
  const cover = placePoints(fields, frame);
  const { x, y } = cover;
  const { triangles } = fields;
  for (let t = 0; t < triangles.length; t += 3) {
    let [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    if ((x[a] < 0 && x[b] < 0 && x[c] < 0) || (x[a] > frame.width && x[b] > frame.width && x[c] > frame.width)) continue;
    if (y[a] > y[b]) [a, b] = [b, a];
    if (y[b] > y[c]) [b, c] = [c, b];
    if (y[a] > y[b]) [a, b] = [b, a];
    fillTriangle(cover, t / 3, a, b, c);
  }
  return cover;
}

/** value = at + along x + up y in pixels of the frame, over one triangle. */
interface Plane {
  at: number;
  x: number;
  y: number;
}

function putPlane(plane: Plane, fields: Fields, cover: Cover, values: Float32Array, id: number): void {
  const { x, y } = cover;
  const a = fields.triangles[3 * id];
  const b = fields.triangles[3 * id + 1];
  const c = fields.triangles[3 * id + 2];
  const det = (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]) || 1e-12;
  const one = values[b] - values[a];
  const two = values[c] - values[a];
  plane.x = (one * (y[c] - y[a]) - two * (y[b] - y[a])) / det;
  plane.y = (two * (x[b] - x[a]) - one * (x[c] - x[a])) / det;
  plane.at = values[a] - plane.x * x[a] - plane.y * y[a];
}

export interface Paint {
  values: Float32Array;
  map: ColorMap;
  low: number;
  high: number;
}

/** Colours of the half picture; liquid and cell have a paint of their own, null leaves the ground. */
export function paintPixels(fields: Fields, cover: Cover, paints: (Paint | null)[], pixels: Uint32Array): void {
  const { frame, triangle } = cover;
  const plane: Plane = { at: 0, x: 0, y: 0 };
  let last = -1;
  let paint: Paint | null = null;
  for (let row = 0, at = 0; row < frame.height; ++row) {
    for (let column = 0; column < frame.width; ++column, ++at) {
      const id = triangle[at];
      if (id < 0) continue;
      if (id !== last) {
        last = id;
        paint = paints[fields.region[fields.triangles[3 * id]]];
        if (paint) putPlane(plane, fields, cover, paint.values, id);
      }
      if (!paint) continue;
      const value = plane.at + plane.x * (column + 0.5) + plane.y * (row + 0.5);
      const place = (255 * (value - paint.low)) / (paint.high - paint.low) + 0.5;
      pixels[at] = paint.map.pixels[place < 0 ? 0 : place > 255 ? 255 : place | 0];
    }
  }
}

/** Values of a field at the pixels of one region; zero elsewhere. */
export function sampleRegion(fields: Fields, cover: Cover, values: Float32Array, region: number): Float32Array {
  const { frame, triangle } = cover;
  const samples = new Float32Array(triangle.length);
  const plane: Plane = { at: 0, x: 0, y: 0 };
  let last = -1;
  for (let row = 0, at = 0; row < frame.height; ++row) {
    for (let column = 0; column < frame.width; ++column, ++at) {
      const id = triangle[at];
      if (id < 0 || fields.region[fields.triangles[3 * id]] !== region) continue;
      if (id !== last) putPlane(plane, fields, cover, values, id);
      last = id;
      samples[at] = plane.at + plane.x * (column + 0.5) + plane.y * (row + 0.5);
    }
  }
  return samples;
}

/** The triangle at a place, r mirrored at the axis; -1 outside. */
function triangleAt({ frame, triangle }: Cover, x_um: number, r_um: number): number {
  const column = Math.floor((x_um - frame.left_um) * frame.pixels_per_um);
  const row = Math.min(frame.height - 1, Math.floor(frame.height - Math.abs(r_um) * frame.pixels_per_um));
  const inside = column >= 0 && column < frame.width && row >= 0;
  return inside ? triangle[row * frame.width + column] : -1;
}

/** Value of a field at a place, from the triangle there; null outside. */
export function valueAt(fields: Fields, cover: Cover, values: Float32Array, x_um: number, r_um: number): number | null {
  const id = triangleAt(cover, x_um, r_um);
  if (id < 0) return null;
  const plane: Plane = { at: 0, x: 0, y: 0 };
  putPlane(plane, fields, cover, values, id);
  const { frame } = cover;
  const x = (x_um - frame.left_um) * frame.pixels_per_um;
  return plane.at + plane.x * x + plane.y * (frame.height - Math.abs(r_um) * frame.pixels_per_um);
}

/** 0 in the liquid, 1 in the cell, null outside. */
export function regionAt(fields: Fields, cover: Cover, x_um: number, r_um: number): number | null {
  const id = triangleAt(cover, x_um, r_um);
  return id < 0 ? null : fields.region[fields.triangles[3 * id]];
}
