// Axes of a plot: frame, ticks and titles.
import { labelOf } from './features';
import type { Axis } from './model';
import { margins, pixelX, pixelY, type Frame } from './plot_frame';
import { ticksOf } from './scale';

interface PlotAxesProps {
  frame: Frame;
  x: Axis;
  y: Axis;
}

export function PlotAxes({ frame, x, y }: PlotAxesProps) {
  const left = margins.left;
  const right = frame.width - margins.right;
  const top = margins.top;
  const bottom = frame.height - margins.bottom;
  return (
    <g class="plot-axes">
      {ticksOf(x.scale, frame.x, Math.max(2, (right - left) / 60)).map(({ place, label }) => (
        <g key={place} transform={`translate(${pixelX(frame, place).toFixed(1)} ${bottom})`}>
          <line y2={label ? 5 : 3} />
          <text y={18} text-anchor="middle">
            {label}
          </text>
        </g>
      ))}
      {ticksOf(y.scale, frame.y, Math.max(2, (bottom - top) / 40)).map(({ place, label }) => (
        <g key={place} transform={`translate(${left} ${pixelY(frame, place).toFixed(1)})`}>
          <line x2={label ? -5 : -3} />
          <text x={-8} dy="0.32em" text-anchor="end">
            {label}
          </text>
        </g>
      ))}
      <path d={`M${left} ${top}V${bottom}H${right}`} fill="none" />
      <text class="plot-title" x={(left + right) / 2} y={frame.height - 8} text-anchor="middle">
        {labelOf(x.feature)}
      </text>
      <text class="plot-title" transform={`translate(12 ${(top + bottom) / 2}) rotate(-90)`} text-anchor="middle">
        {labelOf(y.feature)}
      </text>
    </g>
  );
}
