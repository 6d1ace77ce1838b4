// Where the numbers of lines stand: as near to the lines' ends as there is room, none on another. All in pixels.
export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export interface NamedLine {
  text: string;
  points: [number, number][];
  /** Where the text stands if that is free. */
  wanted?: Box;
}

const height = 13;
const room = 1;
const size = 12;
/** Of letters and digits of a size, all of it in pixels. */
export const widthOf = (text: string, ofSize = size) => ofSize * [...text].reduce((sum, sign) => sum + ('. '.includes(sign) ? 0.32 : 0.62), 0);

const overlap = (a: Box, b: Box) => a.left < b.right + room && b.left < a.right + room && a.top < b.bottom + room && b.top < a.bottom + room;
const isWithin = (a: Box, b: Box) => a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;

/** Above the line, with its end at the point. */
function boxAt([x, y]: [number, number], text: string): Box {
  return { left: x - 3 - widthOf(text), right: x - 3, top: y - 4 - height, bottom: y - 4 };
}

/**
 * For each line the box of its text: the wanted one, or that at the last point where it lies within the frame and on no
 * other text and nothing that is taken; null where there is no such point.
 */
export function placeLabels(lines: NamedLine[], frame: Box, taken: Box[] = []): (Box | null)[] {
  const occupied = [...taken];
  return lines.map(({ text, points, wanted }) => {
    const isFree = (box: Box) => isWithin(box, frame) && !occupied.some((other) => overlap(box, other));
    const boxes = [...(wanted ? [wanted] : []), ...[...points].reverse().map((point) => boxAt(point, text))];
    const box = boxes.find(isFree) ?? null;
    if (box) occupied.push(box);
    return box;
  });
}
