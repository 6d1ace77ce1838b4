// The rectangle of a plot on the screen: between places along the axes and pixels of the page.
import type { Span } from './scale';

export const margins = { left: 64, right: 14, top: 12, bottom: 44 };

export interface Frame {
  /** Of the whole plot, with its margins, in pixels of the page. */
  width: number;
  height: number;
  x: Span;
  y: Span;
}

export const innerWidth = (frame: Frame) => Math.max(1, frame.width - margins.left - margins.right);
export const innerHeight = (frame: Frame) => Math.max(1, frame.height - margins.top - margins.bottom);

export const pixelX = ({ x, ...frame }: Frame, place: number) =>
  margins.left + ((place - x.low) / (x.high - x.low)) * innerWidth({ x, ...frame });
export const pixelY = ({ y, ...frame }: Frame, place: number) =>
  margins.top + ((y.high - place) / (y.high - y.low)) * innerHeight({ y, ...frame });

export const placeAtX = (frame: Frame, pixel: number) =>
  frame.x.low + ((pixel - margins.left) / innerWidth(frame)) * (frame.x.high - frame.x.low);
export const placeAtY = (frame: Frame, pixel: number) =>
  frame.y.high - ((pixel - margins.top) / innerHeight(frame)) * (frame.y.high - frame.y.low);

/** A polyline as the path of an SVG element. */
export function pathOf(frame: Frame, points: Iterable<readonly [number, number]>): string {
  let path = '';
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    path += `${path === '' ? 'M' : 'L'}${pixelX(frame, x).toFixed(1)} ${pixelY(frame, y).toFixed(1)}`;
  }
  return path;
}
