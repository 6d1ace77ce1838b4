// Where events stand in a plot.
import { forward, type ScaleKind } from './scale';

/** Places of events along the scales of two axes, relative to an origin so that single precision is enough. */
export interface Places {
  x: Float32Array;
  y: Float32Array;
  originX: number;
  originY: number;
}

function alongScale(values: ArrayLike<number>, kind: ScaleKind): { places: Float32Array; origin: number } {
  let origin = 0;
  for (let i = 0; i < values.length; ++i) {
    const place = forward(kind, values[i]);
    if (Number.isFinite(place)) {
      origin = place;
      break;
    }
  }
  const places = new Float32Array(values.length);
  if (kind === 'linear') for (let i = 0; i < places.length; ++i) places[i] = values[i] - origin;
  else for (let i = 0; i < places.length; ++i) places[i] = values[i] > 0 ? Math.log10(values[i]) - origin : NaN;
  return { places, origin };
}

export function placesOf(xs: ArrayLike<number>, ys: ArrayLike<number>, xScale: ScaleKind, yScale: ScaleKind): Places {
  const x = alongScale(xs, xScale);
  const y = alongScale(ys, yScale);
  return { x: x.places, y: y.places, originX: x.origin, originY: y.origin };
}
