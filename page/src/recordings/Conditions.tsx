// Conditions by their recordings: the recommended modulus, the medians of the events and the fitted medians of the cells, with their ratios.
import type { Item, Population } from '../api';
import { significant } from '../draw/numbers';
import { useStore } from '../shell/store';
import { statisticsOf } from './analysis';
import { columnsVersion } from './columns';
import { isRecommendable, labelOf, recommendedName, unitOf } from './features';
import { gates, items, recordings } from './model';
import { intervalOf, sessionsOf, type FittedValue, type NumberFit } from './population_fits';
import { meanRecommended, recommendedOf } from './recommended';
import { reports } from './reports';
import { byCondition } from './violins';

type Ends = { low: number | null; high: number | null };

export const rangeText = ({ low, high }: Ends): string =>
  low !== null && high !== null && Number.isFinite(low) ? `${significant(low, 3)} to ${significant(high, 3)}` : '–';

/** One number of a condition, below its name. */
function Mean({ title, mean, unit, none }: { title: string; mean: FittedValue; unit: string; none?: string }) {
  return (
    <tr class="mean">
      <th scope="row">{title}</th>
      <td class={Number.isFinite(mean.value) ? undefined : 'none'}>{Number.isFinite(mean.value) ? `${significant(mean.value)} ${unit}` : (none ?? '–')}</td>
      <td>{rangeText(mean)}</td>
    </tr>
  );
}

/** Of the recommended moduli of a condition's recordings; says how many have none. */
function RecommendedMean({ of }: { of: Item[] }) {
  const runs = useStore(reports);
  const found = of.map(({ item, replicate }) => ({ replicate, found: recommendedOf(runs[item]) }));
  const without = found.filter(({ found: one }) => !one || !Number.isFinite(one.value)).length;
  return <Mean title={recommendedName} mean={meanRecommended(found)} unit="kPa" none={`none (${without} of ${of.length} without)`} />;
}

const ofEvents = (count: number, all: number) => `Median of the events${count > 0 && count < all ? ` (${count} of ${all})` : ''}`;

export function Conditions({ feature, fit }: { feature: string; fit: NumberFit | undefined }) {
  useStore(columnsVersion);
  const active = useStore(gates);
  const all = recordings(useStore(items)).filter((item) => item.state === 'ready');
  const runs = useStore(reports);
  const medians = all.map((item) => ({
    condition: item.condition,
    replicate: item.replicate,
    median: statisticsOf(item, feature, active)?.median ?? NaN,
  }));
  const summaries = new Map(byCondition(medians).map((each) => [each.condition, each]));
  const names = [...new Set([...sessionsOf(all).map(({ name }) => name), ...(fit?.means.keys() ?? [])])];
  const isModulus = isRecommendable(feature) && all.some(({ item }) => recommendedOf(runs[item]));
  if (names.length === 0) return <p class="soft">Name conditions and replicates in the list: their means, intervals and ratios appear here.</p>;
  return (
    <table class="conditions">
      <caption class="hidden">{labelOf(feature)} by condition</caption>
      <thead>
        <tr>
          <th scope="col">Condition (recordings)</th>
          <th scope="col">Value</th>
          <th scope="col">95 % interval</th>
        </tr>
      </thead>
      {names.map((name) => {
        const own = all.filter(({ condition }) => condition === name);
        const events = summaries.get(name);
        const fitted = fit?.means.get(name);
        return (
          <tbody key={name}>
            <tr>
              <th scope="rowgroup" colSpan={3} title={name}>{`${name} (${own.length})`}</th>
            </tr>
            {isModulus && <RecommendedMean of={own} />}
            {events && (events.recordings > 0 || !fitted) && <Mean title={ofEvents(events.recordings, own.length)} mean={events.mean} unit={unitOf(feature)} />}
            {fitted && <Mean title="Median of the cells (fit)" mean={fitted} unit={unitOf(feature)} />}
          </tbody>
        );
      })}
    </table>
  );
}

function Ratio({ row }: { row: Population['comparisons'][number] }) {
  const isByRecordings = row.p !== null;
  return (
    <tr class="comparison">
      <th scope="row">{`${row.treated} / ${row.control}`}</th>
      <td>{significant(row.ratio, 3)}</td>
      <td>
        {rangeText(intervalOf(row, 'ratio', isByRecordings ? 'ratio' : 'ratio_by_sampling')!)}
        {!isByRecordings && ' *'}
      </td>
      <td>{isByRecordings ? significant(row.p!, 2) : 'none'}</td>
    </tr>
  );
}

/** Ratios of the fitted medians. */
export function Ratios({ fit: { record, quantity } }: { fit: NumberFit }) {
  const rows = record.comparisons.filter((row) => row.quantity === quantity);
  if (rows.length === 0) return null;
  return (
    <>
      <table class="conditions">
        <caption class="hidden">Ratios of conditions</caption>
        <thead>
          <tr>
            <th scope="col">Conditions</th>
            <th scope="col">Ratio (fit)</th>
            <th scope="col">95 % interval</th>
            <th scope="col">p</th>
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <Ratio key={row.treated} row={row} />
          ))}
        </tbody>
      </table>
      {rows.some(({ p }) => p === null) && (
        <p class="soft">* By sampling only: a single recording gives no scatter between recordings.</p>
      )}
    </>
  );
}
