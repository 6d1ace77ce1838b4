// Where the numbers of lines stand: as near to the lines' ends as there is room, none on another.
export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export interface Label {
  /** The lower right corner of the text. */
  x: number;
  y: number;
}

const height = 13;
const room = 3;
/** Digits and points of the plot's numbers are at most so wide. */
const widthOf = (text: string) => 7 * text.length;

const overlap = (a: Box, b: Box) => a.left < b.right + room && b.left < a.right + room && a.top < b.bottom + room && b.top < a.bottom + room;
const isWithin = (a: Box, b: Box) => a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;

/**
 * For each line, given by its points in pixels, the place of its text at the last point where it lies within the frame
 * and on no other text and nothing that is taken; null where there is no such point.
 */
export function placeLabels(lines: { text: string; points: [number, number][] }[], frame: Box, taken: Box[]): (Label | null)[] {
  const occupied = [...taken];
  return lines.map(({ text, points }) => {
    for (let k = points.length - 1; k >= 0; --k) {
      const [x, y] = [points[k][0] - 3, points[k][1] - 4];
      const box = { left: x - widthOf(text), right: x, top: y - height, bottom: y };
      if (!isWithin(box, frame) || occupied.some((other) => overlap(box, other))) continue;
      occupied.push(box);
      return { x, y };
    }
    return null;
  });
}
