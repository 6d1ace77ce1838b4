// Populations: what the recordings of each condition say about its cells, one dot a session, and whether conditions differ.
import { Fragment } from 'preact';
import { useState } from 'preact/hooks';
import type { Population, PopulationRecording } from '../../api';
import { significant } from '../../draw/numbers';
import { Progress } from '../../shell/Progress';
import { useStore } from '../../shell/store';
import { items, recordings } from '../model';
import { cellModel, computePopulation, doses, doseUnit, paired, population, populationRuns, stopPopulation, type CellModel } from '../population_runs';
import { dotsOf, intervalOf, sessionsOf, type Interval } from '../condition_dots';
import { RecommendedMean } from '../Conditions';
import { recommendedOf } from '../recommended';
import { reports } from '../reports';
import { ticksOf, type Span } from '../scale';
import type { Tab } from '../tab';
import { useSize } from '../use_size';
import './Populations.css';

const height = 210;
const left = 62;
const inner = { top: 10, bottom: 26 };
const widest = 150;

type Quantity = Population['quantities'][number];

function Dot({ recording, quantity, x, up }: { recording: PopulationRecording; quantity: Quantity; x: number; up: (value: number) => number }) {
  const { value, low, high } = intervalOf(recording, quantity.median)!;
  const fits = recording.checks.every((check) => check.fits);
  const said = `${recording.recording.split('/').pop()}: ${significant(value)} ${quantity.unit}${fits ? '' : ', does not fit'}`;
  return (
    <g class={fits ? 'session' : 'session misfit'}>
      <title>{said}</title>
      {low !== null && high !== null && <path d={`M${x} ${up(low)}V${up(high)}`} />}
      <circle cx={x} cy={up(value)} r={4} />
    </g>
  );
}

function Plot({ found, quantity, room }: { found: Population; quantity: Quantity; room: number }) {
  const { dots, span, slots } = dotsOf(found, quantity.median);
  const slot = Math.min(widest, (room - left) / Math.max(1, slots));
  const up = (value: number) => height - inner.bottom - ((value - span.low) / (span.high - span.low)) * (height - inner.top - inner.bottom);
  return (
    <svg class="populations-plot" width={left + slot * slots + 8} height={height} role="img" aria-label={`Median ${quantity.symbol} of each recording, by condition`}>
      <Axis span={span} up={up} right={left + slot * slots} title={`Median ${quantity.symbol}, ${quantity.unit}`} />
      {found.conditions.map((row, k) => {
        const { condition: name } = row;
        const mean = intervalOf(row, quantity.median);
        const x = left + slot * (k + 0.86);
        return (
          <g key={name}>
            <text x={left + slot * (k + 0.5)} y={height - 8} text-anchor="middle">
              {name}
            </text>
            {mean && (
              <g class="condition-mean">
                {mean.low !== null && mean.high !== null && <path d={`M${x} ${up(mean.low)}V${up(mean.high)}`} />}
                <rect x={-4} y={-4} width={8} height={8} transform={`translate(${x} ${up(mean.value)}) rotate(45)`} />
              </g>
            )}
          </g>
        );
      })}
      {dots.map(({ recording, place }) => (
        <Dot key={recording.recording} recording={recording} quantity={quantity} x={left + slot * place} up={up} />
      ))}
    </svg>
  );
}

function Axis({ span, up, right, title }: { span: Span; up: (value: number) => number; right: number; title: string }) {
  return (
    <g class="plot-axes">
      {ticksOf('linear', span, 4).map(({ place, label }) => (
        <g key={place} transform={`translate(${left} ${up(place).toFixed(1)})`}>
          <line x2={-5} />
          <text x={-8} dy="0.32em" text-anchor="end">
            {label}
          </text>
        </g>
      ))}
      <path d={`M${left} ${inner.top}V${height - inner.bottom}H${right}`} fill="none" />
      <text class="plot-title" transform={`translate(13 ${(height - inner.bottom) / 2}) rotate(-90)`} text-anchor="middle">
        {title}
      </text>
    </g>
  );
}

function interval(value: Interval | undefined): string {
  return value && value.low !== null && value.high !== null ? `${significant(value.low, 3)} to ${significant(value.high, 3)}` : '–';
}

function Table({ found, quantity: { quantity, median, symbol, unit } }: { found: Population; quantity: Quantity }) {
  const all = recordings(useStore(items)).filter((item) => item.state === 'ready');
  const runs = useStore(reports);
  const isModulus = quantity === 'young_modulus' && all.some(({ item }) => recommendedOf(runs[item]));
  return (
    <table class="conditions">
      <caption class="hidden">Populations by condition</caption>
      <thead>
        <tr>
          <th scope="col">Condition</th>
          <th scope="col">{`Median ${symbol}`}</th>
          <th scope="col">95 % interval</th>
          <th scope="col">p</th>
        </tr>
      </thead>
      <tbody>
        {found.conditions.map((row) => {
          const mean = intervalOf(row, median);
          return (
            <Fragment key={row.condition}>
              <tr>
                <th scope="row">{row.condition}</th>
                <td>{mean ? `${significant(mean.value, 3)} ${unit}` : '–'}</td>
                <td>{interval(mean)}</td>
                <td />
              </tr>
              {isModulus && <RecommendedMean of={all.filter((item) => item.condition === row.condition)} title="Recommended E" />}
            </Fragment>
          );
        })}
        {found.comparisons.filter((row) => row.quantity === quantity).map((row) => (
          <tr key={row.treated} class="comparison">
            <th scope="row">{`${row.treated} / ${row.control}`}</th>
            <td>{significant(row.ratio, 3)}</td>
            <td>{row.p === null ? `${interval(intervalOf(row, 'ratio', 'ratio_by_sampling'))} *` : interval(intervalOf(row, 'ratio'))}</td>
            <td>{row.p === null ? 'none' : significant(row.p, 2)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Start() {
  const all = recordings(useStore(items));
  const running = useStore(populationRuns);
  const wantsPairs = useStore(paired);
  const model = useStore(cellModel);
  const conditions = sessionsOf(all);
  if (running) return <Progress label="Fitting populations" onStop={stopPopulation} />;
  return (
    <div class="row">
      <button class="primary" disabled={conditions.length === 0} onClick={() => void computePopulation()}>
        Fit populations
      </button>
      <label class="check" title="Recordings of one replicate are of one day or chip">
        <input type="checkbox" checked={wantsPairs} onChange={({ currentTarget }) => paired.set(currentTarget.checked)} />
        Replicates are pairs
      </label>
      <label class="row" title="Effective modulus: real cells, by area, deformation and inertia ratio. Bulk and cortex: by the whole outline">
        Cells
        <select value={model} onChange={({ currentTarget }) => cellModel.set(currentTarget.value as CellModel)}>
          <option value="">By their shapes</option>
          <option value="solid">Solids</option>
          <option value="effective">Effective modulus</option>
          <option value="cortex">Bulk and cortex</option>
        </select>
      </label>
    </div>
  );
}

/** A dose of each condition, for the trend and the EC50. */
function Doses() {
  const conditions = sessionsOf(recordings(useStore(items)));
  const given = useStore(doses);
  const unit = useStore(doseUnit);
  if (conditions.length < 2) return null;
  return (
    <details class="doses">
      <summary>Doses of the conditions</summary>
      {conditions.map(({ name }, k) => (
        <label key={name} class="row">
          <span>{name}</span>
          <input
            class="number"
            type="number"
            min={0}
            step="any"
            placeholder={k === 0 ? '0' : ''}
            value={given[name] ?? ''}
            onChange={({ currentTarget }) => doses.set({ ...doses.get(), [name]: currentTarget.value })}
          />
        </label>
      ))}
      <label class="row">
        <span>Unit</span>
        <input type="text" maxLength={20} value={unit} placeholder="ug/ml" onChange={({ currentTarget }) => doseUnit.set(currentTarget.value)} />
      </label>
    </details>
  );
}

/** Trend and EC50 of the quantity that is shown. */
function DoseResponse({ found, quantity }: { found: Population; quantity: string }) {
  const row = found.dose_responses?.find((each) => each.quantity === quantity);
  if (!row) return null;
  const unit = found.doses?.unit ? ` ${found.doses.unit}` : '';
  const ec50 = intervalOf(row, 'ec50');
  const trend = intervalOf(row, 'ratio_per_decade');
  return (
    <p class="dose-response">
      {trend && `Ratio ${significant(trend.value, 3)} for ten times the dose (${interval(trend)})`}
      {row.p_of_trend !== null && `, p ${significant(row.p_of_trend, 2)}`}
      {ec50 && `; EC50 ${significant(ec50.value, 2)}${unit} (${interval(ec50)})`}
    </p>
  );
}

function Populations() {
  const found = useStore(population);
  const { element, width } = useSize<HTMLDivElement>();
  const [open, setOpen] = useState(false);
  const [chosen, choose] = useState('');
  const quantities = found?.record.quantities ?? [];
  const quantity = quantities.find((each) => each.quantity === chosen) ?? quantities[0];
  return (
    <div class="distributions populations">
      <div class="distribution-plot" ref={element} tabIndex={0} role="region" aria-label="Populations by condition">
        {found && quantity ? (
          <Plot found={found.record} quantity={quantity} room={width} />
        ) : (
          <p class="soft">
            Name conditions and replicates in the list. Each recording then has the modulus of its cells: that of solids, or the effective
            modulus of cells that are longer than the flow makes them. Conditions are compared by their recordings.
          </p>
        )}
      </div>
      <div class="distribution-notes">
        <Start />
        <Doses />
        {quantities.length > 1 && (
          <label class="row">
            Shown
            <select value={quantity?.quantity} onChange={({ currentTarget }) => choose(currentTarget.value)}>
              {quantities.map((each) => (
                <option key={each.quantity} value={each.quantity}>
                  {each.symbol}
                </option>
              ))}
            </select>
          </label>
        )}
        {found && quantity && <Table found={found.record} quantity={quantity} />}
        {found && quantity && <DoseResponse found={found.record} quantity={quantity.quantity} />}
        {found?.record.comparisons.some(({ p }) => p === null) && (
          <p class="soft">* By sampling alone: a single recording gives no scatter between recordings.</p>
        )}
        {found && (
          <details open={open} onToggle={({ currentTarget }) => setOpen(currentTarget.open)}>
            <summary>In words, and as a command</summary>
            <ul class="remarks">
              {found.lines.map((line) => (
                <li key={line}>{line}</li>
              ))}
            </ul>
            <code tabIndex={0}>{found.command}</code>
          </details>
        )}
        <p class="soft">Dot: a recording with its 95 % interval, open where the checks do not hold; diamond: the condition, by the scatter of its recordings.</p>
      </div>
    </div>
  );
}

export default { name: 'populations', title: 'Populations', place: 4, Content: Populations } satisfies Tab;
