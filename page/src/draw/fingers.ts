// Fingers on a picture: what one or two of them hold on to, and where they take it.

/** From the left upper corner of an element, in pixels of the page. */
export type Pixel = [number, number];

/** What is held: the place between the fingers, and how far they are apart; of a single pointer 1. */
export interface Grip {
  middle: Pixel;
  distance: number;
}

export const gripAt = (middle: Pixel, distance = 1): Grip => ({ middle, distance });

export const pixelOf = (event: MouseEvent): Pixel => {
  const own = (event.currentTarget as Element).getBoundingClientRect();
  return [event.clientX - own.left, event.clientY - own.top];
};

/** The pointers that are down on an element. */
export class Fingers {
  private readonly places = new Map<number, Pixel>();

  put(id: number, at: Pixel): void {
    this.places.set(id, at);
  }

  move(id: number, at: Pixel): void {
    if (this.places.has(id)) this.places.set(id, at);
  }

  lift(id: number): void {
    this.places.delete(id);
  }

  get count(): number {
    return this.places.size;
  }

  /** What the first two fingers hold, or a single one; null without any. */
  grip(): Grip | null {
    const [first, second] = this.places.values();
    if (!first || !second) return first ? gripAt(first) : null;
    const distance = Math.max(8, Math.hypot(second[0] - first[0], second[1] - first[1]));
    return gripAt([(first[0] + second[0]) / 2, (first[1] + second[1]) / 2], distance);
  }
}
