// What the colours of a plot's events mean, in its upper right corner.
import { densityMap } from '../draw/colormap';
import type { Box } from '../draw/line_labels';
import { labelOf } from './features';
import { innerWidth, margins, type Frame } from './plot_frame';
import { ticksOf, type Span } from './scale';

const width = 132;
const height = 8;

interface ColourScaleProps {
  frame: Frame;
  plot: number;
  feature: string;
  range: Span;
}

const leftOf = (frame: Frame) => margins.left + innerWidth(frame) - width - 12;

/** Where it stands, in pixels of the plot. */
export const colourScaleBox = (frame: Frame): Box => ({
  left: leftOf(frame) - 20,  // the number at its end is wider
  top: margins.top + 2,
  right: leftOf(frame) + width + 8,
  bottom: margins.top + height + 44,
});

export function ColourScale({ frame, plot, feature, range }: ColourScaleProps) {
  const stops = Array.from({ length: 9 }, (_, k) => densityMap.css[Math.round((255 * k) / 8)]);
  const place = (value: number) => ((value - range.low) / (range.high - range.low || 1)) * width;
  return (
    <g class="colour-scale" transform={`translate(${leftOf(frame)} ${margins.top + 10})`}>
      <linearGradient id={`colours-${plot}`}>
        {stops.map((colour, k) => (
          <stop key={k} offset={k / 8} stop-color={colour} />
        ))}
      </linearGradient>
      <rect class="ground" x={-8} y={-8} width={width + 16} height={height + 42} />
      <rect width={width} height={height} fill={`url(#colours-${plot})`} />
      {ticksOf('linear', range, 3).map(({ place: value, label }) => (
        <text key={value} x={place(value)} y={height + 13} text-anchor="middle">
          {label}
        </text>
      ))}
      <text class="plot-title" x={width / 2} y={height + 28} text-anchor="middle">
        {labelOf(feature)}
      </text>
    </g>
  );
}
