// What mouse, fingers and keyboard do to a plot: move, stretch, choose an event, draw gates.
import type { Item } from '../api';
import type { Grip, Pixel } from '../draw/fingers';
import { addGate, changePlot, choice, limitFeature, tool, type Plot } from './model';
import type { PlotData } from './plot_data';
import { innerHeight, innerWidth, margins, pixelX, pixelY, placeAtX, placeAtY, type Frame } from './plot_frame';
import { nearestEvent } from './points';
import { backward, moved, zoomed } from './scale';

/** How near to an event or a corner counts as on it, in pixels of the page: for a mouse, and for a finger. */
export const reach = 14;
export const fingerReach = 28;

export class PlotActions {
  constructor(
    private readonly plot: Plot,
    private readonly item: Item,
    private readonly data: PlotData,
    readonly frame: Frame,
  ) {}

  /** By fractions of the frame, to the right and upwards. */
  move(right: number, up: number): void {
    const { x, y } = this.plot;
    changePlot(this.plot.id, {
      x: { ...x, span: moved(this.frame.x, right) },
      y: { ...y, span: moved(this.frame.y, up) },
    });
  }

  /** About a pixel, without one about the middle. */
  zoom(factor: number, at?: Pixel): void {
    const { x, y } = this.plot;
    const [px, py] = at ?? this.middle();
    changePlot(this.plot.id, {
      x: { ...x, span: zoomed(this.frame.x, factor, placeAtX(this.frame, px)) },
      y: { ...y, span: zoomed(this.frame.y, factor, placeAtY(this.frame, py)) },
    });
  }

  /** What two fingers held at first is now where they are. */
  pinch(from: Grip, to: Grip): void {
    const factor = to.distance / from.distance;
    const { x, y } = this.plot;
    const [right, down] = [to.middle[0] - from.middle[0], to.middle[1] - from.middle[1]];
    const stretchedX = zoomed(this.frame.x, factor, placeAtX(this.frame, from.middle[0]));
    const stretchedY = zoomed(this.frame.y, factor, placeAtY(this.frame, from.middle[1]));
    changePlot(this.plot.id, {
      x: { ...x, span: moved(stretchedX, -right / innerWidth(this.frame)) },
      y: { ...y, span: moved(stretchedY, down / innerHeight(this.frame)) },
    });
  }

  fit(): void {
    changePlot(this.plot.id, { x: { ...this.plot.x, span: null }, y: { ...this.plot.y, span: null } });
  }

  middle(): Pixel {
    return [margins.left + innerWidth(this.frame) / 2, margins.top + innerHeight(this.frame) / 2];
  }

  /** Chooses the event nearest to a pixel. */
  choose([px, py]: Pixel, within = reach): void {
    const view = { x: this.frame.x, y: this.frame.y, width: innerWidth(this.frame), height: innerHeight(this.frame) };
    const event = nearestEvent(this.data.places, this.data.mask, view, px - margins.left, py - margins.top, within);
    if (event >= 0) choice.set({ item: this.item.item, event });
  }

  /** The next event within the gates, or the one before. */
  step(direction: 1 | -1): void {
    const { mask, places } = this.data;
    const count = places.x.length;
    const now = choice.get();
    let event = now?.item === this.item.item ? now.event : direction > 0 ? -1 : count;
    do event += direction;
    while (event >= 0 && event < count && mask !== null && !mask[event]);
    if (event >= 0 && event < count) choice.set({ item: this.item.item, event });
  }

  place([px, py]: Pixel): [number, number] {
    return [placeAtX(this.frame, px), placeAtY(this.frame, py)];
  }

  /** Whether a pixel lies on a place. */
  isOn(pixel: Pixel, place: [number, number], within: number): boolean {
    return Math.hypot(pixelX(this.frame, place[0]) - pixel[0], pixelY(this.frame, place[1]) - pixel[1]) < within;
  }

  /** Limits of both features: what --min and --max of the command line do. */
  addBox(a: [number, number], b: [number, number]): void {
    for (const [axis, k] of [[this.plot.x, 0], [this.plot.y, 1]] as const) {
      const ends = [a[k], b[k]].map((place) => Number(backward(axis.scale, place).toPrecision(5))).sort((c, d) => c - d);
      if (ends[0] < ends[1]) limitFeature(axis.feature, ends[0], ends[1]);
    }
    tool.set('look');
  }

  addPolygon(corners: [number, number][]): void {
    const { x, y } = this.plot;
    const value = (axis: typeof x, place: number) => Number(backward(axis.scale, place).toPrecision(6));
    addGate({
      kind: 'polygon',
      x: x.feature,
      y: y.feature,
      xScale: x.scale,
      yScale: y.scale,
      points: corners.map(([a, b]) => [value(x, a), value(y, b)]),
    } as Parameters<typeof addGate>[0]);
    tool.set('look');
  }
}
