// The plane of area and deformation: isoelasticity lines of this channel and flow, the cell, and its trace.
import { useLayoutEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Isoelastic, Lines } from '../api';
import { placeLabels, widthOf, type NamedLine } from '../draw/line_labels';
import { plain, tickLabels, ticks } from '../draw/numbers';
import { useStore } from '../shell/store';
import * as model from './model';

interface Axes {
  width: number;
  height: number;
  /** greatest area and deformation of the plane; both begin at zero */
  area: number;
  deformation: number;
}

const margin = { left: 52, right: 56, top: 10, bottom: 34 };
const x = ({ width, area }: Axes, value: number) => margin.left + ((width - margin.left - margin.right) * value) / area;
const y = ({ height, deformation }: Axes, value: number) =>
  height - margin.bottom - ((height - margin.top - margin.bottom) * value) / deformation;

/** Room for the lines and the cell, in few steps so that the plane stays where it is. */
function axesOf(width: number, height: number, lines: Lines | null, points: model.TracePoint[]): Axes {
  const fit = (values: number[], steps: number[]) => {
    const most = Math.max(0, ...values.filter(Number.isFinite));
    return steps.find((step) => step >= most) ?? most * 1.1;
  };
  const all = lines?.lines ?? [];
  const greatest = (values: number[]) => Math.max(0, ...values);
  const areas = [...all.map((line) => greatest(line.x)), ...points.slice(-1).map((point) => 1.05 * point.area_um2)];
  const heights = [...all.map((line) => greatest(line.y)), ...points.slice(-1).map((point) => 1.05 * point.deformation)];
  return {
    width,
    height,
    area: fit(areas, [50, 100, 200, 300, 400, 600, 800, 1200, 2000, 4000]),
    deformation: fit(heights, [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5]),
  };
}

function Frame({ axes }: { axes: Axes }) {
  const across = ticks(0, axes.area, 6);
  const up = ticks(0, axes.deformation, 4);
  const [acrossLabels, upLabels] = [tickLabels(across), tickLabels(up)];
  const bottom = axes.height - margin.bottom;
  return (
    <g font-size={11} fill="var(--ink-soft)" stroke="none">
      {across.map((value, k) => (
        <g key={`x${value}`} transform={`translate(${x(axes, value)} ${bottom})`}>
          <path d="M0 0V4" stroke="var(--line-strong)" />
          <text y={16} text-anchor="middle">
            {acrossLabels[k]}
          </text>
        </g>
      ))}
      {up.map((value, k) => (
        <g key={`y${value}`} transform={`translate(${margin.left} ${y(axes, value)})`}>
          <path d={`M0 0H${axes.width - margin.left - margin.right}`} stroke="var(--line)" />
          <text x={-6} y={4} text-anchor="end">
            {upLabels[k]}
          </text>
        </g>
      ))}
      <path d={`M${margin.left} ${margin.top}V${bottom}H${axes.width - margin.right}`} fill="none" stroke="var(--line-strong)" />
      <text x={axes.width - margin.right} y={axes.height - 4} text-anchor="end">
        area (µm²)
      </text>
      <text x={-margin.top} y={12} text-anchor="end" transform="rotate(-90)">
        deformation
      </text>
    </g>
  );
}

const fontSize = 11;

/** A line with its modulus behind its end. */
function named(axes: Axes, line: Isoelastic): NamedLine {
  const text = `${plain(Number(line.young_modulus_kPa.toPrecision(3)))} kPa`;
  const points = line.x.map((area, k): [number, number] => [x(axes, area), y(axes, line.y[k])]);
  const [right, middle] = points[points.length - 1] ?? [NaN, NaN];
  return { text, points, wanted: { left: right + 4, right: right + 4 + widthOf(text, fontSize), top: middle - 5, bottom: middle + 4 } };
}

function IsoelasticLines({ axes, lines }: { axes: Axes; lines: Lines }) {
  const all = lines.lines.map((line) => named(axes, line));
  const labels = placeLabels(all, { left: margin.left, right: axes.width, top: 0, bottom: axes.height - margin.bottom + 8 });
  return (
    <g fill="none" stroke="var(--line-strong)" stroke-width={1}>
      {all.map(({ points }, k) => (
        <path key={k} d={`M${points.map(([left, top]) => `${left.toFixed(1)} ${top.toFixed(1)}`).join('L')}`} />
      ))}
      {labels.map(
        (label, k) =>
          label && (
            <text key={k} class="line-modulus" font-size={fontSize} x={label.left} y={label.bottom}>
              {all[k].text}
            </text>
          ),
      )}
    </g>
  );
}

function Way({ axes, points, stale }: { axes: Axes; points: model.TracePoint[]; stale: boolean }) {
  const last = points[points.length - 1];
  if (!last) return null;
  const at = (point: model.TracePoint) => `${x(axes, point.area_um2).toFixed(1)} ${y(axes, point.deformation).toFixed(1)}`;
  return (
    <g>
      <path d={`M${points.map(at).join('L')}`} fill="none" stroke="var(--accent)" stroke-opacity={0.45} stroke-width={1.5} stroke-linejoin="round" />
      <circle
        class="cell-point"
        cx={x(axes, last.area_um2)}
        cy={y(axes, last.deformation)}
        r={6}
        fill={stale ? 'var(--line-strong)' : 'var(--accent)'}
        stroke="var(--ground)"
        stroke-width={2}
      />
    </g>
  );
}

export function Plane() {
  const box = useRef<HTMLDivElement | null>(null);
  const [size, setSize] = useState({ width: 600, height: 200 });
  useLayoutEffect(() => {
    const observer = new ResizeObserver(() => setSize({ width: box.current!.clientWidth, height: box.current!.clientHeight }));
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  const lines = useStore(model.lines);
  const points = useStore(model.trace);
  const stale = useStore(model.refused) !== null;
  const last = points[points.length - 1];
  const found = axesOf(size.width, size.height, lines, points);
  const axes = useMemo(() => found, [found.width, found.height, found.area, found.deformation]);
  const ground = useMemo(
    () => (
      <>
        <Frame axes={axes} />
        {lines && <IsoelasticLines axes={axes} lines={lines} />}
      </>
    ),
    [axes, lines],
  );
  const label = last ? `Area ${last.area_um2.toFixed(1)} µm², deformation ${last.deformation.toFixed(4)}` : 'No state yet';
  return (
    <section class="plane" aria-label="Area and deformation">
      <header>
        <h2>Area and deformation</h2>
        <p class="source">{lines?.sentence ?? ''}</p>
        <button class="quiet" onClick={model.clearTrace} disabled={points.length < 2}>
          Clear the trace
        </button>
      </header>
      <div ref={box} class="plane-plot">
        <svg width={size.width} height={size.height} role="img" aria-label={label}>
          {ground}
          <Way axes={axes} points={points} stale={stale} />
        </svg>
      </div>
    </section>
  );
}
