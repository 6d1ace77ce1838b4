// The picture of the cell in its channel: colours on a canvas, lines above it, the value under the pointer.
import { useLayoutEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Outline } from '../api';
import type { Fields } from '../draw/fields';
import { coverPixels, paintPixels, type Cover, type Paint } from '../draw/raster';
import { theme } from '../shell/theme';
import { useStore } from '../shell/store';
import { halfFrame, stageOf, type Stage } from './frame';
import { Lines } from './Lines';
import type { Looks } from './looks';
import { useProbe } from './probe';

export interface Scene {
  fields: Fields | null;
  paints: (Paint | null)[];
  contour: Outline | null;
  hull: Outline | null;
  undeformed_um: number;
  radius_um: number;
  /** place of the cell along the channel, um */
  place_um: number;
  revision: number;
  /** the wall of a channel that is not straight, relative to the cell */
  wall?: Outline;
}

interface ChannelProps {
  scene: Scene;
  looks: Looks;
  stale: boolean;
}

const density = () => Math.min(window.devicePixelRatio || 1, 2);

/** The size of an element in whole pixels. */
function useSize(): [{ current: HTMLDivElement | null }, { width: number; height: number }] {
  const box = useRef<HTMLDivElement | null>(null);
  const [size, setSize] = useState({ width: 0, height: 0 });
  useLayoutEffect(() => {
    const measure = () => {
      const { clientWidth: width, clientHeight: height } = box.current!;
      setSize((now) => (now.width === width && now.height === height ? now : { width, height }));
    };
    const observer = new ResizeObserver(measure);
    observer.observe(box.current!);
    measure();
    return () => observer.disconnect();
  }, []);
  return [box, size];
}

/** Paints the upper half and mirrors it; returns which triangle covers which pixel. */
function paint(canvas: HTMLCanvasElement, stage: Stage, fields: Fields, paints: (Paint | null)[]): Cover {
  const frame = halfFrame(stage, density());
  const cover = coverPixels(fields, frame);
  canvas.width = frame.width;
  canvas.height = Math.round(stage.height * density());
  const context = canvas.getContext('2d')!;
  const image = context.createImageData(frame.width, 2 * frame.height);
  const pixels = new Uint32Array(image.data.buffer);
  paintPixels(fields, cover, paints, pixels);
  for (let row = 0; row < frame.height; ++row) {
    const from = (frame.height - 1 - row) * frame.width;
    pixels.copyWithin((frame.height + row) * frame.width, from, from + frame.width);
  }
  context.putImageData(image, 0, Math.round(stage.axis * density()) - frame.height);
  return cover;
}

/** No fields, no values under the pointer. */
function clear(canvas: HTMLCanvasElement): null {
  canvas.width = canvas.height = 1;
  return null;
}

export function Channel({ scene, looks, stale }: ChannelProps) {
  const [box, size] = useSize();
  const canvas = useRef<HTMLCanvasElement | null>(null);
  const cover = useRef<Cover | null>(null);
  const shownTheme = useStore(theme);
  const stage = useMemo(
    () => (size.width ? stageOf(size.width, size.height, scene.radius_um, scene.fields) : null),
    [size, scene],
  );
  useLayoutEffect(() => {
    if (!stage || !canvas.current) return;
    if (scene.fields) cover.current = paint(canvas.current, stage, scene.fields, scene.paints);
    else cover.current = clear(canvas.current);
    box.current!.dataset.shown = String(scene.revision);
  }, [stage, scene, looks]);
  const probe = useProbe(stage, scene, cover);
  return (
    <div
      ref={box}
      class={stale ? 'channel stale' : 'channel'}
      tabIndex={0}
      role="group"
      aria-roledescription="picture"
      aria-label="The cell in its channel. Arrow keys move a point whose values are read out."
      {...probe.handlers}
    >
      <canvas ref={canvas} aria-hidden="true" />
      {stage && <Lines stage={stage} scene={scene} looks={looks} theme={shownTheme} mark={probe.mark} />}
      {stage && probe.readout}
    </div>
  );
}
