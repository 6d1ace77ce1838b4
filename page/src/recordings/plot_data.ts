// What a plot needs of its recording: places of the events, axes, density, colours.
import { useEffect, useMemo, useState } from 'preact/hooks';
import { readItemLines, type Item, type Lines } from '../api';
import { useStore } from '../shell/store';
import { maskOf } from './analysis';
import { column, columnsVersion, wantColumns } from './columns';
import { Density } from './density';
import { byDensity, paintedGates, type Axis, type Plot } from './model';
import { placesOf, type Places } from './places';
import { rangeOf, type Span } from './scale';

export interface PlotData {
  places: Places;
  mask: Uint8Array | null;
  x: Span;
  y: Span;
  density: Density | null;
  /** The feature that colours the events, and its range; null: by density. */
  colour: { values: Float64Array; range: Span } | null;
}

/** Of the plot's axes: as chosen, else so that they hold the events. */
function useSpan(axis: Axis, values: Float64Array | undefined): Span {
  const own = useMemo(() => (values ? rangeOf(values, axis.scale) : { low: 0, high: 1 }), [values, axis.scale]);
  return axis.span ?? own;
}

function usePlaces(plot: Plot, xs: Float64Array | undefined, ys: Float64Array | undefined): Places | null {
  return useMemo(
    () => (xs && ys ? placesOf(xs, ys, plot.x.scale, plot.y.scale) : null),
    [xs, ys, plot.x.scale, plot.y.scale],
  );
}

/** Density over the range of the events, so that colours stay as they are while the plot is moved. */
function useDensity(plot: Plot, places: Places | null, mask: Uint8Array | null | undefined): Density | null {
  return useMemo(() => {
    if (!places || mask === undefined || !(plot.contours || plot.colour === byDensity)) return null;
    const span = (along: Float32Array, origin: number) => {
      const own = rangeOf(along, 'linear');
      const room = 0.08 * (own.high - own.low);
      return { low: origin + own.low - room, high: origin + own.high + room };
    };
    return new Density(places, mask, span(places.x, places.originX), span(places.y, places.originY));
  }, [places, mask, plot.contours || plot.colour === byDensity]);
}

const filled = (values: Float64Array | undefined) => (values && values.length > 0 ? values : undefined);

/** null while columns are on their way, or if the recording does not have them. */
export function usePlotData(plot: Plot, item: Item | undefined): PlotData | null {
  useStore(columnsVersion);
  const active = useStore(paintedGates);
  const coloured = plot.colour === byDensity ? [] : [plot.colour];
  if (item) wantColumns(item, [plot.x.feature, plot.y.feature, ...coloured]);
  const get = (feature: string) => (item ? filled(column(item.item, feature)) : undefined);
  const xs = get(plot.x.feature);
  const ys = get(plot.y.feature);
  const colours = plot.colour === byDensity ? undefined : get(plot.colour);
  const places = usePlaces(plot, xs, ys);
  const mask = item ? maskOf(item, active) : undefined;
  const x = useSpan(plot.x, xs);
  const y = useSpan(plot.y, ys);
  const density = useDensity(plot, places, mask);
  const colour = useMemo(() => (colours ? { values: colours, range: rangeOf(colours, 'linear') } : null), [colours]);
  return useMemo(
    () => (places && mask !== undefined ? { places, mask, x, y, density, colour } : null),
    [places, mask, x, y, density, colour],
  );
}

/** Isoelasticity lines and the table's range for the plot's axes; `version` changes when moduli were computed anew. */
export function useLines(plot: Plot, item: Item | undefined, version: number): Lines | null {
  const [lines, setLines] = useState<Lines | null>(null);
  const number = item?.state === 'ready' ? item.item : undefined;
  useEffect(() => {
    let gone = false;
    setLines(null);
    if (number !== undefined && plot.lines)
      readItemLines(number, plot.x.feature, plot.y.feature)
        .then((found) => !gone && setLines(found))
        .catch((failure: Error) => !gone && setLines({ lines: [], sentence: failure.message }));
    return () => void (gone = true);
  }, [number, plot.lines, plot.x.feature, plot.y.feature, version]);
  return lines;
}
