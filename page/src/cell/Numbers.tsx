// The numbers at the right, each with its estimated error. Places stay where they are while the digits change.
import type { TimeStep } from '../api';
import { significant } from '../draw/numbers';
import { useStore } from '../shell/store';
import { Influences } from './Influences';
import * as model from './model';
import { run } from './time';

interface Row {
  title: string;
  value: string;
  unit: string;
  error: string | null;
  lead?: boolean;
}

const power = (value: number) => value.toExponential(0).replace('e', ' × 10^');

/** The error that the program states beside a number of result.json; null where it states none. */
function errorOf({ state }: model.Solved, name: string): string | null {
  const error = state.errors[name];
  return error ? power(error) : null;
}

function rowsOf(solved: model.Solved): Row[] {
  const { state } = solved;
  const error = (name: string) => errorOf(solved, name);
  return [
    { title: 'Deformation', value: state.deformation.toFixed(5), unit: '', error: error('deformation'), lead: true },
    { title: 'Area', value: significant(state.area_um2, 5), unit: 'µm²', error: error('area_um2') },
    { title: 'Cell velocity', value: significant(state.cell_velocity_m_per_s), unit: 'm/s', error: error('cell_velocity_m_per_s') },
    { title: 'Pressure drop', value: significant(state.pressure_drop_Pa), unit: 'Pa', error: error('pressure_drop_Pa') },
    ...asideRows(solved),
  ];
}

/** Of a cell off the axis: where it is and whither it drifts. */
function asideRows({ state }: model.Solved): Row[] {
  const { offset_um: offset, drift_velocity_m_per_s: drift, errors } = state;
  if (typeof offset !== 'number') return [];
  const rows: Row[] = [{ title: 'Off the axis', value: significant(offset), unit: 'µm', error: errors.offset_um ? power(errors.offset_um) : null }];
  if (typeof drift === 'number') {
    const error = errors.drift_velocity_m_per_s;
    rows.push({ title: 'Drift', value: significant(drift), unit: 'm/s', error: error ? power(error) : null });
  }
  return rows;
}

function stepRows({ deformation, deformation_across, offset_um, time_s, x_um, velocity_m_per_s }: TimeStep): Row[] {
  const row = (title: string, value: string, unit = '') => ({ title, value, unit, error: null });
  return [
    { ...row('Deformation', deformation.toFixed(5)), lead: true },
    ...(deformation_across === undefined ? [] : [row('Along the width', deformation_across.toFixed(5))]),
    row('Time', (1e6 * time_s).toFixed(1), 'µs'),
    row('Place', x_um.toFixed(2), 'µm'),
    ...(offset_um === undefined ? [] : [row('Off the axis', offset_um.toFixed(2), 'µm')]),
    row('Cell velocity', significant(velocity_m_per_s), 'm/s'),
  ];
}

const powers = '⁰¹²³⁴⁵⁶⁷⁸⁹';
const raised = (text: string) =>
  text.replace(/10\^([+-]?)(\d+)/, (_, sign: string, digits: string) => `10${sign === '-' ? '⁻' : ''}${[...digits].map((d) => powers[+d]).join('')}`);

function Measure({ row }: { row: Row }) {
  return (
    <div class={row.lead ? 'measure lead' : 'measure'} data-measure={row.title}>
      <dt>{row.title}</dt>
      <dd>
        <span class="value">{row.value}</span> <span class="unit">{row.unit}</span>
        <span class="error">{row.error === null ? '' : `± ${raised(row.error)}`}</span>
      </dd>
    </div>
  );
}

/** How far the surface is from wrinkling: 1 at rest, 0 where smooth shapes end. */
function Margin({ solved }: { solved: model.Solved }) {
  const margin = solved.state.stability_margin;
  const low = margin !== null && margin < 0.1;
  const error = errorOf(solved, 'stability_margin');
  return (
    <div class="measure margin" data-measure="Margin">
      <dt>Margin to the instability</dt>
      <dd>
        <span class="value">{margin === null ? '–' : margin.toFixed(3)}</span>
        <span class="error">{low ? 'the surface is about to wrinkle' : error && `± ${raised(error)}`}</span>
        <meter min={0} max={1} low={0.1} optimum={1} value={Math.max(0, margin ?? 0)} aria-label="Margin to the instability" />
      </dd>
    </div>
  );
}

function Accuracy({ solved }: { solved: model.Solved }) {
  const working = useStore(model.working);
  const relative = solved.state.estimated_error;
  const text = working === 'idle' ? 'as accurate as requested' : working === 'refining' ? 'refining' : 'solving';
  return (
    <div class="measure accuracy">
      <dt>Relative error of the deformation, estimated</dt>
      <dd>
        <span class="value">{relative === null ? '–' : `${significant(100 * relative, 2)} %`}</span>
        <span class="error">{solved.final && working === 'idle' ? text : `${text} …`}</span>
      </dd>
    </div>
  );
}

export function Numbers() {
  const solved = useStore(model.solved);
  const refused = useStore(model.refused);
  const time = useStore(run);
  const step = time?.steps[time.shown];
  if (step) {
    return (
      <dl class="numbers">
        {stepRows(step).map((row) => (
          <Measure key={row.title} row={row} />
        ))}
      </dl>
    );
  }
  if (!solved) return <dl class="numbers" />;
  return (
    <>
      <dl class={refused ? 'numbers stale' : 'numbers'}>
        {rowsOf(solved).map((row) => (
          <Measure key={row.title} row={row} />
        ))}
        <Margin solved={solved} />
        <Accuracy solved={solved} />
      </dl>
      <Influences />
    </>
  );
}
