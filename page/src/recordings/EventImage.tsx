// The image of an event at true scale: mask, outline, and the contour of the model's cell over it.
import { useEffect, useState } from 'preact/hooks';
import { addressOfPicture, eventPicture, type EventDetail } from '../api';
import { store, useStore } from '../shell/store';
import type { Choice } from './model';

type Layer = 'mask' | 'outline' | 'model';
const layers: [Layer, string][] = [
  ['mask', 'Mask'],
  ['outline', 'Outline'],
  ['model', 'Model'],
];
/** Stays as it is from event to event. */
const visible = store<Record<Layer, boolean>>({ mask: false, outline: true, model: true });

interface Picture {
  element: HTMLImageElement | null;
  missing: boolean;
}

function usePicture(address: string): Picture {
  const [picture, setPicture] = useState<Picture>({ element: null, missing: false });
  useEffect(() => {
    const element = new Image();
    element.onload = () => setPicture({ element, missing: false });
    element.onerror = () => setPicture({ element: null, missing: true });
    addressOfPicture(address).then(
      (found) => void (element.src = found),
      () => element.onerror && setPicture({ element: null, missing: true }),
    );
    return () => void (element.onload = element.onerror = null);
  }, [address]);
  return picture;
}

/** What of the image is shown, in um: the cell with some room, as far as the image reaches. */
function windowOf(detail: EventDetail, pixel: number, picture: HTMLImageElement | null) {
  const outline = detail.outline ?? detail.model;
  const image = picture ? { width: picture.naturalWidth * pixel, height: picture.naturalHeight * pixel } : null;
  if (!outline) return { x: 0, y: 0, width: image?.width ?? 1, height: image?.height ?? 1 };
  const [left, right] = [Math.min(...outline.x_um), Math.max(...outline.x_um)];
  const [top, bottom] = [Math.min(...outline.y_um), Math.max(...outline.y_um)];
  const height = Math.max(1.5 * (bottom - top), 1.1 * (right - left));
  const width = 1.45 * height;
  return { x: (left + right - width) / 2, y: (top + bottom - height) / 2, width, height };
}

const path = (curve: { x_um: number[]; y_um: number[] }) =>
  `M${curve.x_um.map((x, k) => `${x.toFixed(3)} ${curve.y_um[k].toFixed(3)}`).join('L')}Z`;

/** One, two or five times a power of ten um, at most a third of the width. */
function barOf(width: number): number {
  const third = width / 3;
  const power = 10 ** Math.floor(Math.log10(third));
  return power * ([5, 2, 1].find((lead) => lead * power <= third) ?? 1);
}

interface ViewProps {
  chosen: Choice;
  detail: EventDetail;
}

function View({ chosen, detail }: ViewProps) {
  const shown = useStore(visible);
  const image = usePicture(eventPicture('image', chosen.item, chosen.event, detail.version));
  const mask = usePicture(eventPicture('mask', chosen.item, chosen.event, detail.version));
  const pixel = detail.pixel_um || 1;
  const { x, y, width, height } = windowOf(detail, pixel, image.element ?? mask.element);
  const bar = barOf(width);
  if (image.missing && !detail.outline && !detail.model) return <p class="soft">The recording has no image of this event.</p>;
  const size = (picture: HTMLImageElement) => ({ width: picture.naturalWidth * pixel, height: picture.naturalHeight * pixel });
  return (
    <>
      <svg class="event-image" viewBox={`${x} ${y} ${width} ${height}`} role="img" aria-label={spoken(detail, image.missing)}>
        <rect class="ground" x={x} y={y} width={width} height={height} />
        {image.element && <image href={image.element.src} {...size(image.element)} preserveAspectRatio="none" />}
        {shown.mask && mask.element && (
          <>
            <mask id="event-mask">
              <image href={mask.element.src} {...size(mask.element)} preserveAspectRatio="none" />
            </mask>
            <rect class="event-mask" mask="url(#event-mask)" {...size(mask.element)} />
          </>
        )}
        {shown.outline && detail.outline && <path class="event-outline" d={path(detail.outline)} />}
        {shown.model && detail.model && <path class="model-halo" d={path(detail.model)} />}
        {shown.model && detail.model && <path class="model-contour" d={path(detail.model)} />}
        {shown.model && detail.combined?.contour && <path class="model-cortex" d={path(detail.combined.contour)} />}
        <g class="scale-bar">
          <path d={`M${x + 0.05 * width} ${y + 0.93 * height}h${bar}`} />
          <text x={x + 0.05 * width} y={y + 0.905 * height} font-size={0.05 * height}>
            {bar} {detail.pixel_um ? 'µm' : 'px'}
          </text>
        </g>
      </svg>
      {image.missing && <p class="soft">The recording has no image of this event.</p>}
    </>
  );
}

const spoken = (detail: EventDetail, missing: boolean) =>
  `${missing ? 'Outline' : 'Image'} of the event${detail.model ? " with the contour of the model's cell" : ''}`;

export function EventImage(props: ViewProps) {
  const shown = useStore(visible);
  return (
    <div class="event-picture">
      <View {...props} />
      <div class="row layers" role="group" aria-label="Layers of the image">
        {layers.map(([name, title]) => (
          <label key={name} class={`check layer-${name}`}>
            <input
              type="checkbox"
              checked={shown[name]}
              onChange={({ currentTarget }) => visible.update((all) => ({ ...all, [name]: currentTarget.checked }))}
            />
            {title}
          </label>
        ))}
      </div>
    </div>
  );
}
