// Streamlines of the velocity relative to the cell, followed on a coarse grid of it.
import { extentOf, type Fields } from './fields';
import { coverPixels, sampleRegion, type Cover, type Frame } from './raster';

interface Grid {
  frame: Frame;
  u: Float32Array;
  v: Float32Array;
  inside: Uint8Array;
  /** the direction found last */
  way: Float64Array;
}

const spacing_um = (radius_um: number) => radius_um / 40;

function component(vectors: Float32Array, d: number): Float32Array {
  const found = new Float32Array(vectors.length / 2);
  for (let k = 0; k < found.length; ++k) found[k] = vectors[2 * k + d];
  return found;
}

function insideLiquid({ region, triangles }: Fields, { triangle }: Cover): Uint8Array {
  const inside = new Uint8Array(triangle.length);
  for (let at = 0; at < triangle.length; ++at) {
    const id = triangle[at];
    if (id >= 0 && region[triangles[3 * id]] === 0) inside[at] = 1;
  }
  return inside;
}

function velocityGrid(fields: Fields, frame: Frame): Grid | null {
  const velocity = fields.values.velocity_m_per_s;
  if (!velocity) return null;
  const cover = coverPixels(fields, frame);
  return {
    frame,
    u: sampleRegion(fields, cover, component(velocity, 0), 0),
    v: sampleRegion(fields, cover, component(velocity, 1), 0),
    inside: insideLiquid(fields, cover),
    way: new Float64Array(2),
  };
}

/** Puts the direction of the flow at a place into grid.way; false in the cell and outside. */
function look(grid: Grid, x: number, r: number): boolean {
  const { frame, inside, way } = grid;
  const column = (x - frame.left_um) * frame.pixels_per_um - 0.5;
  const row = frame.height - (r - frame.low_um) * frame.pixels_per_um - 0.5;
  const i = Math.min(frame.width - 2, Math.floor(column));
  const j = Math.min(frame.height - 2, Math.floor(row));
  if (i < 0 || j < 0 || column > frame.width - 0.5) return false;
  const s = column - i;
  const t = Math.min(1, row - j);
  let [u, v, weight] = [0, 0, 0];
  for (let corner = 0; corner < 4; ++corner) {
    const at = (j + (corner >> 1)) * frame.width + i + (corner & 1);
    if (!inside[at]) continue;
    const fraction = (corner & 1 ? s : 1 - s) * (corner >> 1 ? t : 1 - t);
    u += fraction * grid.u[at];
    v += fraction * grid.v[at];
    weight += fraction;
  }
  const speed = Math.hypot(u, v);
  way[0] = u / speed;
  way[1] = v / speed;
  return weight > 0.4 && speed > 0;
}

/** Radians: what winds round and round beside a cell off the axis would be a blot. */
const mostTurns = 2.2 * Math.PI;

function follow(grid: Grid, start: [number, number], sense: 1 | -1): [number, number][] {
  const step = (0.8 * sense) / grid.frame.pixels_per_um;
  const line: [number, number][] = [start];
  let [x, r] = start;
  let [turned, u, v] = [0, 0, 0];
  for (let k = 0; k < 1000 && Math.abs(turned) < mostTurns; ++k) {
    if (!look(grid, x, r) || !look(grid, x + 0.5 * step * grid.way[0], r + 0.5 * step * grid.way[1])) break;
    turned += Math.atan2(u * grid.way[1] - v * grid.way[0], u * grid.way[0] + v * grid.way[1]);
    [u, v] = grid.way;
    x += step * grid.way[0];
    r += step * grid.way[1];
    if (grid.frame.low_um === 0) r = Math.abs(r);
    if (k % 3 === 2) line.push([x, r]);
  }
  return line;
}

/** Starting points at equal distances across the channel, at both ends of what is seen and beside the cell. */
function seeds(frame: Frame, radius_um: number): [number, number][] {
  const right = frame.left_um + frame.width / frame.pixels_per_um;
  const margin = 2 / frame.pixels_per_um;
  const above = [0.06, 0.19, 0.32, 0.45, 0.56, 0.72, 0.83, 0.94].map((fraction) => fraction * radius_um);
  const across = frame.low_um < 0 ? [...above, ...above.map((r) => -r)] : above;
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

/** Streamlines between two places along the channel: of the upper half, if the fields are of it alone. */
export function streamlines(fields: Fields, left_um: number, right_um: number, radius_um: number): Streamline[] {
  const ends_um = extentOf(fields);
  const [from_um, to_um] = [Math.max(left_um, ends_um[0]), Math.min(right_um, ends_um[1])];
  const pixels_per_um = 1 / spacing_um(radius_um);
  const size = (length: number) => Math.max(2, Math.round(length * pixels_per_um));
  const low_um = fields.whole ? -radius_um : 0;
  const frame = { width: size(to_um - from_um), height: size(radius_um - low_um), left_um: from_um, low_um, pixels_per_um };
  const grid = velocityGrid(fields, frame);
  if (!grid) return [];
  const middle = 0.5 * (from_um + to_um);
  return seeds(frame, radius_um).flatMap((seed) => {
    if (!look(grid, seed[0], seed[1])) return [];
    const left = seed[0] < middle;
    const forwards = grid.way[0] > 0;
    if (left && !forwards) return [];
    const points = follow(grid, seed, left === forwards ? 1 : -1);
    // What turns round before the cell is drawn from the core; near the wall only what passes the cell is.
    const turns = points[points.length - 1][0] > middle;
    if (points.length < 7 || (!left && !forwards && turns)) return [];
    return [withArrow(points, left === forwards ? 1 : -1)];
  });
}
