// One plot: any two features of a recording, its events by density or by a third feature, lines and gates over them.
import { useMemo } from 'preact/hooks';
import type { Item, Lines } from '../api';
import { useWheel } from '../draw/use_wheel';
import { pixelX, pixelY, margins, innerHeight, innerWidth, type Frame } from './plot_frame';
import { useStore } from '../shell/store';
import { counted } from './scale';
import { column, columnsVersion } from './columns';
import { nameOf } from './features';
import { changePlot, choice, focus, gates, itemOf, items, recordings, titleOf, tool, type Plot } from './model';
import { moduliVersion } from './moduli';
import { ColourScale, colourScaleBox } from './ColourScale';
import { PlotActions } from './plot_actions';
import { PlotAxes } from './PlotAxes';
import { useLines, usePlotData, type PlotData } from './plot_data';
import { DensityContours, Draft, GateShapes, TableLines } from './PlotLines';
import { AxisSelects, ColourSelect } from './PlotSelects';
import { PointsCanvas } from './PointsCanvas';
import { stateLegend, states } from './states';
import { useDrawing, type Drawing } from './use_drawing';
import { useSize } from './use_size';

function ChosenEvent({ frame, data, item }: { frame: Frame; data: PlotData; item: Item }) {
  const chosen = useStore(choice);
  if (chosen?.item !== item.item) return null;
  const x = pixelX(frame, data.places.x[chosen.event] + data.places.originX);
  const y = pixelY(frame, data.places.y[chosen.event] + data.places.originY);
  if (!Number.isFinite(x) || !Number.isFinite(y)) return null;
  return (
    <g class="chosen-event">
      <circle cx={x} cy={y} r={7} />
      <circle cx={x} cy={y} r={7} />
    </g>
  );
}

/** What a reader of the page hears about the plot. */
const spoken = (plot: Plot, item: Item) =>
  `Plot of ${nameOf(plot.y.feature)} against ${nameOf(plot.x.feature)}, ${titleOf(item)}, ${counted(item.events ?? 0)} events. ` +
  'Arrow keys move, plus and minus zoom, 0 shows all; Shift with arrow keys moves a crosshair, Enter chooses the event there; ' +
  'N and P choose the next and the previous event; B draws a box gate, G a polygon gate, C closes it, Escape ends.';

interface LayersProps {
  plot: Plot;
  item: Item;
  frame: Frame;
  data: PlotData | null;
  lines: Lines | null;
  drawing: Drawing;
}

function Layers({ plot, item, frame, data, lines, drawing }: LayersProps) {
  const active = useStore(gates);
  const clip = `inside-${plot.id}`;
  return (
    <>
      <clipPath id={clip}>
        <rect x={margins.left} y={margins.top} width={innerWidth(frame)} height={innerHeight(frame)} />
      </clipPath>
      <g clip-path={`url(#${clip})`}>
        {lines && <TableLines plot={plot} frame={frame} lines={lines} taken={data?.colour ? [colourScaleBox(frame)] : []} />}
        {data?.density && plot.contours && (item.events ?? 0) >= 20 && <DensityContours density={data.density} frame={frame} />}
        <GateShapes plot={plot} frame={frame} gates={active} />
        <Draft frame={frame} points={drawing.points} closed={drawing.closed} crosshair={drawing.crosshair} />
        {data && <ChosenEvent frame={frame} data={data} item={item} />}
      </g>
      <PlotAxes frame={frame} x={plot.x} y={plot.y} />
      {data?.colour && <ColourScale frame={frame} plot={plot.id} feature={plot.colour} range={data.colour.range} />}
    </>
  );
}

/** What lines and numbers of states mean. */
function PlotNote({ plot, item, lines }: { plot: Plot; item: Item; lines: Lines | null }) {
  useStore(columnsVersion);
  const known = useStore(states);
  const shown = [plot.x.feature, plot.y.feature, plot.colour].includes('state') ? column(item.item, 'state') : undefined;
  const legend = useMemo(() => shown && stateLegend(known, shown), [known, shown]);
  const told = plot.lines ? (lines?.sentence ?? (lines?.table ? `Isoelasticity lines in kPa: ${lines.table}` : '')) : '';
  return <p class={legend ? 'plot-note whole' : 'plot-note'}>{legend || told}</p>;
}

function Drawn({ plot, item }: { plot: Plot; item: Item }) {
  const { element, width, height } = useSize<HTMLDivElement>();
  const data = usePlotData(plot, item);
  const lines = useLines(plot, item, useStore(moduliVersion));
  const mode = useStore(tool);
  const frame: Frame = { width, height, x: data?.x ?? { low: 0, high: 1 }, y: data?.y ?? { low: 0, high: 1 } };
  const actions = useMemo(
    () => (data && width > 0 ? new PlotActions(plot, item, data, frame) : null),
    [plot, item, data, width, height],
  );
  const drawing = useDrawing(actions);
  useWheel(element, (factor, at) => actions?.zoom(factor, at));
  return (
    <>
      <div
        class={`plot-frame tool-${mode}`}
        ref={element}
        data-plot={plot.id}
        tabIndex={0}
        role="application"
        aria-label={spoken(plot, item)}
        onPointerDown={drawing.onPointerDown}
        onPointerMove={drawing.onPointerMove}
        onPointerUp={drawing.onPointerUp}
        onPointerCancel={drawing.onPointerCancel}
        onKeyDown={drawing.onKeyDown}
        onDblClick={() => mode === 'look' && actions?.fit()}
      >
        <PointsCanvas data={data} frame={frame} moving={drawing.moving} />
        <svg width={width} height={height} aria-hidden="true">
          {width > 0 && <Layers {...{ plot, item, frame, data, lines, drawing }} />}
        </svg>
      </div>
      <p class="plot-keys" aria-hidden="true">
        Arrows: move · +, −, 0: zoom · Shift + arrows, Enter: select · N, P: next, previous · B: box · G, C: polygon
      </p>
      <PlotNote plot={plot} item={item} lines={lines} />
    </>
  );
}

export function ScatterPlot({ plot, several }: { plot: Plot; several: boolean }) {
  const all = recordings(useStore(items));
  const focused = useStore(focus);
  const item = itemOf(plot.item ?? focused);
  const colour = <ColourSelect plot={plot} features={item?.features ?? []} />;
  return (
    <section class="plot" aria-label={`Plot ${plot.id}`}>
      <div class="plot-head">
        {several && (
          <label class="choice short">
            <span class="hidden">Recording</span>
            <select
              value={plot.item === null ? '' : String(plot.item)}
              onChange={({ currentTarget: { value } }) => changePlot(plot.id, { item: value === '' ? null : Number(value) })}
            >
              <option value="">Recording in focus</option>
              {all.map((each) => (
                <option key={each.item} value={String(each.item)}>
                  {titleOf(each)}
                </option>
              ))}
            </select>
          </label>
        )}
        {several && colour}
        <AxisSelects plot={plot} features={item?.features ?? []} />
        {!several && colour}
      </div>
      {item && item.state === 'ready' ? <Drawn plot={plot} item={item} /> : <div class="plot-frame empty">{item?.state === 'loading' ? 'The recording is being opened.' : 'No recording.'}</div>}
    </section>
  );
}
