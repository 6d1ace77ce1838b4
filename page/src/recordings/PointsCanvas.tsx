// The events of a plot, drawn whenever plot, gates, size or theme change; while the plot moves on a slow machine, every
// second or third event stands for all.
import { useEffect, useRef } from 'preact/hooks';
import { densityMap } from '../draw/colormap';
import { theme } from '../shell/theme';
import { useStore } from '../shell/store';
import type { PlotData } from './plot_data';
import { innerHeight, innerWidth, margins, type Frame } from './plot_frame';
import { colourByDensity, colourByMean, paint, PixelCounts, radiusFor, type View } from './points';

/** A frame of 30 ms leaves time for everything else at 20 frames a second. */
const wantedTime = 30;
const muted = { light: 0xffd6cfc8, dark: 0xff4f4338 };
const none = { light: 0xffa89c90, dark: 0xff8a7d70 };

class Painter {
  private readonly counts = new PixelCounts();
  private picture: ImageData | null = null;
  private timeOfAll = 0;

  draw(canvas: HTMLCanvasElement, data: PlotData, view: View, moving: boolean): void {
    const start = performance.now();
    const every = moving ? Math.max(1, Math.ceil(this.timeOfAll / wantedTime)) : 1;
    if (canvas.width !== view.width || canvas.height !== view.height) {
      canvas.width = view.width;
      canvas.height = view.height;
    }
    this.counts.count(data.places, data.mask, view, every);
    if (data.colour) this.counts.sum(data.places, data.mask, view, data.colour.values, every);
    this.fill(canvas, data, view, every);
    if (every === 1) this.timeOfAll = performance.now() - start;
    canvas.dataset.events = String(this.counts.seen * every);
  }

  private fill(canvas: HTMLCanvasElement, data: PlotData, view: View, every: number): void {
    if (this.picture?.width !== view.width || this.picture.height !== view.height)
      this.picture = new ImageData(view.width, view.height);
    const now = theme.get();
    const colour = data.colour
      ? colourByMean(this.counts, data.colour.range, densityMap.pixels, none[now])
      : data.density
        ? colourByDensity(data.density, view, densityMap.pixels)
        : () => none[now];
    const ratio = window.devicePixelRatio || 1;
    const look = { muted: muted[now], radius: radiusFor(this.counts.seen * every, ratio) };
    paint(new Uint32Array(this.picture.data.buffer), this.counts, view, look, colour);
    canvas.getContext('2d')!.putImageData(this.picture, 0, 0);
  }
}

interface PointsCanvasProps {
  data: PlotData | null;
  frame: Frame;
  moving: boolean;
}

export function PointsCanvas({ data, frame, moving }: PointsCanvasProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<Painter | null>(null);
  const shownTheme = useStore(theme);
  const width = innerWidth(frame);
  const height = innerHeight(frame);
  useEffect(() => {
    const request = window.requestAnimationFrame(() => {
      if (!canvas.current) return;
      if (!data) return canvas.current.getContext('2d')!.clearRect(0, 0, canvas.current.width, canvas.current.height);
      painter.current ??= new Painter();
      const ratio = window.devicePixelRatio || 1;
      const view = { x: frame.x, y: frame.y, width: Math.round(width * ratio), height: Math.round(height * ratio) };
      painter.current.draw(canvas.current, data, view, moving);
    });
    return () => window.cancelAnimationFrame(request);
  }, [data, frame.x.low, frame.x.high, frame.y.low, frame.y.high, width, height, moving, shownTheme]);
  return (
    <canvas
      ref={canvas}
      class="plot-points"
      aria-hidden="true"
      style={{ left: margins.left, top: margins.top, width, height }}
    />
  );
}
