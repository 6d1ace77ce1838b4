// Distributions of a feature by recording, side by side in the order of their conditions, and each condition's mean.
import { useMemo, useState } from 'preact/hooks';
import type { Item } from '../api';
import { significant } from '../draw/numbers';
import { useStore } from '../shell/store';
import { maskOf, statisticsOf } from './analysis';
import { column, columnsVersion, wantColumns } from './columns';
import { labelOf, unitOf } from './features';
import { gates, items, measured, paintedGates, recordings, titleOf } from './model';
import { distinctNames } from './names';
import { rangeOf, ticksOf, type ScaleKind, type Span } from './scale';
import { useOrigin } from './StatisticsTable';
import { useSize } from './use_size';
import { byCondition, valuesAlong, violinCells, violinOf, type Violin } from './violins';

const slots = { least: 46, greatest: 92 };
const height = 210;
const left = 62;
const right = 12;
const inner = { top: 8, bottom: 34 };

interface Entry {
  item: Item;
  values: Float64Array;
}

function useEntries(feature: string, scale: ScaleKind): { entries: Entry[]; span: Span } {
  const version = useStore(columnsVersion);
  const active = useStore(paintedGates);
  const all = useStore(items);
  return useMemo(() => {
    const ready = recordings(all).filter((item) => item.state === 'ready');
    const ordered = [...ready].sort((a, b) => a.condition.localeCompare(b.condition));
    const entries = ordered.flatMap((item) => {
      wantColumns(item, [feature]);
      const values = column(item.item, feature);
      const inside = maskOf(item, active);
      if (!values || values.length === 0 || inside === undefined) return [];
      return [{ item, values: valuesAlong(values, inside, scale) }];
    });
    const spans = entries.filter(({ values }) => values.length > 0).map(({ values }) => rangeOf(values, 'linear'));
    const low = Math.min(...spans.map((span) => span.low));
    const high = Math.max(...spans.map((span) => span.high));
    return { entries, span: spans.length > 0 && high > low ? { low, high } : { low: 0, high: 1 } };
  }, [version, active, all, feature, scale]);
}

const up = (span: Span, place: number) =>
  height - inner.bottom - ((place - span.low) / (span.high - span.low)) * (height - inner.top - inner.bottom);

function ViolinShape({ violin, span, middle, slot }: { violin: Violin; span: Span; middle: number; slot: number }) {
  const places = Array.from(violin.outline, (width, k) => {
    const y = up(span, span.low + ((k + 0.5) / violinCells) * (span.high - span.low)).toFixed(1);
    return [width * 0.36 * slot, y] as const;
  }).filter(([width]) => width > 0.15);
  if (places.length === 0) return null;
  const right = places.map(([width, y]) => `${(middle + width).toFixed(1)} ${y}`);
  const back = [...places].reverse().map(([width, y]) => `${(middle - width).toFixed(1)} ${y}`);
  const { median } = violin;
  return (
    <g class="violin">
      <path class="body" d={`M${[...right, ...back].join('L')}Z`} />
      <path class="quartiles" d={`M${middle} ${up(span, violin.firstQuartile)}V${up(span, violin.thirdQuartile)}`} />
      {Number.isFinite(median.low) && (
        <path
          class="interval"
          d={[median.low, median.high].map((end) => `M${middle - 7} ${up(span, end).toFixed(1)}h14`).join('')}
        />
      )}
      <circle cx={middle} cy={up(span, median.value)} r={3.5} />
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
  const violins = useMemo(() => entries.map(({ values }) => violinOf(values, span)), [entries, span]);
  return (
    <svg class="violins" width={width} height={height} role="img" aria-label={`Distributions of ${labelOf(feature)} by recording`}>
      <g class="plot-axes">
        {ticksOf(scale, span, 4).map(({ place, label }) => (
          <g key={place} transform={`translate(${left} ${up(span, place).toFixed(1)})`}>
            <line x2={label ? -5 : -3} />
            <text x={-8} dy="0.32em" text-anchor="end">
              {label}
            </text>
          </g>
        ))}
        <path d={`M${left} ${inner.top}V${height - inner.bottom}H${width - 4}`} fill="none" />
        <text class="plot-title" transform={`translate(13 ${(height - inner.bottom) / 2}) rotate(-90)`} text-anchor="middle">
          {labelOf(feature)}
        </text>
        {entries.map(({ item }, k) => (
          <text key={item.item} x={left + slot * (k + 0.5)} y={height - 18} text-anchor="middle">
            <title>{item.name}</title>
            {shortened(names[k], slot)}
            <tspan class="soft" x={left + slot * (k + 0.5)} dy={14}>
              {shortened(item.condition, slot)}
            </tspan>
          </text>
        ))}
      </g>
      {violins.map((violin, k) => (
        <ViolinShape key={entries[k].item.item} violin={violin} span={span} middle={left + slot * (k + 0.5)} slot={slot} />
      ))}
    </svg>
  );
}

/** As many letters as fit into the width of a violin, in pixels. */
function shortened(name: string, width: number): string {
  const most = Math.floor((width - 10) / 7.5);
  return name.length > most ? `${name.slice(0, most - 1)}…` : name;
}

function Conditions({ entries, feature }: { entries: Entry[]; feature: string }) {
  const active = useStore(gates);
  const found = entries.map(({ item }) => ({
    condition: item.condition,
    replicate: item.replicate,
    median: statisticsOf(item, feature, active)?.median ?? NaN,
  }));
  const summaries = byCondition(found);
  if (summaries.length === 0)
    return <p class="soft">Name conditions and replicates in the list: their means with intervals appear here.</p>;
  return (
    <table class="conditions">
      <caption class="hidden">{labelOf(feature)} by condition</caption>
      <thead>
        <tr>
          <th scope="col">Condition</th>
          <th scope="col">Recordings</th>
          <th scope="col">Mean of medians</th>
          <th scope="col">95 % interval</th>
        </tr>
      </thead>
      <tbody>
        {summaries.map(({ condition, recordings: count, mean }) => (
          <tr key={condition}>
            <th scope="row">{condition}</th>
            <td>{count}</td>
            <td>
              {significant(mean.value)} {unitOf(feature)}
            </td>
            <td>{Number.isFinite(mean.low) ? `${significant(mean.low, 3)} to ${significant(mean.high, 3)}` : '–'}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function Distributions() {
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
        <Conditions entries={entries} feature={feature} />
        {origin && <p class="soft">{origin}</p>}
        <p class="soft">
          Dot: median; short lines: its 95 % interval from the ranks; bar: quartiles. Intervals of conditions: Student's t over their
          replicates, from two on.
        </p>
      </div>
    </div>
  );
}
