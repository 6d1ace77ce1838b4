// Conditions by their recordings: of moduli what is to be reported first, then the feature that is shown.
import type { Item } from '../api';
import { significant } from '../draw/numbers';
import { useStore } from '../shell/store';
import { statisticsOf } from './analysis';
import { isYoungModulus, labelOf, nameOf, unitOf } from './features';
import { gates } from './model';
import { meanRecommended, recommendedOf } from './recommended';
import { reports } from './reports';
import type { Interval } from './statistics';
import { byCondition } from './violins';

const rangeText = ({ low, high }: Interval): string => (Number.isFinite(low) ? `${significant(low, 3)} to ${significant(high, 3)}` : '–');

/** One mean of a condition, below its name. */
function Mean({ title, mean, unit, none }: { title: string; mean: Interval; unit: string; none?: string }) {
  return (
    <tr class="mean">
      <th scope="row">{title}</th>
      <td>{Number.isFinite(mean.value) ? `${significant(mean.value)} ${unit}` : (none ?? '–')}</td>
      <td>{rangeText(mean)}</td>
    </tr>
  );
}

/** Of the recommended moduli of a condition's recordings; says how many have none. */
export function RecommendedMean({ of, title }: { of: Item[]; title: string }) {
  const runs = useStore(reports);
  const found = of.map(({ item, replicate }) => ({ replicate, found: recommendedOf(runs[item]) }));
  const without = found.filter(({ found: one }) => !one || !Number.isFinite(one.value)).length;
  return <Mean title={title} mean={meanRecommended(found)} unit="kPa" none={`none (${without} of ${of.length} without)`} />;
}

export function Conditions({ of, feature }: { of: Item[]; feature: string }) {
  const active = useStore(gates);
  const medians = of.map((item) => ({
    condition: item.condition,
    replicate: item.replicate,
    median: statisticsOf(item, feature, active)?.median ?? NaN,
  }));
  const summaries = byCondition(medians);
  if (summaries.length === 0)
    return <p class="soft">Name conditions and replicates in the list: their means with intervals appear here.</p>;
  return (
    <table class="conditions">
      <caption class="hidden">{labelOf(feature)} by condition</caption>
      <thead>
        <tr>
          <th scope="col">Condition (recordings)</th>
          <th scope="col">Mean</th>
          <th scope="col">95 % interval</th>
        </tr>
      </thead>
      {summaries.map(({ condition, recordings, mean }) => (
        <tbody key={condition}>
          <tr>
            <th scope="rowgroup" colSpan={3} title={condition}>{`${condition} (${recordings})`}</th>
          </tr>
          {isYoungModulus(feature) && <RecommendedMean of={of.filter((item) => item.condition === condition)} title="Recommended E" />}
          <Mean title={isYoungModulus(feature) ? nameOf(feature) : 'Median'} mean={mean} unit={unitOf(feature)} />
        </tbody>
      ))}
    </table>
  );
}
