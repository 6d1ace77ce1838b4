// The gates as numbers: what is drawn in a plot can be set here as well, and by the keyboard alone.
import { numberIn } from '../../draw/numbers';
import { useStore } from '../../shell/store';
import { TypedInput } from '../../shell/TypedInput';
import { labelOf, nameOf } from '../features';
import type { Gate, PolygonGate, RangeGate } from '../gates';
import { addGate, changeGate, focus, gates, itemOf, items, removeGate } from '../model';
import { FeatureOptions } from '../PlotSelects';
import type { Tab } from '../tab';
import './Gates.css';

function End({ gate, which }: { gate: RangeGate; which: 'low' | 'high' }) {
  return (
    <TypedInput
      type="text"
      inputMode="decimal"
      class="number"
      aria-label={`${which === 'low' ? 'Minimum' : 'Maximum'} ${nameOf(gate.feature)}`}
      value={gate[which] ?? ''}
      placeholder={which === 'low' ? 'minimum' : 'maximum'}
      canTake={(text) => text.trim() === '' || numberIn(text) !== null}
      take={(text) => changeGate(gate.id, { [which]: numberIn(text) })}
    />
  );
}

/** "60 0.01; 90 0.01; 90 0.05" */
const written = (gate: PolygonGate) => gate.points.map((point) => point.join(' ')).join('; ');

function readCorners(text: string): [number, number][] | null {
  const corners = text
    .split(';')
    .filter((part) => part.trim() !== '')
    .map((part) => part.trim().split(/[\s,]+/).map(Number));
  return corners.length >= 3 && corners.every((each) => each.length === 2 && each.every(Number.isFinite))
    ? (corners as [number, number][])
    : null;
}

function Corners({ gate }: { gate: PolygonGate }) {
  return (
    <TypedInput
      type="text"
      class="corners"
      aria-label={`Corners of the polygon, ${nameOf(gate.x)} and ${nameOf(gate.y)}, separated by semicolons`}
      value={written(gate)}
      canTake={(text) => readCorners(text) !== null}
      take={(text) => changeGate(gate.id, { points: readCorners(text)! })}
    />
  );
}

function GateRow({ gate }: { gate: Gate }) {
  const name = gate.kind === 'range' ? labelOf(gate.feature) : `Polygon: ${nameOf(gate.x)}, ${nameOf(gate.y)}`;
  return (
    <li class="gate">
      <label class="gate-name">
        <input type="checkbox" checked={gate.on} onChange={({ currentTarget }) => changeGate(gate.id, { on: currentTarget.checked })} />
        <span>{name}</span>
      </label>
      {gate.kind === 'range' ? (
        <span class="ends">
          <End gate={gate} which="low" />
          <span aria-hidden="true">to</span>
          <End gate={gate} which="high" />
        </span>
      ) : (
        <Corners gate={gate} />
      )}
      <button class="quiet" aria-label={`Remove the gate ${name}`} onClick={() => removeGate(gate.id)}>
        ×
      </button>
    </li>
  );
}

function GateList() {
  const all = useStore(gates);
  useStore(items);
  const features = itemOf(useStore(focus))?.features ?? [];
  return (
    <div class="gate-list">
      {all.length === 0 && (
        <p class="soft">All events count. Draw a box or a polygon in a plot, or choose a feature to limit.</p>
      )}
      <ul>
        {all.map((gate) => (
          <GateRow key={gate.id} gate={gate} />
        ))}
      </ul>
      <label class="choice">
        <span>Limit</span>
        <select
          value=""
          onChange={({ currentTarget }) => {
            if (currentTarget.value) addGate({ kind: 'range', feature: currentTarget.value, low: null, high: null } as never);
            currentTarget.value = '';
          }}
        >
          <option value="">a feature …</option>
          <FeatureOptions features={features} chosen={features[0] ?? ''} />
        </select>
      </label>
    </div>
  );
}

function HowMany() {
  const active = useStore(gates).filter((gate) => gate.on).length;
  return active > 0 ? <> ({active})</> : null;
}

export default { name: 'gates', title: 'Gates', place: 2, Note: HowMany, Content: GateList } satisfies Tab;
