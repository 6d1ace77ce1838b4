// What stands on the axes of a plot and what colours its events.
import { labelOf } from './features';
import { byDensity, changePlot, type Axis, type Plot } from './model';

const byLabel = (features: string[]) => [...features].sort((a, b) => labelOf(a).localeCompare(labelOf(b)));

interface FeatureOptionsProps {
  features: string[];
  chosen: string;
}

/** The features of a recording; a chosen one that it lacks stays in the list. */
export function FeatureOptions({ features, chosen }: FeatureOptionsProps) {
  const all = features.includes(chosen) || chosen === byDensity ? features : [...features, chosen];
  return (
    <>
      {byLabel(all).map((feature) => (
        <option key={feature} value={feature}>
          {labelOf(feature)}
        </option>
      ))}
    </>
  );
}

interface SelectsProps {
  plot: Plot;
  features: string[];
}

function AxisSelect({ plot, features, which }: SelectsProps & { which: 'x' | 'y' }) {
  const axis = plot[which];
  const change = (part: Partial<Axis>) => changePlot(plot.id, { [which]: { ...axis, ...part, span: null } });
  const title = which === 'x' ? 'Horizontal' : 'Vertical';
  return (
    <div class="choice">
      <label>
        <span class="hidden">{title} axis</span>
        <span aria-hidden="true">{which}</span>
        <select value={axis.feature} title={labelOf(axis.feature)} onChange={({ currentTarget }) => change({ feature: currentTarget.value })}>
          <FeatureOptions features={features} chosen={axis.feature} />
        </select>
      </label>
      <button
        class="toggle"
        aria-pressed={axis.scale === 'log'}
        aria-label={`log, ${title.toLowerCase()} axis`}
        title="Logarithmic axis"
        onClick={() => change({ scale: axis.scale === 'log' ? 'linear' : 'log' })}
      >
        log
      </button>
    </div>
  );
}

export function AxisSelects(props: SelectsProps) {
  return (
    <>
      <AxisSelect {...props} which="x" />
      <AxisSelect {...props} which="y" />
    </>
  );
}

export function ColourSelect({ plot, features }: SelectsProps) {
  return (
    <label class="choice short" title="Colour of the events">
      <span class="hidden">Colour</span>
      <select value={plot.colour} onChange={({ currentTarget }) => changePlot(plot.id, { colour: currentTarget.value })}>
        <option value={byDensity}>Density of events</option>
        <FeatureOptions features={features} chosen={plot.colour} />
      </select>
    </label>
  );
}
