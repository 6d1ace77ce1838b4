// Which triangle of a mesh covers which pixel of the picture, or of its upper half; from it colours and values anywhere.
// Runs at each movement of a slider: plain loops over arrays, nothing is allocated inside.
import type { ColorMap } from './colormap';
import type { Fields } from './fields';

/** How places in um become pixels: x to the right from the left edge, r upwards from the lower edge, which is the axis unless
 * the picture is stretched. */
export interface Frame {
  width: number;
  height: number;
  left_um: number;
  low_um: number;
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

interface Placed {
  x: Float64Array;
  y: Float64Array;
}

const rowOf = (frame: Frame, r_um: number) => frame.height - (r_um - frame.low_um) * frame.pixels_per_um;

function placePoints(fields: Fields, frame: Frame): Placed {
  const points = fields.region.length;
  const x = new Float64Array(points);
  const y = new Float64Array(points);
  for (let k = 0; k < points; ++k) {
    x[k] = (fields.places[2 * k] - frame.left_um) * frame.pixels_per_um;
    y[k] = rowOf(frame, fields.places[2 * k + 1]);
  }
  return { x, y };
}

/** Calls `fill` for each row of one triangle whose corners a, b, c are sorted by y: the row, its first and last column. */
function eachRow({ x, y }: Placed, frame: Frame, a: number, b: number, c: number, fill: (row: number, first: number, last: number) => void): void {
  const { width, height } = frame;
  const from = Math.max(0, Math.ceil(y[a] - 0.5));
  const to = Math.min(height - 1, Math.ceil(y[c] - 0.5) - 1);
  const along = (x[c] - x[a]) / (y[c] - y[a]);
  for (let row = from; row <= to; ++row) {
    const level = row + 0.5;
    const p = level < y[b] ? a : b;
    const q = level < y[b] ? b : c;
    const long = x[a] + (level - y[a]) * along;
    const short = x[p] + ((level - y[p]) / (y[q] - y[p])) * (x[q] - x[p]);
    const first = Math.max(0, Math.ceil((long < short ? long : short) - 0.501));
    const last = Math.min(width - 1, Math.floor((long < short ? short : long) - 0.499));
    if (first <= last) fill(row, first, last);
  }
}

/** All triangles in the frame, each announced by `begin`, which says whether it is wanted, and then row by row. */
function eachTriangle(
  fields: Fields,
  frame: Frame,
  placed: Placed,
  begin: (id: number) => boolean,
  fill: (row: number, first: number, last: number) => void,
): void {
  const { x, y } = placed;
  const { triangles } = fields;
  for (let t = 0; t < triangles.length; t += 3) {
    let a = triangles[t];
    let b = triangles[t + 1];
    let c = triangles[t + 2];
    if ((x[a] < 0 && x[b] < 0 && x[c] < 0) || (x[a] > frame.width && x[b] > frame.width && x[c] > frame.width)) continue;
    if (!begin(t / 3)) continue;
    if (y[a] > y[b]) [a, b] = [b, a];
    if (y[b] > y[c]) [b, c] = [c, b];
    if (y[a] > y[b]) [a, b] = [b, a];
    eachRow(placed, frame, a, b, c, fill);
  }
}

export function coverPixels(fields: Fields, frame: Frame): Cover {
  const placed = placePoints(fields, frame);
  const triangle = new Int32Array(frame.width * frame.height).fill(-1);
  let now = -1;
  const begin = (id: number) => ((now = id), true);
  eachTriangle(fields, frame, placed, begin, (row, first, last) => {
    const end = row * frame.width + last;
    for (let at = row * frame.width + first; at <= end; ++at) triangle[at] = now;
  });
  return { frame, triangle, ...placed };
}

/** value = at + along x + up y in pixels of the frame, over one triangle. */
interface Plane {
  at: number;
  x: number;
  y: number;
}

function putPlane(plane: Plane, fields: Fields, { x, y }: Placed, values: Float32Array, id: number): void {
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

/** Colours of the pixels of a frame; liquid and cell have a paint of their own, null leaves the ground. */
export function paintPixels(fields: Fields, frame: Frame, paints: (Paint | null)[], pixels: Uint32Array): void {
  const placed = placePoints(fields, frame);
  const plane: Plane = { at: 0, x: 0, y: 0 };
  let colours: Uint32Array = new Uint32Array(0);
  // The plane becomes one of places in the map, so that each pixel takes one addition.
  const begin = (id: number): boolean => {
    const paint = paints[fields.region[fields.triangles[3 * id]]];
    if (!paint) return false;
    putPlane(plane, fields, placed, paint.values, id);
    const scale = 255 / (paint.high - paint.low);
    plane.at = (plane.at - paint.low) * scale + 0.5;
    plane.x *= scale;
    plane.y *= scale;
    colours = paint.map.pixels;
    return true;
  };
  eachTriangle(fields, frame, placed, begin, (row, first, last) => {
    const step = plane.x;
    let place = plane.at + step * (first + 0.5) + plane.y * (row + 0.5);
    const end = row * frame.width + last;
    for (let at = row * frame.width + first; at <= end; ++at, place += step)
      pixels[at] = colours[place < 0 ? 0 : place > 255 ? 255 : place | 0];
  });
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

/** Where the fields of a place are: mirrored at the axis, unless they are of both sides. */
const heightIn = (fields: Fields, r_um: number) => (fields.whole ? r_um : Math.max(Math.abs(r_um), 1e-9));

/** The triangle at a place; -1 outside. */
function triangleAt({ frame, triangle }: Cover, x_um: number, height_um: number): number {
  const column = Math.floor((x_um - frame.left_um) * frame.pixels_per_um);
  const row = Math.floor(rowOf(frame, height_um));
  const inside = column >= 0 && column < frame.width && row >= 0 && row < frame.height;
  return inside ? triangle[row * frame.width + column] : -1;
}

/** Value of a field at a place, from the triangle there; null outside. */
export function valueAt(fields: Fields, cover: Cover, values: Float32Array, x_um: number, r_um: number): number | null {
  const height_um = heightIn(fields, r_um);
  const id = triangleAt(cover, x_um, height_um);
  if (id < 0) return null;
  const plane: Plane = { at: 0, x: 0, y: 0 };
  putPlane(plane, fields, cover, values, id);
  const { frame } = cover;
  const x = (x_um - frame.left_um) * frame.pixels_per_um;
  return plane.at + plane.x * x + plane.y * rowOf(frame, height_um);
}

/** 0 in the liquid, 1 in the cell, null outside. */
export function regionAt(fields: Fields, cover: Cover, x_um: number, r_um: number): number | null {
  const id = triangleAt(cover, x_um, heightIn(fields, r_um));
  return id < 0 ? null : fields.region[fields.triangles[3 * id]];
}
