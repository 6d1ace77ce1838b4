// Statistics of a feature by recording, over the events within the gates.
import type { Item } from '../../api';
import { significant } from '../../draw/numbers';
import { useStore } from '../../shell/store';
import { countWithin, statisticsOf } from '../analysis';
import { columnsVersion } from '../columns';
import { isComputed, isRecommendable, labelOf, noValues, recommendedName, unitOf } from '../features';
import { focus, gates, items, measured, recordings, titleOf } from '../model';
import { moduli } from '../moduli';
import { originOf } from '../origin';
import { inShort, recommendedOf } from '../recommended';
import { reports } from '../reports';
import { counted } from '../scale';
import type { Tab } from '../tab';

/** Of median, mean, SD, SE and quartiles; all of them are under the pointer. */
const digits = [4, 4, 3, 2, 3, 3];

/** Where the numbers of a feature come from, of all recordings that can be read. */
export function useOrigin(feature: string): string {
  const runs = useStore(moduli);
  const shown = recordings(useStore(items)).filter((item) => item.state === 'ready');
  const tables = new Map<number, string>();
  for (const { item } of shown) {
    const table = runs[item]?.summary?.table;
    if (typeof table === 'string') tables.set(item, table);
  }
  return originOf(feature, shown, tables);
}

/** What is to be reported of the events within the gates. */
function RecommendedCell({ item }: { item: Item }) {
  const recommended = recommendedOf(useStore(reports)[item.item]);
  return (
    <td class="recommended" title={recommended?.text}>
      {recommended ? inShort(recommended).replace(' ± ', '\n±\u00a0').replace(' ± ', '\u00a0±\u00a0') : '–'}
    </td>
  );
}

function Row({ item, feature }: { item: Item; feature: string }) {
  const active = useStore(gates);
  const focused = useStore(focus) === item.item;
  const found = statisticsOf(item, feature, active);
  const condition = [item.condition, item.replicate].filter(Boolean).join(' / ') || '–';
  const within = countWithin(item, active);
  const numbers = found && [found.median, found.mean, found.standardDeviation, found.standardError, found.firstQuartile, found.thirdQuartile];
  return (
    <tr class={focused ? 'focused' : ''} data-item={item.item}>
      <th scope="row" title={item.name}>
        {titleOf(item)}
      </th>
      <td class="text" title={condition}>
        {condition}
      </td>
      {isRecommendable(feature) && <RecommendedCell item={item} />}
      <td>{within === undefined ? '–' : counted(within)}</td>
      <td>{found ? counted(found.count) : '–'}</td>
      {(numbers ?? Array(6).fill(NaN)).map((value, k) => (
        <td key={k} title={Number.isFinite(value) ? value.toPrecision(10) : undefined}>
          {significant(value, digits[k])}
        </td>
      ))}
    </tr>
  );
}

function StatisticsTable() {
  useStore(columnsVersion);
  const feature = useStore(measured);
  const shown = recordings(useStore(items)).filter((item) => item.state === 'ready');
  const missing = isComputed(feature) && !shown.some((item) => item.features?.includes(feature));
  const unit = unitOf(feature);
  const isModulus = isRecommendable(feature);
  const isGated = useStore(gates).some((gate) => gate.on);
  const origin = useOrigin(feature);
  return (
    <div class="statistics">
      {missing && <p class="soft">{noValues}</p>}
      {origin && <p class="soft origin">{origin}</p>}
      <table>
        <caption class="hidden">{labelOf(feature)} by recording</caption>
        <thead>
          <tr>
            <th scope="col">Recording</th>
            <th scope="col" class="text">Condition</th>
            {isModulus && <th scope="col" class="two-words">{recommendedName}</th>}
            <th scope="col">Events</th>
            <th scope="col" class="two-words">With value</th>
            <th scope="col">Median</th>
            <th scope="col">Mean</th>
            <th scope="col">SD</th>
            <th scope="col" title="Standard error of the mean">SE</th>
            <th scope="col">25 %</th>
            <th scope="col">75 %</th>
          </tr>
        </thead>
        <tbody>
          {shown.map((item) => (
            <Row key={item.item} item={item} feature={feature} />
          ))}
        </tbody>
      </table>
      <p class="soft">
        {unit && `In ${unit}. `}
        {isModulus && `${recommendedName}: the number to report ± statistical error ± error shared by the events; the reason is under the pointer and on the left. `}
        {isModulus && isGated && 'It refers to the events within the gates. '}
        SE is the standard error of the mean: SD divided by the square root of the number of events.
      </p>
    </div>
  );
}

export default { name: 'statistics', title: 'Statistics', place: 1, measures: true, Content: StatisticsTable } satisfies Tab;
