// What cameras see of a cell on its way: its outline and the walls in their planes.
import type { Case, Outline, TimeStep } from '../api';

export interface Sight {
  /** empty where all cameras see the same */
  title: string;
  contour: Outline;
  /** of a channel that is not straight, relative to the cell */
  wall?: Outline;
  /** what is seen on either side of the axis */
  radius_um: number;
}

/** Along the height, and along the width of the channel. */
const [fromAbove, fromSide] = ['From above', 'From the side'];

type Wall = Pick<Sight, 'wall' | 'radius_um'>;

/** Of the least distance of the wall from the axis: so much is shown on either side of it, and not all of a wide channel. */
const shownOfWide = 2.5;

/** A wall whose distances from the axis are given at places along the channel, which says how much is shown. */
function profiled(wall: Outline | undefined, distance_um: number[] | undefined, straight_um: number): Wall {
  if (!distance_um) return { radius_um: straight_um };
  return { wall, radius_um: Math.min(Math.max(...distance_um), shownOfWide * Math.min(...distance_um)) };
}

const isDuct = (of: Case) => (of['channel.section'] ?? 'tube') !== 'tube';

/** Of the channel where it is straight: a funnel leads into its least width, which is its height, too, unless that is given. */
export function straightSize(of: Case): { width_um: number; height_um: number } {
  const widths_um = of['channel.profile.width_um'] as number[] | undefined;
  const width_um = Number(of['channel.width_um'] ?? (widths_um ? Math.min(...widths_um) : 20));
  return { width_um, height_um: Number(of['channel.height_um'] ?? width_um) };
}

/** Half the height of the picture of a straight channel: the tube's radius, or half of what the camera sees of a duct. */
export function halfOfStraight(of: Case, tubeRadius_um?: number): number {
  const { width_um, height_um } = straightSize(of);
  if (!isDuct(of)) return tubeRadius_um ?? Number(of['channel.radius_um'] ?? 0.547 * width_um);
  const aside = titleOfAside(of);
  if (aside) return (aside === fromSide ? height_um : width_um) / 2;
  return (of['channel.section'] === 'rectangle' && looksAlongWidth(of) ? height_um : width_um) / 2;
}

/** A cell off the axis is shown in the plane of its offset; a title is wanted then. */
export function titleOfAside(of: Case): string {
  const [width_um, height_um] = (of['cell.offset_um'] as number[] | undefined) ?? [0, 0];
  return height_um ? fromSide : width_um ? fromAbove : '';
}

const looksAlongWidth = (of: Case) => Number(of['channel.camera_degree'] ?? 0) > 45;

/** The chosen camera's first; of a duct that is not alike along height and width, both. */
export function sightsOf(of: Case, { contour, contours, wall }: Pick<TimeStep, 'contour' | 'contours' | 'wall'>): Sight[] {
  if (!isDuct(of)) {
    return [{ title: '', contour, ...profiled(wall, of['channel.profile.R_um'] as number[] | undefined, halfOfStraight(of)) }];
  }
  const halfWidths_um = (of['channel.profile.width_um'] as number[] | undefined)?.map((width) => width / 2);
  const { width_um, height_um } = straightSize(of);
  const above = { title: fromAbove, ...profiled(wall, halfWidths_um, width_um / 2) };
  const beside = { title: fromSide, radius_um: height_um / 2 };
  const aside = titleOfAside(of);
  if (aside) return [{ ...(aside === fromSide ? beside : above), contour }];
  if (!contours?.across) return [{ ...above, title: '', contour }];
  const both = [
    { ...above, contour: contours.side },
    { ...beside, contour: contours.across },
  ];
  return looksAlongWidth(of) ? both.reverse() : both;
}
