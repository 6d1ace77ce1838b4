// A colour bar: the choice of the field is its title.
import { useMemo } from 'preact/hooks';
import { tensionMap } from '../draw/colormap';
import { significant, tickLabels, ticks, unitText } from '../draw/numbers';
import type { FieldChoice, Legend } from './looks';
import type { ColorMap } from '../draw/colormap';

const width = 220;

/** The map as a row of coloured pieces; a gradient of few stops would not keep equal steps. */
function Strip({ map }: { map: ColorMap }) {
  const pieces = 64;
  const drawn = useMemo(
    () =>
      Array.from({ length: pieces }, (_, k) => (
        <rect key={k} x={(k * width) / pieces} y={0} width={width / pieces + 0.5} height={10} fill={map.css[Math.round((k / (pieces - 1)) * 255)]} />
      )),
    [map],
  );
  return <g shape-rendering="crispEdges">{drawn}</g>;
}

export function Bar({ map, low, high, factor }: { map: ColorMap; low: number; high: number; factor: number }) {
  const values = ticks(factor * low, factor * high, 5);
  const labels = tickLabels(values);
  const place = (value: number) => (width * (value - factor * low)) / (factor * (high - low) || 1);
  return (
    <svg class="bar-scale" width={width + 32} height={30} viewBox={`-16 0 ${width + 32} 30`} aria-hidden="true">
      <Strip map={map} />
      {values.map((value, k) => (
        <g key={k} transform={`translate(${place(value)} 0)`}>
          <path d="M0 10V14" stroke="currentColor" />
          <text y={26} text-anchor="middle" font-size={11} fill="currentColor">
            {labels[k]}
          </text>
        </g>
      ))}
    </svg>
  );
}

/** The colours of the tension along the cortex, with its ends. */
export function TensionBar({ low, high }: { low: number; high: number }) {
  return (
    <span class="tension-bar">
      <span>{significant(low, 3)}</span>
      <svg width={80} height={8} viewBox={`0 0 ${width} 10`} preserveAspectRatio="none" aria-hidden="true">
        <Strip map={tensionMap} />
      </svg>
      <span>{`${significant(high, 3)} mN/m`}</span>
    </span>
  );
}

interface ColorBarProps {
  label: string;
  choices: FieldChoice[];
  chosen: string;
  legend: Legend | null;
  /** what stands in place of the colours where there are none */
  empty: string;
  choose: (name: string) => void;
}

const nameOf = ({ title, unit }: FieldChoice) => (unit ? `${title} (${unitText(unit)})` : title);

export function ColorBar({ label, choices, chosen, legend, empty, choose }: ColorBarProps) {
  return (
    <div class="color-bar">
      <select aria-label={label} value={chosen} onChange={(event) => choose(event.currentTarget.value)}>
        {choices.map((choice) => (
          <option key={choice.name} value={choice.name}>
            {nameOf(choice)}
          </option>
        ))}
      </select>
      {legend ? (
        <Bar map={legend.map} low={legend.low} high={legend.high} factor={legend.field.factor} />
      ) : (
        <p class="none">{empty}</p>
      )}
    </div>
  );
}
