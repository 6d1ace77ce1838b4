// The recordings: conditions, names of condition and replicate, what became of their events, or why they cannot be read.
import type { Item } from '../api';
import { significant } from '../draw/numbers';
import { useStore } from '../shell/store';
import { TypedInput } from '../shell/TypedInput';
import { countWithin } from './analysis';
import { columnsVersion } from './columns';
import { hasModulus, meaningOf, states } from './features';
import { focus, gates, items, recordings, rename, titleOf } from './model';
import { moduli } from './moduli';
import { counted } from './scale';

/** "20 µm · 0.04 µl/s · CellCarrier · 23 °C" */
function conditionsOf(item: Item): string {
  const given = item.conditions ?? {};
  const number = (name: string, unit: string) =>
    typeof given[name] === 'number' ? `${Number((given[name] as number).toPrecision(4))} ${unit}` : '';
  return [
    number('channel_width_um', 'µm'),
    number('flow_rate_ul_s', 'µl/s'),
    typeof given.medium === 'string' ? given.medium : '',
    number('temperature_C', '°C'),
  ]
    .filter((text) => text !== '')
    .join(' · ');
}

/** Events by the state of their modulus, from the summary or the list itself. */
function countsOf(item: Item, summary: Record<string, unknown> | undefined): [string, number][] {
  const own = (item as { counts?: Record<string, number> }).counts ?? {};
  return states
    .map(([state]): [string, number] => [state, Number(summary?.[state.replace(/ /g, '_')] ?? own[state] ?? 0)])
    .filter(([, count]) => count > 0);
}

function StateCounts({ item }: { item: Item }) {
  const summary = useStore(moduli)[item.item]?.summary;
  const isFocused = useStore(focus) === item.item;
  const counts = countsOf(item, summary);
  if (counts.length === 0) return null;
  const total = counts.reduce((sum, [, count]) => sum + count, 0);
  return (
    <div class="states">
      <div class="state-bar" aria-hidden="true">
        {counts.map(([state, count]) => (
          <span key={state} class={hasModulus(state) ? 'with' : 'without'} style={{ flexGrow: count / total }} />
        ))}
      </div>
      <ul>
        {counts.map(([state, count]) => (
          <li key={state} class={isFocused && state !== 'valid' ? 'explained' : ''} title={meaningOf(state)}>
            {counted(count)} {state}
            {isFocused && state !== 'valid' && <span class="meaning">{meaningOf(state)}</span>}
          </li>
        ))}
      </ul>
    </div>
  );
}

function NameField({ item, which }: { item: Item; which: 'condition' | 'replicate' }) {
  return (
    <label class="name-field">
      <span>{which === 'condition' ? 'Condition' : 'Replicate'}</span>
      <TypedInput
        type="text"
        value={item[which] ?? ''}
        placeholder="–"
        list={which === 'condition' ? 'conditions' : undefined}
        take={(text) => void rename(item.item, { [which]: text.trim() })}
      />
    </label>
  );
}

function EventsWithin({ item }: { item: Item }) {
  useStore(columnsVersion);
  const within = countWithin(item, useStore(gates));
  const all = item.events ?? 0;
  if (within === undefined || within === all) return <>{counted(all)} events</>;
  return (
    <>
      {counted(within)} of {counted(all)} events ({significant(all > 0 ? (100 * within) / all : 0, 3)} %)
    </>
  );
}

function Recording({ item }: { item: Item }) {
  const focused = useStore(focus) === item.item;
  const ready = item.state === 'ready';
  return (
    <li class={`recording ${focused ? 'focused' : ''} ${item.state}`}>
      <button
        class="recording-name"
        aria-current={focused ? 'true' : undefined}
        disabled={!ready}
        title={item.name}
        onClick={() => focus.set(item.item)}
      >
        {titleOf(item)}
      </button>
      {item.state === 'loading' && <p class="soft">is being opened</p>}
      {item.state === 'failed' && <p class="alarm">{item.error}</p>}
      {ready && (
        <>
          <p class="soft">{conditionsOf(item)}</p>
          <p class="soft numbers">
            <EventsWithin item={item} />
          </p>
          <StateCounts item={item} />
          <div class="name-fields">
            <NameField item={item} which="condition" />
            <NameField item={item} which="replicate" />
          </div>
        </>
      )}
    </li>
  );
}

export function RecordingList() {
  const all = useStore(items);
  const shown = recordings(all);
  const conditions = [...new Set(shown.map((item) => item.condition).filter((name) => name !== ''))];
  return (
    <section class="recording-list" aria-label="List of recordings">
      <h2>Recordings</h2>
      {all !== null && shown.length === 0 && (
        <p class="soft">
          None was given. Start the view with recordings or folders of them: <code>rheocyte view FILES.rtdc</code>
        </p>
      )}
      <ul>
        {shown.map((item) => (
          <Recording key={item.item} item={item} />
        ))}
      </ul>
      <datalist id="conditions">
        {conditions.map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
    </section>
  );
}
