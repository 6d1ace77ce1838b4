// Which triangle of a mesh covers which pixel of the upper half of the picture; from it colours and values anywhere.
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
}

type Corner = { x: number; y: number };

function corner(fields: Fields, frame: Frame, point: number): Corner {
  return {
    x: (fields.places[2 * point] - frame.left_um) * frame.pixels_per_um,
    y: frame.height - fields.places[2 * point + 1] * frame.pixels_per_um,
  };
}

/** Pixels of one row between the edges of a triangle whose corners are sorted by y. */
function fillRow(cover: Cover, id: number, [a, b, c]: Corner[], row: number): void {
  const y = row + 0.5;
  const cut = (p: Corner, q: Corner) => p.x + ((y - p.y) / (q.y - p.y)) * (q.x - p.x);
  const long = cut(a, c);
  const short = y < b.y ? cut(a, b) : cut(b, c);
  const { width } = cover.frame;
  const from = Math.max(0, Math.ceil(Math.min(long, short) - 0.501));
  const to = Math.min(width - 1, Math.floor(Math.max(long, short) - 0.499));
  cover.triangle.fill(id, row * width + from, row * width + Math.max(from, to + 1));
}

function fillTriangle(cover: Cover, id: number, corners: Corner[]): void {
  const sorted = corners.sort((p, q) => p.y - q.y);
  const { height, width } = cover.frame;
  if (Math.max(...corners.map((p) => p.x)) < 0 || Math.min(...corners.map((p) => p.x)) > width) return;
  const from = Math.max(0, Math.ceil(sorted[0].y - 0.5));
  const to = Math.min(height - 1, Math.ceil(sorted[2].y - 0.5) - 1);
  for (let row = from; row <= to; ++row) fillRow(cover, id, sorted, row);
}

export function coverPixels(fields: Fields, frame: Frame): Cover {
  const cover = { frame, triangle: new Int32Array(frame.width * frame.height).fill(-1) };
  const { triangles } = fields;
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [0, 1, 2].map((k) => corner(fields, frame, triangles[t + k]));
    fillTriangle(cover, t / 3, corners);
  }
  return cover;
}

/** value = at + along x + up y in pixels of the frame, over one triangle. */
interface Plane {
  at: number;
  x: number;
  y: number;
}

function plane(fields: Fields, frame: Frame, values: Float32Array, id: number): Plane {
  const points = [0, 1, 2].map((k) => fields.triangles[3 * id + k]);
  const [a, b, c] = points.map((point) => corner(fields, frame, point));
  const [u, v, w] = points.map((point) => values[point]);
  const det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y) || 1e-12;
  const x = ((v - u) * (c.y - a.y) - (w - u) * (b.y - a.y)) / det;
  const y = ((w - u) * (b.x - a.x) - (v - u) * (c.x - a.x)) / det;
  return { at: u - x * a.x - y * a.y, x, y };
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
  let last = -1;
  let now: Plane = { at: 0, x: 0, y: 0 };
  let paint: Paint | null = null;
  for (let row = 0, at = 0; row < frame.height; ++row) {
    for (let column = 0; column < frame.width; ++column, ++at) {
      const id = triangle[at];
      if (id < 0) continue;
      if (id !== last) {
        last = id;
        paint = paints[fields.region[fields.triangles[3 * id]]];
        if (paint) now = plane(fields, frame, paint.values, id);
      }
      if (!paint) continue;
      const value = now.at + now.x * (column + 0.5) + now.y * (row + 0.5);
      const place = (255 * (value - paint.low)) / (paint.high - paint.low) + 0.5;
      pixels[at] = paint.map.pixels[place < 0 ? 0 : place > 255 ? 255 : place | 0];
    }
  }
}

/** Value of a field at a place, from the triangle there; null outside. r is mirrored at the axis. */
export function valueAt(fields: Fields, cover: Cover, values: Float32Array, x_um: number, r_um: number): number | null {
  const { frame, triangle } = cover;
  const x = (x_um - frame.left_um) * frame.pixels_per_um;
  const y = frame.height - Math.abs(r_um) * frame.pixels_per_um;
  const column = Math.floor(x);
  const row = Math.min(frame.height - 1, Math.floor(y));
  if (column < 0 || column >= frame.width || row < 0) return null;
  const id = triangle[row * frame.width + column];
  if (id < 0) return null;
  const p = plane(fields, frame, values, id);
  return p.at + p.x * x + p.y * y;
}

export function regionAt(fields: Fields, cover: Cover, x_um: number, r_um: number): number | null {
  const flags = Float32Array.from(fields.region);
  const found = valueAt(fields, cover, flags, x_um, r_um);
  return found === null ? null : Math.round(found);
}
