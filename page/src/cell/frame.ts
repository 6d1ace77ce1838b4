// Where things stand in the picture of the channel: um to pixels, walls, scale bar, what is seen.
import type { Outline } from '../api';
import { extentOf, type Fields } from '../draw/fields';
import type { Grip } from '../draw/fingers';
import type { Frame } from '../draw/raster';
import { roundStep } from '../draw/numbers';

export interface Stage {
  width: number;
  height: number;
  /** pixels per um */
  scale: number;
  /** the middle of the picture, um along the channel */
  middle_um: number;
  /** greatest radius of the wall in the picture */
  radius_um: number;
  /** y of the axis */
  axis: number;
  /** ends of the picture before it is stretched, um along the channel */
  whole_um: [number, number];
}

/** What is seen of the picture: how much it is stretched, and what is in the middle (along the channel: as it comes). */
export interface Lens {
  zoom: number;
  x_um: number | null;
  r_um: number;
}

export const wholePicture: Lens = { zoom: 1, x_um: null, r_um: 0 };
const greatestZoom = 12;

const between = (low: number, high: number, value: number) => Math.max(low, Math.min(high, value));

/** Walls take a fixed fraction of the height; long channels are cut at both sides. */
export function stageOf(width: number, height: number, radius_um: number, fields: Fields | null, lens = wholePicture): Stage {
  const wall = 22;
  const plain = (height - 2 * wall) / (2 * radius_um);
  const extent = fields && extentOf(fields);
  const middle = (scale: number, wanted: number) => {
    if (!extent) return wanted;
    const half = width / scale / 2;
    return extent[1] - extent[0] > 2 * half ? between(extent[0] + half, extent[1] - half, wanted) : (extent[0] + extent[1]) / 2;
  };
  const scale = plain * lens.zoom;
  const whole = middle(plain, 0);
  const farthest = height / 2 / plain - height / 2 / scale;
  return {
    width,
    height,
    scale,
    middle_um: middle(scale, lens.x_um ?? 0),
    radius_um,
    axis: height / 2 + between(-farthest, farthest, lens.r_um) * scale,
    whole_um: [whole - width / 2 / plain, whole + width / 2 / plain],
  };
}

/** The lens through which what was held stays under the fingers. */
export function held(stage: Stage, lens: Lens, from: Grip, to: Grip): Lens {
  const zoom = Math.min(greatestZoom, (lens.zoom * to.distance) / from.distance);
  if (zoom <= 1) return wholePicture;
  const scale = (stage.scale * zoom) / lens.zoom;
  const x_um = leftOf(stage) + from.middle[0] / stage.scale;
  const r_um = (stage.axis - from.middle[1]) / stage.scale;
  return { zoom, x_um: x_um - (to.middle[0] - stage.width / 2) / scale, r_um: r_um + (to.middle[1] - stage.height / 2) / scale };
}

export const xOf = (stage: Stage, x_um: number) => stage.width / 2 + (x_um - stage.middle_um) * stage.scale;
export const yOf = (stage: Stage, r_um: number) => stage.axis - r_um * stage.scale;
export const leftOf = (stage: Stage) => stage.middle_um - stage.width / 2 / stage.scale;
export const rightOf = (stage: Stage) => stage.middle_um + stage.width / 2 / stage.scale;

/** Pixels at the screen's density: of all that is in sight, or of the upper half as far as it, or its mirror image, is. */
export function pixelFrame(stage: Stage, density: number, whole: boolean): Frame {
  const [above, below] = [stage.axis / stage.scale, (stage.axis - stage.height) / stage.scale];
  const low_um = whole ? below : Math.max(0, below, -above);
  const high_um = whole ? above : Math.max(above, -below);
  return {
    width: Math.round(stage.width * density),
    height: Math.max(1, Math.ceil((high_um - low_um) * stage.scale * density)),
    left_um: leftOf(stage),
    low_um,
    pixels_per_um: stage.scale * density,
  };
}

const at = (stage: Stage, x: number, r: number) => `${xOf(stage, x).toFixed(2)} ${yOf(stage, r).toFixed(2)}`;

export function pathOf(stage: Stage, { x_um, r_um }: Outline, closed = true): string {
  return `M${x_um.map((x, k) => at(stage, x, r_um[k])).join('L')}${closed ? 'Z' : ''}`;
}

/** Whether an outline is only the upper half; it is mirrored then. */
export function wholeOutline(outline: Outline): Outline {
  if (outline.r_um.some((r) => r < -1e-6)) return outline;
  const back = [...outline.x_um.keys()].reverse();
  return {
    x_um: [...outline.x_um, ...back.map((k) => outline.x_um[k])],
    r_um: [...outline.r_um, ...back.map((k) => -outline.r_um[k])],
  };
}

/** The wall above or below: the given one, or a straight line; as an area up to the edge of the picture. */
export function wallPath(stage: Stage, wall: Outline | undefined, side: 1 | -1): string {
  const straight = { x_um: [leftOf(stage), rightOf(stage)], r_um: [stage.radius_um, stage.radius_um] };
  const given = wall && wall.x_um.length > 1 ? wall : straight;
  const edge = side === 1 ? 0 : stage.height;
  const along = given.x_um.map((x, k) => at(stage, x, side * given.r_um[k]));
  return `M0 ${edge}L0 ${along[0].split(' ')[1]}L${along.join('L')}L${stage.width} ${along[along.length - 1].split(' ')[1]}L${stage.width} ${edge}Z`;
}

/** A round length that takes about a sixth of the picture. */
export const scaleBar_um = (stage: Stage) => roundStep(stage.width / stage.scale / 5);
