// Where things stand in the picture of the channel: um to pixels, walls, scale bar, what is seen.
import type { Outline } from '../api';
import type { Fields } from '../draw/fields';
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
}

/** Walls take a fixed share of the height; long channels are cut at both sides. */
export function stageOf(width: number, height: number, radius_um: number, fields: Fields | null): Stage {
  const wall = 22;
  const scale = (height - 2 * wall) / (2 * radius_um);
  let middle_um = 0;
  if (fields) {
    const [low, high] = extentOf(fields);
    const half = width / scale / 2;
    middle_um = high - low > 2 * half ? Math.max(low + half, Math.min(high - half, 0)) : (low + high) / 2;
  }
  return { width, height, scale, middle_um, radius_um, axis: height / 2 };
}

function extentOf(fields: Fields): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let k = 0; k < fields.places.length; k += 2) {
    if (fields.places[k] < low) low = fields.places[k];
    if (fields.places[k] > high) high = fields.places[k];
  }
  return [low, high];
}

export const xOf = (stage: Stage, x_um: number) => stage.width / 2 + (x_um - stage.middle_um) * stage.scale;
export const yOf = (stage: Stage, r_um: number) => stage.axis - r_um * stage.scale;
export const leftOf = (stage: Stage) => stage.middle_um - stage.width / 2 / stage.scale;
export const rightOf = (stage: Stage) => stage.middle_um + stage.width / 2 / stage.scale;

/** Pixels of the upper half, at the screen's density. */
export function halfFrame(stage: Stage, density: number): Frame {
  return {
    width: Math.round(stage.width * density),
    height: Math.ceil(stage.radius_um * stage.scale * density),
    left_um: leftOf(stage),
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
