// Populations: what the recordings of each condition say about its cells, one dot a session, and whether conditions differ.
import { useState } from 'preact/hooks';
import type { Population, PopulationRecording } from '../api';
import { significant } from '../draw/numbers';
import { Progress } from '../shell/Progress';
import { useStore } from '../shell/store';
import { items, recordings } from './model';
import { computePopulation, paired, population, populationRuns, stopPopulation } from './population_runs';
import { sessionsOf, dotsOf } from './condition_dots';
import { ticksOf, type Span } from './scale';
import { useSize } from './use_size';

const height = 210;
const left = 62;
const inner = { top: 10, bottom: 26 };
const widest = 150;

function Dot({ recording, x, up }: { recording: PopulationRecording; x: number; up: (value: number) => number }) {
  const { value, lower, upper } = recording.population!.median_young_modulus_kPa;
  const fits = recording.checks.every((check) => check.fits);
  const said = `${recording.recording.split('/').pop()}: ${significant(value)} kPa${fits ? '' : ', does not fit'}`;
  return (
    <g class={fits ? 'session' : 'session misfit'}>
      <title>{said}</title>
      {lower !== null && upper !== null && <path d={`M${x} ${up(lower)}V${up(upper)}`} />}
      <circle cx={x} cy={up(value)} r={4} />
    </g>
  );
}

function Plot({ found, room }: { found: Population; room: number }) {
  const { dots, span, slots } = dotsOf(found);
  const slot = Math.min(widest, (room - left) / Math.max(1, slots));
  const up = (value: number) => height - inner.bottom - ((value - span.low) / (span.high - span.low)) * (height - inner.top - inner.bottom);
  return (
    <svg class="populations-plot" width={left + slot * slots + 8} height={height} role="img" aria-label="Median Young's modulus of each recording, by condition">
      <Axis span={span} up={up} right={left + slot * slots} />
      {found.conditions.map(({ name, median_young_modulus_kPa: mean }, k) => {
        const x = left + slot * (k + 0.86);
        return (
          <g key={name}>
            <text x={left + slot * (k + 0.5)} y={height - 8} text-anchor="middle">
              {name}
            </text>
            {mean && (
              <g class="condition-mean">
                {mean.lower !== null && mean.upper !== null && <path d={`M${x} ${up(mean.lower)}V${up(mean.upper)}`} />}
                <rect x={-4} y={-4} width={8} height={8} transform={`translate(${x} ${up(mean.value)}) rotate(45)`} />
              </g>
            )}
          </g>
        );
      })}
      {dots.map(({ recording, place }) => (
        <Dot key={recording.recording} recording={recording} x={left + slot * place} up={up} />
      ))}
    </svg>
  );
}

function Axis({ span, up, right }: { span: Span; up: (value: number) => number; right: number }) {
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
        Median E, kPa
      </text>
    </g>
  );
}

function interval(value: { lower: number | null; upper: number | null } | undefined): string {
  return value && value.lower !== null && value.upper !== null ? `${significant(value.lower, 3)} to ${significant(value.upper, 3)}` : '–';
}

function Table({ found }: { found: Population }) {
  return (
    <table class="conditions">
      <caption class="hidden">Populations by condition</caption>
      <thead>
        <tr>
          <th scope="col">Condition</th>
          <th scope="col">Median E</th>
          <th scope="col">95 % interval</th>
          <th scope="col">p</th>
        </tr>
      </thead>
      <tbody>
        {found.conditions.map(({ name, median_young_modulus_kPa: mean }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td>{mean ? `${significant(mean.value, 3)} kPa` : '–'}</td>
            <td>{interval(mean)}</td>
            <td />
          </tr>
        ))}
        {found.comparisons.map(({ control, treated, ratio, ratio_by_sampling_alone: sampling, p }) => (
          <tr key={treated} class="comparison">
            <th scope="row">{`${treated} / ${control}`}</th>
            <td>{significant(ratio.value, 3)}</td>
            <td>{p === null ? `${interval(sampling)} *` : interval(ratio)}</td>
            <td>{p === null ? 'none' : significant(p, 2)}</td>
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
    </div>
  );
}

export function Populations() {
  const found = useStore(population);
  const { element, width } = useSize<HTMLDivElement>();
  const [open, setOpen] = useState(false);
  return (
    <div class="distributions populations">
      <div class="distribution-plot" ref={element} tabIndex={0} role="region" aria-label="Populations by condition">
        {found ? (
          <Plot found={found.record} room={width} />
        ) : (
          <p class="soft">
            Name conditions and replicates in the list; the distributions of radius and modulus of the cells of each recording are then
            fitted to areas and asymmetries, and conditions are compared by their recordings.
          </p>
        )}
      </div>
      <div class="distribution-notes">
        <Start />
        {found && <Table found={found.record} />}
        {found?.record.comparisons.some(({ p }) => p === null) && (
          <p class="soft">* By sampling alone: a single recording does not tell how recordings scatter.</p>
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
