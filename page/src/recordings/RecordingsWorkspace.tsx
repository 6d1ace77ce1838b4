// The workspace "Recordings": events of recordings, their moduli, and the model beside each image.
import { useEffect } from 'preact/hooks';
import { notifyFailure } from '../shell/notices';
import { Progress, useLasting } from '../shell/Progress';
import { useStore } from '../shell/store';
import { watchChanges } from './changes';
import { loadingColumns, stopLoading } from './columns';
import { ExportMenu } from './ExportMenu';
import { readComputed } from './features';
import { Inspector } from './Inspector';
import { focus, items, keepModel, plots, readRecordings, recordings, secondPlot, tool, type Tool } from './model';
import { ModuliPanel } from './ModuliPanel';
import { readKnownModuli } from './moduli';
import { RecordingList } from './RecordingList';
import { Results } from './Results';
import { ScatterPlot } from './ScatterPlot';
import { readDeclared } from './settings';
import './list.css';
import './plots.css';
import './results.css';
import './event.css';
import './recordings.css';

const tools: [Tool, string, string][] = [
  ['look', 'Move', 'Drag moves, the wheel or two fingers zoom, a click or a tap chooses an event'],
  ['box', 'Box', 'Gate: drag a box, limits of both features'],
  ['polygon', 'Polygon', 'Gate: click corners; the first corner closes it'],
];

let begun = false;
function useStart(): void {
  useEffect(() => {
    if (begun) return;
    begun = true;
    keepModel();
    watchChanges();
    Promise.all([readDeclared(), readComputed()])
      .then(readRecordings)
      .then(() => recordings(items.get()).filter((item) => item.state === 'ready'))
      .then((ready) => Promise.all(ready.map((item) => readKnownModuli(item.item))))
      .catch(notifyFailure);
  }, []);
}

function Toolbar() {
  const mode = useStore(tool);
  const shown = useStore(plots);
  const loading = useLasting(useStore(loadingColumns) > 0);
  return (
    <div class="toolbar">
      <div class="segmented" role="group" aria-label="What the mouse does">
        {tools.map(([name, title, hint]) => (
          <button key={name} aria-pressed={mode === name} title={hint} onClick={() => tool.set(name)}>
            {title}
          </button>
        ))}
      </div>
      <label class="check">
        <input type="checkbox" checked={shown.length > 1} onChange={({ currentTarget }) => secondPlot(currentTarget.checked)} />
        Two plots
      </label>
      <OverlayChecks />
      <span class="spring">{loading && <Progress label="Reading events" onStop={stopLoading} />}</span>
      <ExportMenu />
    </div>
  );
}

/** Lines and contours, in all plots alike. */
function OverlayChecks() {
  const [first] = useStore(plots);
  const set = (change: { lines?: boolean; contours?: boolean }) => plots.update((all) => all.map((plot) => ({ ...plot, ...change })));
  return (
    <>
      <label class="check" title="Isoelasticity lines of the table, and its range">
        <input type="checkbox" checked={first.lines} onChange={({ currentTarget }) => set({ lines: currentTarget.checked })} />
        Lines
      </label>
      <label class="check" title="Contours that enclose 50 and 95 % of the events">
        <input type="checkbox" checked={first.contours} onChange={({ currentTarget }) => set({ contours: currentTarget.checked })} />
        Contours
      </label>
    </>
  );
}

export function RecordingsWorkspace() {
  useStart();
  const shown = useStore(plots);
  useStore(focus);
  return (
    <section class="recordings" aria-label="Recordings">
      <aside class="recordings-left">
        <RecordingList />
        <ModuliPanel />
      </aside>
      <div class="recordings-middle">
        <Toolbar />
        <div class={`plots ${shown.length > 1 ? 'two' : ''}`}>
          {shown.map((plot) => (
            <ScatterPlot key={plot.id} plot={plot} several={shown.length > 1} />
          ))}
        </div>
        <Results />
      </div>
      <aside class="recordings-right">
        <Inspector />
      </aside>
    </section>
  );
}
