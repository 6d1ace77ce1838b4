// The recordings: conditions, names of condition and replicate, what became of their events, or why they cannot be read.
import { useEffect } from 'preact/hooks';
import type { Item } from '../api';
import { significant } from '../draw/numbers';
import { OpenFiles, opener } from '../shell/OpenFiles';
import { useStore } from '../shell/store';
import { TypedInput } from '../shell/TypedInput';
import { countWithin } from './analysis';
import { columnsVersion } from './columns';
import { failureOf, focus, gates, items, recordings, rename, titleOf } from './model';
import { moduli } from './moduli';
import { counted } from './scale';
import { countedStates, states, wantStates } from './states';

/** "20 µm · 0.04 µl/s · CellCarrier · 23 °C" */
function conditionsOf(item: Item): string {
  const given = item.conditions ?? {};
  const number = (name: string, unit: string) =>
    typeof given[name] === 'number' ? `${Number((given[name] as number).toPrecision(4))} ${unit}` : '';
  return [
    number('channel_width_um', 'µm'),
    number('flow_rate_ul_per_s', 'µl/s'),
    typeof given.medium === 'string' ? given.medium : '',
    number('temperature_C', '°C'),
  ]
    .filter((text) => text !== '')
    .join(' · ');
}

/** How many events have a modulus, and why the others have none. */
function StateCounts({ item }: { item: Item }) {
  const run = useStore(moduli)[item.item];
  const isFocused = useStore(focus) === item.item;
  const counts = countedStates(useStore(states), run?.counts ?? item.counts ?? {});
  if (counts.length === 0) return null;
  const total = counts.reduce((sum, [, count]) => sum + count, 0);
  return (
    <div class="states">
      <div class="state-bar" aria-hidden="true">
        {counts.map(([state, count]) => (
          <span key={state.name} class={state.has_modulus ? 'with' : 'without'} style={{ flexGrow: count / total }} />
        ))}
      </div>
      <ul>
        {counts.map(([{ name, sentence }, count]) => (
          <li key={name} class={isFocused && sentence ? 'explained' : ''} title={sentence}>
            {counted(count)} {name}
            {isFocused && sentence && <span class="meaning">{sentence}</span>}
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
      {item.state === 'failed' && <p class="alarm">{failureOf(item)}</p>}
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
  useEffect(wantStates, []);
  const all = useStore(items);
  const shown = recordings(all);
  const conditions = [...new Set(shown.map((item) => item.condition).filter((name) => name !== ''))];
  return (
    <section class="recording-list" aria-label="List of recordings">
      <h2>Recordings</h2>
      <OpenFiles />
      {!opener.get() && all !== null && shown.length === 0 && (
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
