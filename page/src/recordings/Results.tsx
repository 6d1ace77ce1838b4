// What is known of the recordings, in tabs below the plots.
import tabs from 'every:./tabs';
import { useStore } from '../shell/store';
import { items, measured, panel, recordings } from './model';
import { labelOf } from './features';
import { FeatureOptions } from './PlotSelects';
import { fittedFeatures } from './population_fits';
import { population } from './population_runs';
import type { Tab } from './tab';

const inOrder: Tab[] = [...tabs].sort((a, b) => a.place - b.place);

/** Arrow keys lead from tab to tab. */
function moveTab(event: KeyboardEvent, now: Tab): void {
  const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
  if (step === 0) return;
  const next = inOrder[(inOrder.indexOf(now) + step + inOrder.length) % inOrder.length].name;
  panel.set(next);
  document.getElementById(`tab-${next}`)?.focus();
  event.preventDefault();
}

function MeasuredSelect() {
  const feature = useStore(measured);
  const found = useStore(population);
  const ofEvents = recordings(useStore(items)).flatMap((item) => item.features ?? []);
  const offered = [...new Set([...ofEvents, ...(found ? fittedFeatures(found.record) : [])])];
  return (
    <label class="choice">
      <span>Quantity</span>
      <select aria-label="Quantity" title={labelOf(feature)} value={feature} onChange={({ currentTarget }) => measured.set(currentTarget.value)}>
        <FeatureOptions features={offered} chosen={feature} />
      </select>
    </label>
  );
}

export function Results() {
  const chosen = useStore(panel);
  const shown = inOrder.find(({ name, former }) => chosen === name || chosen === former) ?? inOrder[0];
  return (
    <section class="results" aria-label="Results">
      <div class="results-head">
        <div class="tabs" role="tablist" aria-label="Results">
          {inOrder.map((tab) => (
            <button
              key={tab.name}
              id={`tab-${tab.name}`}
              role="tab"
              aria-selected={shown === tab}
              aria-controls="results-panel"
              tabIndex={shown === tab ? 0 : -1}
              onClick={() => panel.set(tab.name)}
              onKeyDown={(event) => moveTab(event, tab)}
            >
              {tab.title}
              {tab.Note && <tab.Note />}
            </button>
          ))}
        </div>
        {shown.measures && <MeasuredSelect />}
      </div>
      <div id="results-panel" role="tabpanel" aria-labelledby={`tab-${shown.name}`} tabIndex={0}>
        <shown.Content />
      </div>
    </section>
  );
}
