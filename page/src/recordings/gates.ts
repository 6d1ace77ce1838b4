// Gates: limits of a feature, polygons in the plane of two features. Events count that lie within all that are on.
import { isComputed, storedModulus } from './features';
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

/** A polygon cut into horizontal slabs, so that a point meets only the few edges of its slab. */
export class SlabbedPolygon {
  static readonly slabs = 256;
  private readonly low: number;
  private readonly high: number;
  private readonly perUnit: number;
  /** Of each edge: x and y of its lower end, dx / dy, y of its upper end; slab k has those from starts[k] to starts[k + 1]. */
  private readonly edges: Float64Array;
  private readonly starts = new Uint32Array(SlabbedPolygon.slabs + 1);

  constructor(points: [number, number][]) {
    const heights = points.map(([, y]) => y);
    this.low = Math.min(...heights);
    this.high = Math.max(...heights);
    this.perUnit = SlabbedPolygon.slabs / (this.high - this.low || 1);
    const slabs: number[][] = Array.from({ length: SlabbedPolygon.slabs }, () => []);
    points.forEach((from, k) => {
      const to = points[(k + 1) % points.length];
      if (from[1] === to[1]) return;
      const [a, b] = from[1] < to[1] ? [from, to] : [to, from];
      const last = this.slabOf(b[1]);
      for (let slab = this.slabOf(a[1]); slab <= last; ++slab) slabs[slab].push(a[0], a[1], (b[0] - a[0]) / (b[1] - a[1]), b[1]);
    });
    this.edges = Float64Array.from(slabs.flat());
    slabs.forEach((edges, k) => (this.starts[k + 1] = this.starts[k] + edges.length));
  }

  private slabOf(y: number): number {
    return Math.min(SlabbedPolygon.slabs - 1, Math.max(0, Math.floor((y - this.low) * this.perUnit)));
  }

  /** By the number of edges to the right (even-odd); the lower end of an edge belongs to it, the upper one does not. */
  holds(x: number, y: number): boolean {
    if (!(y >= this.low && y <= this.high)) return false;
    const { edges, starts } = this;
    const slab = Math.min(SlabbedPolygon.slabs - 1, ((y - this.low) * this.perUnit) | 0);
    const end = starts[slab + 1];
    let odd = false;
    for (let k = starts[slab]; k < end; k += 4)
      if (y >= edges[k + 1] && y < edges[k + 3] && x < edges[k] + edges[k + 2] * (y - edges[k + 1])) odd = !odd;
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

/** The command line gates by what is in the file, under the file's own names. */
const nameInFile = (feature: string) => (feature === storedModulus ? 'emodulus' : feature);

type GateOption = ['min' | 'max' | 'polygon', string];

const rangeOptions = ({ feature, low, high }: RangeGate): GateOption[] => [
  ...(low === null ? [] : [['min', `${nameInFile(feature)}=${low}`] as GateOption]),
  ...(high === null ? [] : [['max', `${nameInFile(feature)}=${high}`] as GateOption]),
];

function polygonOption({ x, y, xScale, yScale, points }: PolygonGate): GateOption {
  const axis = (feature: string, scale: ScaleKind) => `${scale === 'log' ? 'log:' : ''}${nameInFile(feature)}`;
  return ['polygon', `${axis(x, xScale)},${axis(y, yScale)}=${points.map((point) => point.join(',')).join(':')}`];
}

const isOfResults = (gate: Gate) => featuresOf(gate).some(isComputed);

/** The gates that are on as the program has them, which has none for what it computes itself. */
const optionsOf = (gates: Gate[]): GateOption[] =>
  gates
    .filter((gate) => gate.on && !isOfResults(gate))
    .flatMap((gate) => (gate.kind === 'range' ? rangeOptions(gate) : [polygonOption(gate)]));

/** As options of the command line. */
export const gateOptions = (gates: Gate[]): string =>
  optionsOf(gates)
    .map(([name, text]) => `--${name} ${text}`)
    .join(' ');

/** As settings of the interface. */
export function gateSettings(gates: Gate[]): Record<string, string[]> {
  const settings: Record<string, string[]> = {};
  for (const [name, text] of optionsOf(gates)) (settings[name] ??= []).push(text);
  return settings;
}

/** The gates that are on and that the command line has no options for. */
export const gatesWithoutOption = (gates: Gate[]): Gate[] => gates.filter((gate) => gate.on && isOfResults(gate));
