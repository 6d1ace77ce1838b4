// Streamlines of the velocity relative to the cell, followed on a coarse grid of it.
import type { Fields } from './fields';
import { coverPixels, valueAt, type Frame } from './raster';

interface Grid {
  frame: Frame;
  u: Float32Array;
  v: Float32Array;
  inside: Uint8Array;
}

const spacing_um = (radius_um: number) => radius_um / 48;

function velocityGrid(fields: Fields, frame: Frame): Grid | null {
  const velocity = fields.values.velocity_m_per_s;
  if (!velocity) return null;
  const points = fields.region.length;
  const u = Float32Array.from({ length: points }, (_, k) => velocity[2 * k]);
  const v = Float32Array.from({ length: points }, (_, k) => velocity[2 * k + 1]);
  const cover = coverPixels(fields, frame);
  const size = frame.width * frame.height;
  const grid = { frame, u: new Float32Array(size), v: new Float32Array(size), inside: new Uint8Array(size) };
  for (let row = 0, at = 0; row < frame.height; ++row) {
    for (let column = 0; column < frame.width; ++column, ++at) {
      const id = cover.triangle[at];
      if (id < 0 || fields.region[fields.triangles[3 * id]] !== 0) continue;
      const x = frame.left_um + (column + 0.5) / frame.pixels_per_um;
      const r = (frame.height - row - 0.5) / frame.pixels_per_um;
      grid.u[at] = valueAt(fields, cover, u, x, r) ?? 0;
      grid.v[at] = valueAt(fields, cover, v, x, r) ?? 0;
      grid.inside[at] = 1;
    }
  }
  return grid;
}

/** Direction of the flow at a place of the grid; null in the cell and outside. */
function direction(grid: Grid, x: number, r: number): [number, number] | null {
  const { frame } = grid;
  const column = (x - frame.left_um) * frame.pixels_per_um - 0.5;
  const row = frame.height - r * frame.pixels_per_um - 0.5;
  const i = Math.min(frame.width - 2, Math.floor(column));
  const j = Math.min(frame.height - 2, Math.floor(row));
  if (i < 0 || j < 0) return null;
  const [s, t] = [column - i, Math.min(1, row - j)];
  let [u, v, weight] = [0, 0, 0];
  for (const [di, dj, share] of [[0, 0, (1 - s) * (1 - t)], [1, 0, s * (1 - t)], [0, 1, (1 - s) * t], [1, 1, s * t]]) {
    const at = (j + dj) * frame.width + i + di;
    if (!grid.inside[at]) continue;
    u += share * grid.u[at];
    v += share * grid.v[at];
    weight += share;
  }
  const speed = Math.hypot(u, v);
  return weight > 0.4 && speed > 0 ? [u / speed, v / speed] : null;
}

function follow(grid: Grid, start: [number, number], way: 1 | -1): [number, number][] {
  const step = (0.6 * way) / grid.frame.pixels_per_um;
  const line: [number, number][] = [start];
  let [x, r] = start;
  for (let k = 0; k < 1500; ++k) {
    const first = direction(grid, x, r);
    const middle = first && direction(grid, x + 0.5 * step * first[0], r + 0.5 * step * first[1]);
    if (!middle) break;
    x += step * middle[0];
    r = Math.abs(r + step * middle[1]);
    if (k % 3 === 2) line.push([x, r]);
  }
  return line;
}

/** Starting points at equal distances across the channel, at both ends of what is seen and beside the cell. */
function seeds(frame: Frame, radius_um: number): [number, number][] {
  const right = frame.left_um + frame.width / frame.pixels_per_um;
  const margin = 2 / frame.pixels_per_um;
  const across = [0.06, 0.19, 0.32, 0.45, 0.56, 0.72, 0.83, 0.94].map((share) => share * radius_um);
  return [frame.left_um + margin, right - margin].flatMap((x) => across.map((r): [number, number] => [x, r]));
}

export interface Streamline {
  points: [number, number][];
  /** where an arrow stands and whither it points, radians */
  arrow: { x: number; r: number; angle: number } | null;
}

function withArrow(points: [number, number][], way: 1 | -1): Streamline {
  const k = Math.min(points.length - 2, 8);
  if (k < 1) return { points, arrow: null };
  const angle = Math.atan2(way * (points[k + 1][1] - points[k][1]), way * (points[k + 1][0] - points[k][0]));
  return { points, arrow: { x: points[k][0], r: points[k][1], angle } };
}

/** Streamlines of the upper half between two places along the channel. */
export function streamlines(fields: Fields, from_um: number, to_um: number, radius_um: number): Streamline[] {
  const pixels_per_um = 1 / spacing_um(radius_um);
  const size = (length: number) => Math.max(2, Math.round(length * pixels_per_um));
  const frame = { width: size(to_um - from_um), height: size(radius_um), left_um: from_um, pixels_per_um };
  const grid = velocityGrid(fields, frame);
  if (!grid) return [];
  return seeds(frame, radius_um).flatMap((seed) => {
    const here = direction(grid, seed[0], seed[1]);
    if (!here) return [];
    const inwards = seed[0] < 0.5 * (from_um + to_um) ? here[0] > 0 : here[0] < 0;
    const points = follow(grid, seed, inwards ? 1 : -1);
    return points.length > 6 ? [withArrow(points, inwards ? 1 : -1)] : [];
  });
}
