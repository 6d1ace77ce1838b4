// Distributions of a number by recording, side by side in the order of their conditions, with the fitted medians of cells and conditions.
import { useMemo } from 'preact/hooks';
import type { Item } from '../api';
import { significant } from '../draw/numbers';
import { useStore } from '../shell/store';
import { maskOf } from './analysis';
import { column, columnsVersion, wantColumns } from './columns';
import { isRecommendable, labelOf, noValues, unitOf } from './features';
import { items, paintedGates, recordings, titleOf } from './model';
import { distinctNames } from './names';
import { inOrderOfConditions, type FittedValue, type NumberFit } from './population_fits';
import { recommendedOf } from './recommended';
import { reports } from './reports';
import { forward, ticksOf, type ScaleKind, type Span } from './scale';
import { quantiles } from './statistics';
import { useSize } from './use_size';
import { valuesAlong, violinCells, violinOf, type Violin } from './violins';

const slots = { minimum: 24, maximum: 150 };
/** For the name of one condition. */
const longestName = 120;
/** Of the picture, by the height of the window. */
const heightIn = (window: number) => Math.max(200, Math.min(320, Math.round(0.24 * window)));
const left = 56;
const right = 12;
const inner = { top: 8, bottom: 34 };
/** Where names do not fit side by side they are inclined, at most so far below the axis and so long, in pixels. */
const inclined = { deep: 54, long: 104, angle: (40 * Math.PI) / 180 };
const letter = 6.5;
const lineHeight = 14;

interface Entry {
  item: Item;
  /** None where only the median was fitted. */
  values: Float64Array;
  /** The recommended modulus along the scale, of moduli; NaN without one. */
  recommended: number;
}

function useEntries(feature: string, scale: ScaleKind, fit: NumberFit | undefined): { entries: Entry[]; span: Span } {
  const version = useStore(columnsVersion);
  const active = useStore(paintedGates);
  const all = useStore(items);
  const runs = useStore(reports);
  return useMemo(() => {
    const entries = inOrderOfConditions(recordings(all)).flatMap((item) => {
      wantColumns(item, [feature]);
      const values = column(item.item, feature);
      const inside = maskOf(item, active);
      const isThere = values !== undefined && values.length > 0 && inside !== undefined;
      if (!isThere && !fit?.medians.has(item.item)) return [];
      const recommended = isRecommendable(feature) ? forward(scale, recommendedOf(runs[item.item])?.value ?? NaN) : NaN;
      return [{ item, values: isThere ? valuesAlong(values, inside, scale) : new Float64Array(0), recommended }];
    });
    return { entries, span: spanOf(entries, scale, fit) };
  }, [version, active, all, runs, feature, scale, fit]);
}

/** Of the events 95 %, and all marks with some room: the tails of wide distributions are cut, so that medians can be compared. */
function spanOf(entries: Entry[], scale: ScaleKind, fit: NumberFit | undefined): Span {
  const spans = entries
    .filter(({ values }) => values.length > 0)
    .map(({ values }) => quantiles(values, [0.025, 0.975]))
    .map(([low, high]) => ({ low, high }));
  const fitted = [...(fit?.medians.values() ?? [])].map(({ median }) => median).concat(...(fit?.means.values() ?? []));
  const marks = [
    ...entries.map(({ recommended }) => recommended),
    ...fitted.flatMap(({ value, low, high }) => [value, low ?? value, high ?? value]).map((end) => forward(scale, end)),
  ].filter(Number.isFinite);
  const low = Math.min(...spans.map((span) => span.low), ...marks);
  const high = Math.max(...spans.map((span) => span.high), ...marks);
  if (!Number.isFinite(high - low)) return { low: 0, high: 1 };
  const room = 0.06 * (high - low) || 0.1 * Math.abs(high) || 1;
  return { low: low - room, high: high + room };
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

/** The fitted median of a recording's cells, to the right of its distribution. */
function FittedMedian({ of, feature, x, up }: { of: { recording: NumberFit['record']['recordings'][number]; median: FittedValue }; feature: string; x: number; up: Up }) {
  const { recording, median } = of;
  const fits = recording.checks.every((check) => check.fits);
  return (
    <g class={fits ? 'session' : 'session misfit'}>
      <title>{`${recording.recording.split('/').pop()}: ${significant(median.value)} ${unitOf(feature)}${fits ? '' : ', does not fit'}`}</title>
      {median.low !== null && median.high !== null && <path d={`M${x} ${up(median.low).toFixed(1)}V${up(median.high).toFixed(1)}`} />}
      <circle cx={x} cy={up(median.value)} r={3.5} />
    </g>
  );
}

/** The fitted median of a condition, behind its recordings. */
function ConditionMean({ mean: { value, low, high }, from, to, up }: { mean: FittedValue; from: number; to: number; up: Up }) {
  return (
    <g class="condition-mean">
      {low !== null && high !== null && <rect x={from} y={up(high)} width={to - from} height={up(low) - up(high)} />}
      <path d={`M${from} ${up(value).toFixed(1)}H${to}`} />
    </g>
  );
}

interface ViolinsProps {
  entries: Entry[];
  span: Span;
  scale: ScaleKind;
  feature: string;
  fit: NumberFit | undefined;
  /** Of each recording, in pixels. */
  slot: number;
}

function Violins({ entries, span, scale, feature, fit, slot }: ViolinsProps) {
  const width = left + slot * entries.length + right;
  const names = distinctNames(entries.map(({ item }) => titleOf(item)));
  const height = heightIn(window.innerHeight);
  const deep = names.some((name) => shortened(name, slot) !== name) ? Math.min(inclined.deep, Math.max(...names.map((name) => letter * name.length)) * Math.sin(inclined.angle)) : 0;
  const long = Math.min(inclined.long, (left + slot / 2) / Math.cos(inclined.angle));
  const bottom = height - inner.bottom - deep;
  const up = upAlong(span, bottom);
  const upOf: Up = (value) => up(forward(scale, value));
  const runs = runsOf(entries);
  const isWhole = runs.every(({ condition, count }) => shortened(condition, slot * count) === condition);
  const lines = (condition: string) => (isWhole ? [condition] : inTwo(condition));
  const more = isWhole ? 0 : lineHeight;
  const violins = useMemo(() => entries.map(({ values }) => violinOf(values, span)), [entries, span]);
  return (
    <svg class="violins" width={width} height={height + more} role="img" aria-label={`Distributions of ${labelOf(feature)} by recording`}>
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
        {entries.map(({ item }, k) => (
          <text key={item.item} transform={`translate(${left + slot * (k + 0.5)} ${bottom + 16}) ${deep ? 'rotate(-40)' : ''}`} text-anchor={deep ? 'end' : 'middle'}>
            <title>{item.name}</title>
            {shortened(names[k], deep ? long : slot)}
          </text>
        ))}
        {runs.map(({ condition, first, count }) => (
          <text key={first} class="soft" y={height + more - 4} text-anchor="middle">
            <title>{condition}</title>
            {lines(condition).map((line, k, all) => (
              <tspan key={k} x={left + slot * (first + count / 2)} dy={k > 0 ? lineHeight : (1 - all.length) * lineHeight}>
                {shortened(line, slot * count)}
              </tspan>
            ))}
          </text>
        ))}
      </g>
      {runs.map(({ condition, first, count }) => {
        const mean = fit?.means.get(condition);
        return mean && <ConditionMean key={first} mean={mean} from={left + slot * first + 2} to={left + slot * (first + count) - 2} up={upOf} />;
      })}
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
      {entries.map(({ item }, k) => {
        const of = fit?.medians.get(item.item);
        return of && <FittedMedian key={item.item} of={of} feature={feature} x={left + slot * (k + 0.84)} up={upOf} />;
      })}
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
  const most = Math.floor((width - 6) / letter);
  return name.length > most ? `${name.slice(0, most - 1)}…` : name;
}

/** A name in two lines, broken at the blank nearest to its middle. */
function inTwo(name: string): string[] {
  const blanks = [...name.matchAll(/ /g)].map(({ index }) => index);
  const from = (blank: number) => Math.abs(blank - name.length / 2);
  const [nearest] = blanks.sort((a, b) => from(a) - from(b));
  return nearest === undefined ? [name] : [name.slice(0, nearest), name.slice(nearest + 1)];
}

/** Slots in which the names of the conditions are whole in two lines, unless these are long. */
const minimumSlot = (entries: Entry[]) =>
  Math.max(
    slots.minimum,
    ...runsOf(entries).map(({ condition, count }) => {
      const longest = Math.max(...inTwo(condition).map((line) => line.length));
      return Math.min(longestName, letter * (longest + 1) + 6) / count;
    }),
  );

export function PopulationPlot({ feature, scale, fit }: { feature: string; scale: ScaleKind; fit: NumberFit | undefined }) {
  const { entries, span } = useEntries(feature, scale, fit);
  const { element, width } = useSize<HTMLDivElement>();
  const minimum = minimumSlot(entries);
  const slot = Math.max(minimum, Math.min(slots.maximum, Math.floor((width - left - right) / entries.length)));
  return (
    <div class="population-plot" style={{ flexBasis: `${left + minimum * entries.length + right}px` }}>
      <h3>{labelOf(feature)}</h3>
      <div class="violins-scroll" ref={element} tabIndex={0} role="region" aria-label="Distributions by recording">
        {entries.length > 0 ? <Violins entries={entries} span={span} scale={scale} feature={feature} fit={fit} slot={slot} /> : <p class="soft">{noValues}</p>}
      </div>
    </div>
  );
}
