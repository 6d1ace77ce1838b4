// What the workspace writes into the output folder: events, companion, picture, session.
import { useState } from 'preact/hooks';
import { exportFile, type ExportRequest, type Item } from '../api';
import { notify, notifyFailure } from '../shell/notices';
import { Progress, useLasting } from '../shell/Progress';
import { sendSession } from '../shell/session';
import { useStore } from '../shell/store';
import { maskOf } from './analysis';
import { numbersWithin } from './gates';
import { focus, gates, itemOf, items, titleOf } from './model';
import { base64, pngOf, svgOf } from './picture';

const bare = (item: Item) => titleOf(item).replace(/\.rtdc$/, '');

function events(what: 'events' | 'companion', item: Item): ExportRequest {
  const inside = maskOf(item, gates.get());
  const gate = inside ? numbersWithin(inside) : null;
  return { what, item: item.item, gate, version: item.version, name: what === 'events' ? `${bare(item)}_events.tsv` : `${bare(item)}_companion.rtdc` };
}

async function picture(what: 'svg' | 'png', item: Item): Promise<ExportRequest> {
  const frame = document.querySelector<HTMLElement>('.plot-frame')!;
  const data = what === 'svg' ? base64(svgOf(frame)) : await pngOf(frame);
  return { what, name: `${bare(item)}_events.${what}`, data };
}

const entries: [string, (item: Item) => ExportRequest | Promise<ExportRequest>][] = [
  ['Table of events', (item) => events('events', item)],
  ['Companion .rtdc', (item) => events('companion', item)],
  ['Picture, SVG', (item) => picture('svg', item)],
  ['Picture, PNG', (item) => picture('png', item)],
  ['Session', async () => (await sendSession(), { what: 'session', name: 'session.toml' })],
];

export function ExportMenu() {
  const number = useStore(focus);
  useStore(items);
  const item = itemOf(number);
  const [running, setRunning] = useState<AbortController | null>(null);
  const lasting = useLasting(running !== null);
  const write = async (request: (item: Item) => ExportRequest | Promise<ExportRequest>) => {
    const control = new AbortController();
    setRunning(control);
    try {
      const { file } = await exportFile(await request(item!), control.signal);
      notify(`Written: ${file}`);
    } catch (failure) {
      notifyFailure(failure);
    } finally {
      setRunning(null);
    }
  };
  return (
    <div class="export">
      {lasting && <Progress label="Writing" onStop={() => running?.abort()} />}
      <label>
        <span class="hidden">Export</span>
        <select
          value=""
          disabled={!item || running !== null}
          onChange={({ currentTarget }) => {
            const chosen = entries[Number(currentTarget.value)];
            currentTarget.value = '';
            if (chosen) void write(chosen[1]);
          }}
        >
          <option value="">Export …</option>
          {entries.map(([title], k) => (
            <option key={title} value={String(k)}>
              {title}
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}
