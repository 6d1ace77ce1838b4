// Which numbers of the case the deformation depends on most, as bars.
import { useStore } from '../shell/store';
import { influences, isOpen, type Influence } from './one_percent';
import { titleOf } from './keys';
import * as model from './model';

const percent = (change: number) => `${change > 0 ? '+' : '−'}${Math.abs(100 * change).toPrecision(2)} %`;

function Bar({ of, greatest }: { of: Influence; greatest: number }) {
  const key = model.keys.get().get(of.key);
  const width = `${(50 * Math.abs(of.change)) / greatest}%`;
  return (
    <tr data-key={of.key}>
      <th scope="row" title={key?.sentence}>
        {key ? titleOf(key) : of.key}
      </th>
      <td class="change" aria-hidden="true">
        <span class={of.change > 0 ? 'more' : 'less'} style={of.change > 0 ? { left: '50%', width } : { right: '50%', width }} />
      </td>
      <td class="value">{percent(of.change)}</td>
    </tr>
  );
}

export function Influences() {
  const open = useStore(isOpen);
  const found = useStore(influences);
  const solved = useStore(model.solved);
  const isCurrent = found !== null && found.revision === solved?.revision;
  const greatest = Math.max(...(found?.list.map(({ change }) => Math.abs(change)) ?? [1]));
  return (
    <details class="influences" open={open} onToggle={(event) => isOpen.set(event.currentTarget.open)}>
      <summary>What it depends on</summary>
      {found === null ? (
        <p class="soft">solving …</p>
      ) : (
        <table class={isCurrent ? '' : 'stale'}>
          <caption>1 % more changes the deformation by</caption>
          <tbody>
            {found.list.map((influence) => (
              <Bar key={influence.key} of={influence} greatest={greatest} />
            ))}
          </tbody>
        </table>
      )}
    </details>
  );
}
