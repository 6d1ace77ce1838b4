// What is left between the measured outline and the model's contour, along the contour.
import type { Curve } from '../api';

export interface Residual {
  /** About the outline's centroid, from the direction of flow, -180..180 degrees, ascending; y points upwards. */
  angle_deg: number[];
  /** Positive where the measured outline lies outside. */
  distance_um: number[];
}

/** Centroid of the area of a closed polygon. */
export function centroid({ x_um, y_um }: Curve): [number, number] {
  let area = 0;
  let x = 0;
  let y = 0;
  for (let i = 0, j = x_um.length - 1; i < x_um.length; j = i++) {
    const cross = x_um[j] * y_um[i] - x_um[i] * y_um[j];
    area += cross;
    x += (x_um[i] + x_um[j]) * cross;
    y += (y_um[i] + y_um[j]) * cross;
  }
  return [x / (3 * area), y / (3 * area)];
}

/** The residual at each point of the outline, in the order of angles. In images y points downwards. */
export function alongAngles(outline: Curve, residual_um: number[]): Residual {
  const [cx, cy] = centroid(outline);
  const points = outline.x_um.map((x, k) => ({
    angle: (Math.atan2(cy - outline.y_um[k], x - cx) * 180) / Math.PI,
    distance: residual_um[k],
  }));
  points.sort((a, b) => a.angle - b.angle);
  return { angle_deg: points.map((point) => point.angle), distance_um: points.map((point) => point.distance) };
}
