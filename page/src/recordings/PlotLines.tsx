// What lies over the events: the table's range, isoelasticity lines, contours of the density, gates.
import { useMemo } from 'preact/hooks';
import type { Lines } from '../api';
import { placeLabels, type Box } from '../draw/line_labels';
import { significant } from '../draw/numbers';
import { densityCells, levelsEnclosing, type Density } from './density';
import type { Gate, PolygonGate } from './gates';
import { isolines, type Polyline } from './isolines';
import type { Plot } from './model';
import { margins, pathOf, pixelX, pixelY, type Frame } from './plot_frame';
import { backward, forward, type Span } from './scale';

type Points = [number, number][];

/** A curve that is given by values of the features. */
const along = (plot: Plot, x: number[], y: number[]): Points =>
  x.map((value, k) => [forward(plot.x.scale, value), forward(plot.y.scale, y[k])]);

/** In pixels, as far as they are numbers. */
const onScreen = (frame: Frame, points: Points): Points =>
  points.filter(([x, y]) => Number.isFinite(x) && Number.isFinite(y)).map(([x, y]) => [pixelX(frame, x), pixelY(frame, y)]);

interface TableLinesProps {
  plot: Plot;
  frame: Frame;
  lines: Lines;
  /** Where no number of a line may stand. */
  taken: Box[];
}

export function TableLines({ plot, frame, lines, taken }: TableLinesProps) {
  const { range } = lines;
  const inner = { left: margins.left, right: frame.width - margins.right, top: margins.top, bottom: frame.height - margins.bottom };
  const drawn = lines.lines.map((line) => ({ text: significant(line.young_modulus_kPa, 2), curve: along(plot, line.x, line.y) }));
  const labels = placeLabels(
    drawn.map(({ text, curve }) => ({ text, points: onScreen(frame, curve) })),
    inner,
    taken,
  );
  return (
    <g class="table-lines">
      {range && <path class="table-range" d={`${pathOf(frame, along(plot, range.x, range.y))}Z`} />}
      {drawn.map(({ curve }, k) => (
        <path key={k} class="isoelastic" d={pathOf(frame, curve)} />
      ))}
      {labels.map(
        (label, k) =>
          label && (
            <text key={k} class="line-number" x={label.right} y={label.bottom} text-anchor="end">
              {drawn[k].text}
            </text>
          ),
      )}
    </g>
  );
}

/** From cells of the density's grid to places along the axes. */
function onAxes(density: Density, line: Polyline): Points {
  const place = (span: Span, cell: number) => span.low + ((cell + 0.5) / densityCells) * (span.high - span.low);
  return line.map(([column, row]) => [place(density.x, column), place(density.y, row)]);
}

export function DensityContours({ density, frame }: { density: Density; frame: Frame }) {
  const contours = useMemo(() => {
    const [half, most] = levelsEnclosing(density, [0.5, 0.95]);
    const lines = (level: number) =>
      level > 0 ? isolines(density.values, densityCells, densityCells, level).map((line) => onAxes(density, line)) : [];
    return { half: lines(half), most: lines(most) };
  }, [density]);
  const path = (lines: Points[]) => lines.map((line) => pathOf(frame, line)).join('');
  return (
    <g class="density-contours">
      <path class="halo" d={path(contours.most) + path(contours.half)} />
      <path class="most" d={path(contours.most)} />
      <path class="half" d={path(contours.half)} />
    </g>
  );
}

/** The polygon's edges, cut finely where its scales are not those of the plot, so that they bend as they must. */
function edges(plot: Plot, gate: PolygonGate): Points {
  const own = gate.points.map(([x, y]): [number, number] => [forward(gate.xScale, x), forward(gate.yScale, y)]);
  const pieces = gate.xScale === plot.x.scale && gate.yScale === plot.y.scale ? 1 : 32;
  return own.flatMap(([ax, ay], k) => {
    const [bx, by] = own[(k + 1) % own.length];
    return Array.from({ length: pieces }, (_, i): [number, number] => [
      forward(plot.x.scale, backward(gate.xScale, ax + ((bx - ax) * i) / pieces)),
      forward(plot.y.scale, backward(gate.yScale, ay + ((by - ay) * i) / pieces)),
    ]);
  });
}

/** The rectangle of a plot that limits of its features leave; null where there are none. */
function limited(plot: Plot, frame: Frame, gates: Gate[]): { x: Span; y: Span } | null {
  let found = false;
  const box = { x: { ...frame.x }, y: { ...frame.y } };
  for (const gate of gates) {
    if (gate.kind !== 'range' || !gate.on) continue;
    for (const which of ['x', 'y'] as const) {
      if (plot[which].feature !== gate.feature) continue;
      found = true;
      const ends = [gate.low, gate.high].map((end) => (end === null ? null : forward(plot[which].scale, end)));
      if (ends[0] !== null && Number.isFinite(ends[0])) box[which].low = Math.max(box[which].low, ends[0]);
      if (ends[1] !== null) box[which].high = Math.min(box[which].high, ends[1]);
    }
  }
  return found ? box : null;
}

export function GateShapes({ plot, frame, gates }: { plot: Plot; frame: Frame; gates: Gate[] }) {
  const box = limited(plot, frame, gates);
  return (
    <g class="gate-shapes">
      {box && box.x.high > box.x.low && box.y.high > box.y.low && (
        <rect
          x={pixelX(frame, box.x.low)}
          y={pixelY(frame, box.y.high)}
          width={pixelX(frame, box.x.high) - pixelX(frame, box.x.low)}
          height={pixelY(frame, box.y.low) - pixelY(frame, box.y.high)}
        />
      )}
      {gates.map((gate) =>
        gate.kind === 'polygon' && gate.on && gate.x === plot.x.feature && gate.y === plot.y.feature ? (
          <path key={gate.id} d={`${pathOf(frame, edges(plot, gate))}Z`} />
        ) : null,
      )}
    </g>
  );
}

/** What is being drawn, and the crosshair of the keyboard. */
export function Draft({ frame, points, closed, crosshair }: DraftProps) {
  return (
    <g class="gate-draft">
      {points.length > 0 && <path d={pathOf(frame, points) + (closed ? 'Z' : '')} />}
      {points.map(([x, y], k) => (
        <circle key={k} cx={pixelX(frame, x)} cy={pixelY(frame, y)} r={3.5} />
      ))}
      {crosshair && (
        <path
          class="crosshair"
          d={`M${margins.left} ${crosshair[1]}H${frame.width - margins.right}M${crosshair[0]} ${margins.top}V${frame.height - margins.bottom}`}
        />
      )}
    </g>
  );
}

interface DraftProps {
  frame: Frame;
  points: Points;
  closed: boolean;
  /** Pixels of the page. */
  crosshair: [number, number] | null;
}
