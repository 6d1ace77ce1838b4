// Mouse, fingers and keyboard in a plot, with what is half drawn.
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { useStore } from '../shell/store';
import { tool } from './model';
import { Fingers, pixelOf, type Grip, type Pixel } from '../draw/fingers';
import { margins } from './plot_frame';
import { fingerReach, reach, type PlotActions } from './plot_actions';

export interface Drawing {
  points: [number, number][];
  closed: boolean;
  crosshair: Pixel | null;
  moving: boolean;
  onPointerDown(event: PointerEvent): void;
  onPointerMove(event: PointerEvent): void;
  onPointerUp(event: PointerEvent): void;
  onPointerCancel(event: PointerEvent): void;
  onKeyDown(event: KeyboardEvent): void;
}

type Corners = [number, number][];
const box = ([ax, ay]: [number, number], [bx, by]: [number, number]): Corners => [[ax, ay], [bx, ay], [bx, by], [ax, by]];

const reachOf = (event: PointerEvent) => (event.pointerType === 'touch' ? fingerReach : reach);

const steps: Record<string, Pixel> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** True for a moment after the last change of what is shown. */
function useMoving(...spans: number[]): boolean {
  const [moving, setMoving] = useState(false);
  const first = useRef(true);
  useEffect(() => {
    if (first.current) return void (first.current = false);
    setMoving(true);
    const timer = window.setTimeout(() => setMoving(false), 160);
    return () => window.clearTimeout(timer);
  }, spans);
  return moving;
}

/** Two fingers move and stretch a plot, with any tool: from the plot as it was when the second one came. */
function usePinch(actions: PlotActions | null) {
  const fingers = useRef(new Fingers()).current;
  const held = useRef<{ actions: PlotActions; grip: Grip } | null>(null);
  return {
    /** Whether a pinch begins. */
    down(event: PointerEvent): boolean {
      fingers.put(event.pointerId, pixelOf(event));
      const begins = fingers.count > 1 && actions !== null;
      if (begins) held.current = { actions, grip: fingers.grip()! };
      return begins;
    },
    /** Whether the fingers pinch. */
    move(event: PointerEvent): boolean {
      fingers.move(event.pointerId, pixelOf(event));
      if (held.current && fingers.count > 1) held.current.actions.pinch(held.current.grip, fingers.grip()!);
      return held.current !== null;
    },
    /** Whether a pinch ends, or goes on until the last finger is lifted. */
    up(event: PointerEvent): boolean {
      fingers.lift(event.pointerId);
      const pinched = held.current !== null;
      if (fingers.count === 0) held.current = null;
      return pinched;
    },
  };
}

export function useDrawing(actions: PlotActions | null): Drawing {
  const [points, setPoints] = useState<Corners>([]);
  const [crosshair, setCrosshair] = useState<Pixel | null>(null);
  const from = useRef<{ start: Pixel; last: Pixel; dragged: boolean } | null>(null);
  const mode = useStore(tool);
  const pinch = usePinch(actions);
  const ends = actions ? [actions.frame.x.low, actions.frame.x.high, actions.frame.y.low, actions.frame.y.high] : [];
  const moving = useMoving(...[0, 1, 2, 3].map((k) => ends[k] ?? 0));
  useLayoutEffect(() => setPoints([]), [mode]);

  /** A corner of the polygon, or of the box; on the first corner the polygon is closed. */
  const corner = (at: Pixel, within = reach) => {
    if (!actions) return;
    const place = actions.place(at);
    if (mode === 'box') {
      if (points.length === 0) return setPoints([place]);
      actions.addBox(points[0], place);
      return setPoints([]);
    }
    if (points.length >= 3 && actions.isOn(at, points[0], within)) return close();
    setPoints([...points, place]);
  };
  const close = () => {
    if (actions && points.length >= 3) actions.addPolygon(points);
    setPoints([]);
  };

  return {
    points: mode === 'box' && points.length === 1 && crosshair && actions ? box(points[0], actions.place(crosshair)) : points,
    closed: mode === 'box',
    crosshair,
    moving,
    onPointerDown(event) {
      if (!actions || event.button !== 0) return;
      (event.currentTarget as Element).setPointerCapture(event.pointerId);
      (event.currentTarget as HTMLElement).focus({ preventScroll: true });
      const at = pixelOf(event);
      setCrosshair(null);
      from.current = null;
      if (!pinch.down(event)) from.current = { start: at, last: at, dragged: false };
      else if (mode === 'box') setPoints([]);
    },
    onPointerMove(event) {
      if (pinch.move(event)) return;
      const drag = from.current;
      if (!actions || !drag) return;
      const at = pixelOf(event);
      if (Math.hypot(at[0] - drag.start[0], at[1] - drag.start[1]) > 4) drag.dragged = true;
      if (!drag.dragged) return;
      if (mode === 'look') {
        const { width, height } = actions.frame;
        actions.move(-(at[0] - drag.last[0]) / (width - margins.left - margins.right), (at[1] - drag.last[1]) / (height - margins.top - margins.bottom));
      } else if (mode === 'box') setPoints(box(actions.place(drag.start), actions.place(at)));
      drag.last = at;
    },
    onPointerUp(event) {
      const drag = from.current;
      from.current = null;
      if (pinch.up(event) || !actions || !drag) return;
      const at = pixelOf(event);
      if (mode === 'look' && !drag.dragged) actions.choose(at, reachOf(event));
      else if (mode === 'polygon') corner(at, reachOf(event));
      else if (mode === 'box' && drag.dragged) {
        actions.addBox(actions.place(drag.start), actions.place(at));
        setPoints([]);
      } else if (mode === 'box') corner(at);
    },
    onPointerCancel(event) {
      from.current = null;
      pinch.up(event);
    },
    onKeyDown(event) {
      if (!actions || event.ctrlKey || event.metaKey || event.altKey) return;
      const step = steps[event.key];
      const at = crosshair ?? actions.middle();
      if (step && event.shiftKey) setCrosshair(clamped(actions, [at[0] + 8 * step[0], at[1] + 8 * step[1]]));
      else if (step) actions.move(0.1 * step[0], -0.1 * step[1]);
      else if (event.key === '+' || event.key === '=') actions.zoom(1.25, crosshair ?? undefined);
      else if (event.key === '-') actions.zoom(0.8, crosshair ?? undefined);
      else if (event.key === '0') actions.fit();
      else if (event.key === 'n' || event.key === 'p') actions.step(event.key === 'n' ? 1 : -1);
      else if (event.key === 'b' || event.key === 'g') tool.set(event.key === 'b' ? 'box' : 'polygon');
      else if (event.key === 'Enter' && mode === 'look') actions.choose(at);
      else if (event.key === 'Enter') corner(at);
      else if (event.key === 'c' && mode === 'polygon') close();
      else if (event.key === 'Backspace' && points.length > 0) setPoints(points.slice(0, -1));
      else if (event.key === 'Escape') {
        tool.set('look');
        setPoints([]);
        setCrosshair(null);
      } else return;
      event.preventDefault();
    },
  };
}

function clamped({ frame }: PlotActions, [x, y]: Pixel): Pixel {
  return [
    Math.min(frame.width - margins.right, Math.max(margins.left, x)),
    Math.min(frame.height - margins.bottom, Math.max(margins.top, y)),
  ];
}
