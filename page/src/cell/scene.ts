// What the picture of the channel shows at one moment.
import type { Outline } from '../api';
import type { Fields } from '../draw/fields';
import type { Paint } from '../draw/raster';

export interface Scene {
  /** from where it is seen, if that must be said */
  title: string;
  fields: Fields | null;
  paints: (Paint | null)[];
  contour: Outline | null;
  hull: Outline | null;
  undeformed_um: number;
  radius_um: number;
  revision: number;
  /** the wall of a channel that is not straight, relative to the cell */
  wall?: Outline;
}
