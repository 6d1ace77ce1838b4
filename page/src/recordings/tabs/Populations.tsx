// Populations: how a number is distributed in each recording, what it is in each condition, and whether conditions differ.
import { useMemo, useState } from 'preact/hooks';
import { significant } from '../../draw/numbers';
import { Progress } from '../../shell/Progress';
import { useStore } from '../../shell/store';
import { Conditions, Ratios, rangeText } from '../Conditions';
import { isRecommendable } from '../features';
import { items, measured, recordings } from '../model';
import { PopulationPlot } from '../PopulationPlot';
import { fitOf, intervalOf, sessionsOf, type NumberFit } from '../population_fits';
import { cellModel, computePopulation, doses, doseUnit, paired, population, populationRuns, stopPopulation, type CellModel } from '../population_runs';
import type { ScaleKind } from '../scale';
import type { Tab } from '../tab';
import { useOrigin } from './Statistics';
import './Populations.css';

function Start() {
  const all = recordings(useStore(items));
  const running = useStore(populationRuns);
  const wantsPairs = useStore(paired);
  const model = useStore(cellModel);
  const conditions = sessionsOf(all);
  if (running) return <Progress label="Fitting populations" onStop={stopPopulation} />;
  return (
    <>
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
    </>
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

/** Trend and EC50 of the number that is shown. */
function DoseResponse({ fit: { record, quantity } }: { fit: NumberFit }) {
  const row = record.dose_responses?.find((each) => each.quantity === quantity);
  if (!row) return null;
  const unit = record.doses?.unit ? ` ${record.doses.unit}` : '';
  const ec50 = intervalOf(row, 'ec50');
  const trend = intervalOf(row, 'ratio_per_decade');
  return (
    <p class="dose-response">
      {trend && `Ratio ${significant(trend.value, 3)} for ten times the dose (${rangeText(trend)})`}
      {row.p_of_trend !== null && `, p ${significant(row.p_of_trend, 2)}`}
      {ec50 && `; EC50 ${significant(ec50.value, 2)}${unit} (${rangeText(ec50)})`}
    </p>
  );
}

/** The fit in the program's words, and as a command. */
function Words() {
  const found = useStore(population);
  const [open, setOpen] = useState(false);
  if (!found) return null;
  return (
    <details open={open} onToggle={({ currentTarget }) => setOpen(currentTarget.open)}>
      <summary>In words, and as a command</summary>
      <ul class="remarks">
        {found.lines.map((line) => (
          <li key={line}>{line}</li>
        ))}
      </ul>
      <code tabIndex={0}>{found.command}</code>
    </details>
  );
}

function Legend({ feature, isFitted }: { feature: string; isFitted: boolean }) {
  return (
    <p class="soft">
      {isRecommendable(feature) && 'Diamond: recommended modulus. '}
      Circle: median of the events; short lines: its 95 % interval from the ranks; bar: quartiles; the axis shows the central 95 % of the events. Intervals of conditions: Student's t over their
      replicates, from two on.
      {isFitted &&
        ' Dot: median of the cells (fit) with its 95 % interval, open if the checks fail; line and band: that of the condition, by the scatter of its recordings.'}
    </p>
  );
}

function Populations() {
  const feature = useStore(measured);
  const found = useStore(population);
  const [scale, setScale] = useState<ScaleKind>('linear');
  const fit = useMemo(() => (found ? fitOf(found.record, found.fitted, feature) : undefined), [found, feature]);
  const origin = useOrigin(feature);
  return (
    <div class="populations">
      <div class="row population-start">
        <Start />
        <label class="check">
          <input type="checkbox" checked={scale === 'log'} onChange={({ currentTarget }) => setScale(currentTarget.checked ? 'log' : 'linear')} />
          Logarithmic
        </label>
      </div>
      <PopulationPlot feature={feature} scale={scale} fit={fit} />
      <div class="population-notes">
        <Doses />
        <Conditions feature={feature} fit={fit} />
        {fit && <Ratios fit={fit} />}
        {fit && <DoseResponse fit={fit} />}
        <Words />
        {!found && (
          <p class="soft">
            The fit gives each recording the modulus of its cells: Young's modulus of solids, or the effective modulus of cells that are longer
            than the flow makes them. Conditions are compared by their recordings.
          </p>
        )}
        {origin && <p class="soft">{origin}</p>}
        <Legend feature={feature} isFitted={fit !== undefined} />
      </div>
    </div>
  );
}

export default { name: 'populations', former: 'distributions', title: 'Populations', place: 3, measures: true, Content: Populations } satisfies Tab;
