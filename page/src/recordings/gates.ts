// Gates: limits of a feature, polygons in the plane of two features. Events count that lie within all that are on.
import { forward, type ScaleKind } from './scale';

export interface RangeGate {
  kind: 'range';
  id: number;
  on: boolean;
  feature: string;
  /** Both ends belong to the gate, as with --min and --max; null: open. */
  low: number | null;
  high: number | null;
}

/** Its edges are straight in the plot in which it was drawn: along logarithms where that axis was logarithmic. */
export interface PolygonGate {
  kind: 'polygon';
  id: number;
  on: boolean;
  x: string;
  y: string;
  xScale: ScaleKind;
  yScale: ScaleKind;
  points: [number, number][];
}

export type Gate = RangeGate | PolygonGate;
export type ColumnOf = (feature: string) => ArrayLike<number> | undefined;

export const featuresOf = (gate: Gate): string[] => (gate.kind === 'range' ? [gate.feature] : [gate.x, gate.y]);

/** The features that must be there before the gates can be applied. */
export const featuresOfGates = (gates: Gate[]): string[] => [...new Set(gates.filter((gate) => gate.on).flatMap(featuresOf))];

function applyRange(gate: RangeGate, values: ArrayLike<number>, inside: Uint8Array): void {
  const low = gate.low ?? -Infinity;
  const high = gate.high ?? Infinity;
  for (let i = 0; i < inside.length; ++i) {
    const value = values[i];
    if (!(value >= low && value <= high)) inside[i] = 0;
  }
}

interface Edge {
  x: number;
  y: number;
  slope: number;
  low: number;
  high: number;
}

/** A polygon cut into horizontal slabs, so that a point meets only the few edges of its slab. */
export class SlabbedPolygon {
  static readonly slabs = 256;
  private readonly low: number;
  private readonly high: number;
  private readonly perUnit: number;
  private readonly edges: Edge[][] = [];

  constructor(points: [number, number][]) {
    const heights = points.map(([, y]) => y);
    this.low = Math.min(...heights);
    this.high = Math.max(...heights);
    this.perUnit = SlabbedPolygon.slabs / (this.high - this.low || 1);
    for (let k = 0; k < SlabbedPolygon.slabs; ++k) this.edges.push([]);
    points.forEach((from, k) => this.add(from, points[(k + 1) % points.length]));
  }

  private slabOf(y: number): number {
    return Math.min(SlabbedPolygon.slabs - 1, Math.max(0, Math.floor((y - this.low) * this.perUnit)));
  }

  private add(from: [number, number], to: [number, number]): void {
    if (from[1] === to[1]) return;
    const [a, b] = from[1] < to[1] ? [from, to] : [to, from];
    const edge = { x: a[0], y: a[1], slope: (b[0] - a[0]) / (b[1] - a[1]), low: a[1], high: b[1] };
    for (let k = this.slabOf(a[1]); k <= this.slabOf(b[1]); ++k) this.edges[k].push(edge);
  }

  /** By the number of edges to the right (even-odd); the lower end of an edge belongs to it, the upper one does not. */
  holds(x: number, y: number): boolean {
    if (!(y >= this.low && y <= this.high)) return false;
    const edges = this.edges[this.slabOf(y)];
    let odd = false;
    for (let k = 0; k < edges.length; ++k) {
      const edge = edges[k];
      if (y >= edge.low && y < edge.high && x < edge.x + edge.slope * (y - edge.y)) odd = !odd;
    }
    return odd;
  }
}

function applyPolygon(gate: PolygonGate, xs: ArrayLike<number>, ys: ArrayLike<number>, inside: Uint8Array): void {
  const polygon = new SlabbedPolygon(gate.points.map(([x, y]) => [forward(gate.xScale, x), forward(gate.yScale, y)]));
  const logX = gate.xScale === 'log';
  const logY = gate.yScale === 'log';
  for (let i = 0; i < inside.length; ++i) {
    if (!inside[i]) continue;
    const x = logX ? Math.log10(xs[i]) : xs[i];
    const y = logY ? Math.log10(ys[i]) : ys[i];
    if (!polygon.holds(x, y)) inside[i] = 0;
  }
}

/**
 * 1 for each event within all gates that are on, null if none is on (all events count). A feature that the recording
 * does not have excludes all of its events.
 */
export function applyGates(gates: Gate[], count: number, column: ColumnOf): Uint8Array | null {
  const active = gates.filter((gate) => gate.on);
  if (active.length === 0) return null;
  const inside = new Uint8Array(count).fill(1);
  for (const gate of active) {
    const [first, second] = featuresOf(gate).map(column);
    if (first === undefined || (gate.kind === 'polygon' && second === undefined)) return inside.fill(0);
    if (gate.kind === 'range') applyRange(gate, first, inside);
    else applyPolygon(gate, first, second!, inside);
  }
  return inside;
}

/** The numbers of the events within a mask. */
export function numbersWithin(inside: Uint8Array): number[] {
  const numbers: number[] = [];
  for (let i = 0; i < inside.length; ++i) if (inside[i]) numbers.push(i);
  return numbers;
}

/** What gates say to the command line: ranges can be told, polygons cannot. */
export function gateOptions(gates: Gate[]): { options: string; polygons: number } {
  const parts: string[] = [];
  let polygons = 0;
  for (const gate of gates.filter((each) => each.on)) {
    if (gate.kind === 'polygon') {
      ++polygons;
      continue;
    }
    if (gate.low !== null) parts.push(`--min ${gate.feature}=${gate.low}`);
    if (gate.high !== null) parts.push(`--max ${gate.feature}=${gate.high}`);
  }
  return { options: parts.join(' '), polygons };
}
