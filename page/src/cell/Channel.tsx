// The picture of the cell in its channel: colours on a canvas, lines above it, the value under the pointer.
import { useLayoutEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Fields } from '../draw/fields';
import { coverPixels, paintPixels, type Cover, type Paint } from '../draw/raster';
import { theme } from '../shell/theme';
import { useStore } from '../shell/store';
import { pixelFrame, stageOf, type Lens, type Stage } from './frame';
import { Lines } from './Lines';
import type { Looks } from './looks';
import { useProbe } from './probe';
import type { Scene } from './scene';
import { useGestures, useLens } from './use_lens';

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

/** Paints what the fields have, and mirrors it where that is the upper half alone. */
function paint(canvas: HTMLCanvasElement, stage: Stage, fields: Fields, paints: (Paint | null)[]): void {
  const frame = pixelFrame(stage, density(), fields.whole);
  canvas.width = frame.width;
  canvas.height = Math.round(stage.height * density());
  const context = canvas.getContext('2d')!;
  const image = context.createImageData(frame.width, frame.height);
  const pixels = new Uint32Array(image.data.buffer);
  paintPixels(fields, frame, paints, pixels);
  const axis = Math.round(stage.axis * density());
  const low = Math.round(frame.low_um * frame.pixels_per_um);
  context.putImageData(image, 0, axis - low - frame.height);
  if (fields.whole) return;
  pixels.reverse();
  for (let row = 0; row < frame.height; ++row) pixels.subarray(row * frame.width, (row + 1) * frame.width).reverse();
  context.putImageData(image, 0, axis + low);
}

/** Which triangle covers which pixel: found out when a value is asked for, and then kept. */
function coverOnDemand(stage: Stage, fields: Fields): () => Cover {
  let cover: Cover | null = null;
  return () => (cover ??= coverPixels(fields, pixelFrame(stage, density(), fields.whole)));
}

/** The same stage as long as its numbers are the same: what depends on it alone need not be drawn again. */
function useStage(size: { width: number; height: number }, { radius_um, fields }: Scene, lens: Lens): Stage | null {
  const found = useMemo(
    () => (size.width ? stageOf(size.width, size.height, radius_um, fields, lens) : null),
    [size, radius_um, fields, lens],
  );
  const kept = useRef(found);
  if (JSON.stringify(found) !== JSON.stringify(kept.current)) kept.current = found;
  return kept.current;
}

export function Channel({ scene, looks, stale }: ChannelProps) {
  const [box, size] = useSize();
  const canvas = useRef<HTMLCanvasElement | null>(null);
  const shownTheme = useStore(theme);
  const lens = useLens();
  const stage = useStage(size, scene, lens[0]);
  const gestures = useGestures(box, stage, lens);
  const { fields, paints } = scene;
  useLayoutEffect(() => {
    if (!stage || !canvas.current) return;
    if (fields) paint(canvas.current, stage, fields, paints);
    else canvas.current.width = canvas.current.height = 1;
  }, [stage, fields, paints]);
  useLayoutEffect(() => {
    if (stage) box.current!.dataset.shown = String(scene.revision);
  }, [stage, scene]);
  const cover = useMemo(() => (stage && fields ? coverOnDemand(stage, fields) : null), [stage, fields]);
  const probe = useProbe(stage, scene, cover);
  return (
    <div
      ref={box}
      class={stale ? 'channel stale' : 'channel'}
      tabIndex={0}
      role="group"
      aria-roledescription="picture"
      data-zoom={lens[0].zoom.toFixed(3)}
      aria-label="The cell in its channel. Arrow keys move a point whose values are read out; plus and minus stretch, 0 shows all."
      onPointerDown={(event) => (gestures.down(event) ? probe.leave() : probe.point(event))}
      onPointerMove={(event) => (gestures.move(event) ? probe.leave() : probe.point(event))}
      onPointerUp={gestures.up}
      onPointerCancel={gestures.up}
      onPointerLeave={(event) => event.pointerType !== 'touch' && probe.leave()}
      onDblClick={gestures.showAll}
      onKeyDown={(event) => (gestures.key(event), probe.press(event))}
      onBlur={probe.leave}
    >
      <canvas ref={canvas} aria-hidden="true" />
      {stage && <Lines stage={stage} scene={scene} looks={looks} theme={shownTheme} mark={probe.mark} />}
      {stage && probe.readout}
      {scene.title && <p class="seen-from">{scene.title}</p>}
      {lens[0].zoom > 1 && (
        <button class="show-all" onPointerDown={(event) => event.stopPropagation()} onClick={gestures.showAll}>
          Show all
        </button>
      )}
    </div>
  );
}
