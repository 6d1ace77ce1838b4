// Distributions of a feature by recording, side by side in the order of their conditions, and each condition's mean.
import { useMemo, useState } from 'preact/hooks';
import type { Item } from '../../api';
import { useStore } from '../../shell/store';
import { maskOf } from '../analysis';
import { Conditions } from '../Conditions';
import { column, columnsVersion, wantColumns } from '../columns';
import { isYoungModulus, labelOf } from '../features';
import { items, measured, paintedGates, recordings, titleOf } from '../model';
import { distinctNames } from '../names';
import { recommendedOf } from '../recommended';
import { reports } from '../reports';
import { forward, rangeOf, ticksOf, type ScaleKind, type Span } from '../scale';
import type { Tab } from '../tab';
import { useSize } from '../use_size';
import { valuesAlong, violinCells, violinOf, type Violin } from '../violins';
import { useOrigin } from './Statistics';
import './Distributions.css';

const slots = { least: 46, greatest: 120 };
const height = 210;
const left = 62;
const right = 12;
const inner = { top: 8, bottom: 34 };
/** Where names do not fit side by side they are inclined, so far below the axis and so long, in pixels. */
const inclined = { deep: 54, long: 104 };

interface Entry {
  item: Item;
  values: Float64Array;
  /** The recommended modulus along the scale, of moduli; NaN without one. */
  recommended: number;
}

function useEntries(feature: string, scale: ScaleKind): { entries: Entry[]; span: Span } {
  const version = useStore(columnsVersion);
  const active = useStore(paintedGates);
  const all = useStore(items);
  const runs = useStore(reports);
  return useMemo(() => {
    const ready = recordings(all).filter((item) => item.state === 'ready');
    const ordered = [...ready].sort((a, b) => a.condition.localeCompare(b.condition));
    const entries = ordered.flatMap((item) => {
      wantColumns(item, [feature]);
      const values = column(item.item, feature);
      const inside = maskOf(item, active);
      if (!values || values.length === 0 || inside === undefined) return [];
      const recommended = isYoungModulus(feature) ? forward(scale, recommendedOf(runs[item.item])?.value ?? NaN) : NaN;
      return [{ item, values: valuesAlong(values, inside, scale), recommended }];
    });
    const spans = entries.filter(({ values }) => values.length > 0).map(({ values }) => rangeOf(values, 'linear'));
    const marks = entries.map(({ recommended }) => recommended).filter(Number.isFinite);
    const low = Math.min(...spans.map((span) => span.low), ...marks);
    const high = Math.max(...spans.map((span) => span.high), ...marks);
    return { entries, span: spans.length > 0 && high > low ? { low, high } : { low: 0, high: 1 } };
  }, [version, active, all, runs, feature, scale]);
}

/** Pixel of a place along the scale, above an axis that lies so deep. */
type Up = (place: number) => number;
const upAlong =
  (span: Span, bottom: number): Up =>
  (place) =>
    bottom - ((place - span.low) / (span.high - span.low)) * (bottom - inner.top);

function ViolinShape({ violin, span, up, middle, slot }: { violin: Violin; span: Span; up: Up; middle: number; slot: number }) {
  const places = Array.from(violin.outline, (width, k) => {
    const y = up(span.low + ((k + 0.5) / violinCells) * (span.high - span.low)).toFixed(1);
    return [width * 0.36 * slot, y] as const;
  }).filter(([width]) => width > 0.15);
  if (places.length === 0) return null;
  const right = places.map(([width, y]) => `${(middle + width).toFixed(1)} ${y}`);
  const back = [...places].reverse().map(([width, y]) => `${(middle - width).toFixed(1)} ${y}`);
  const { median } = violin;
  return (
    <g class="violin">
      <path class="body" d={`M${[...right, ...back].join('L')}Z`} />
      <path class="quartiles" d={`M${middle} ${up(violin.firstQuartile)}V${up(violin.thirdQuartile)}`} />
      {Number.isFinite(median.low) && (
        <path
          class="interval"
          d={[median.low, median.high].map((end) => `M${middle - 7} ${up(end).toFixed(1)}h14`).join('')}
        />
      )}
      <circle cx={middle} cy={up(median.value)} r={3.5} />
    </g>
  );
}

interface ViolinsProps {
  entries: Entry[];
  span: Span;
  scale: ScaleKind;
  feature: string;
  /** So much room there is, in pixels: all recordings share it as long as they can be told apart. */
  room: number;
}

function Violins({ entries, span, scale, feature, room }: ViolinsProps) {
  const slot = Math.max(slots.least, Math.min(slots.greatest, Math.floor((room - left - right) / entries.length)));
  const width = left + slot * entries.length + right;
  const names = distinctNames(entries.map(({ item }) => titleOf(item)));
  const deep = names.some((name) => shortened(name, slot) !== name) ? inclined.deep : 0;
  const bottom = height - inner.bottom - deep;
  const up = upAlong(span, bottom);
  const violins = useMemo(() => entries.map(({ values }) => violinOf(values, span)), [entries, span]);
  return (
    <svg class="violins" width={width} height={height} role="img" aria-label={`Distributions of ${labelOf(feature)} by recording`}>
      <g class="plot-axes">
        {ticksOf(scale, span, 4).map(({ place, label }) => (
          <g key={place} transform={`translate(${left} ${up(place).toFixed(1)})`}>
            <line x2={label ? -5 : -3} />
            <text x={-8} dy="0.32em" text-anchor="end">
              {label}
            </text>
          </g>
        ))}
        <path d={`M${left} ${inner.top}V${bottom}H${width - 4}`} fill="none" />
        <text class="plot-title" transform={`translate(13 ${(bottom + deep) / 2}) rotate(-90)`} text-anchor="middle">
          {labelOf(feature)}
        </text>
        {entries.map(({ item }, k) => (
          <text key={item.item} transform={`translate(${left + slot * (k + 0.5)} ${bottom + 16}) ${deep ? 'rotate(-40)' : ''}`} text-anchor={deep ? 'end' : 'middle'}>
            <title>{item.name}</title>
            {shortened(names[k], deep ? inclined.long : slot)}
          </text>
        ))}
        {runsOf(entries).map(({ condition, first, count }) => (
          <text key={first} class="soft" x={left + slot * (first + count / 2)} y={height - 4} text-anchor="middle">
            <title>{condition}</title>
            {shortened(condition, slot * count)}
          </text>
        ))}
      </g>
      {violins.map((violin, k) => (
        <ViolinShape key={entries[k].item.item} violin={violin} span={span} up={up} middle={left + slot * (k + 0.5)} slot={slot} />
      ))}
      {entries.map(
        ({ item, recommended }, k) =>
          Number.isFinite(recommended) && (
            <rect
              key={item.item}
              class="recommended"
              x={-4}
              y={-4}
              width={8}
              height={8}
              transform={`translate(${left + slot * (k + 0.5)} ${up(recommended).toFixed(1)}) rotate(45)`}
            />
          ),
      )}
    </svg>
  );
}

/** Recordings of a condition side by side, with room for its name below all of them. */
function runsOf(entries: Entry[]): { condition: string; first: number; count: number }[] {
  const found: { condition: string; first: number; count: number }[] = [];
  entries.forEach(({ item: { condition } }, k) => {
    const last = found.at(-1);
    if (last?.condition === condition) ++last.count;
    else found.push({ condition, first: k, count: 1 });
  });
  return found.filter(({ condition }) => condition !== '');
}

/** As many letters as fit into so many pixels. */
function shortened(name: string, width: number): string {
  const most = Math.floor((width - 6) / 6.5);
  return name.length > most ? `${name.slice(0, most - 1)}…` : name;
}

function Distributions() {
  const feature = useStore(measured);
  const [scale, setScale] = useState<ScaleKind>('linear');
  const { entries, span } = useEntries(feature, scale);
  const { element, width } = useSize<HTMLDivElement>();
  const origin = useOrigin(feature);
  return (
    <div class="distributions">
      <div class="distribution-plot" ref={element} tabIndex={0} role="region" aria-label="Distributions by recording">
        {entries.length > 0 ? (
          <Violins entries={entries} span={span} scale={scale} feature={feature} room={width} />
        ) : (
          <p class="soft">No recording has this feature yet; moduli are computed on the left.</p>
        )}
      </div>
      <div class="distribution-notes">
        <label class="check">
          <input type="checkbox" checked={scale === 'log'} onChange={({ currentTarget }) => setScale(currentTarget.checked ? 'log' : 'linear')} />
          Logarithmic
        </label>
        <Conditions of={entries.map(({ item }) => item)} feature={feature} />
        {origin && <p class="soft">{origin}</p>}
        <p class="soft">
          {isYoungModulus(feature) && 'Diamond: the modulus to report. '}
          Dot: median; short lines: its 95 % interval from the ranks; bar: quartiles. Intervals of conditions: Student's t over their
          replicates, from two on.
        </p>
      </div>
    </div>
  );
}

export default { name: 'distributions', title: 'Distributions', place: 3, measures: true, Content: Distributions } satisfies Tab;
