// The picture of the channel is moved and stretched: two fingers, the wheel, plus and minus; what is stretched is dragged.
import { useRef, useState } from 'preact/hooks';
import { Fingers, gripAt, pixelOf, type Grip, type Pixel } from '../draw/fingers';
import { useWheel } from '../draw/use_wheel';
import { held, wholePicture, type Lens, type Stage } from './frame';

interface Hold {
  stage: Stage;
  lens: Lens;
  grip: Grip;
  /** Fingers move it as soon as there are two, a single pointer when it has left its place. */
  moves: boolean;
}

export interface Gestures {
  showAll(): void;
  /** Both: whether the picture is moved, so that nothing is read off. */
  down(event: PointerEvent): boolean;
  move(event: PointerEvent): boolean;
  up(event: PointerEvent): void;
  key(event: KeyboardEvent): void;
}

const least = 4; // pixels that are a movement
const keyFactors: Record<string, number> = { '+': 1.25, '=': 1.25, '-': 0.8 };

/** What is seen of the picture: the lens, which a stage is made of. */
export const useLens = () => useState<Lens>(wholePicture);

export function useGestures(box: { current: HTMLElement | null }, stage: Stage | null, [lens, setLens]: ReturnType<typeof useLens>): Gestures {
  const fingers = useRef(new Fingers()).current;
  const hold = useRef<Hold | null>(null);
  /** One pointer drags what is stretched, two fingers anything; a picture that is whole is only looked at. */
  const grasp = () => {
    const grip = fingers.grip();
    const several = fingers.count > 1;
    hold.current = grip && stage && (several || lens.zoom > 1) ? { stage, lens, grip, moves: several } : null;
  };
  const stretch = (factor: number, at: Pixel) => stage && setLens(held(stage, lens, gripAt(at), gripAt(at, factor)));
  useWheel(box, stretch);
  return {
    showAll: () => setLens(wholePicture),
    down(event) {
      if (event.button !== 0) return false;
      (event.currentTarget as Element).setPointerCapture(event.pointerId);
      fingers.put(event.pointerId, pixelOf(event));
      grasp();
      return hold.current?.moves ?? false;
    },
    move(event) {
      fingers.move(event.pointerId, pixelOf(event));
      const [start, now] = [hold.current, fingers.grip()];
      if (!start || !now) return false;
      const [right, down] = [now.middle[0] - start.grip.middle[0], now.middle[1] - start.grip.middle[1]];
      start.moves ||= Math.hypot(right, down) > least;
      if (start.moves) setLens(held(start.stage, start.lens, start.grip, now));
      return start.moves;
    },
    up(event) {
      fingers.lift(event.pointerId);
      grasp();
    },
    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === '0') setLens(wholePicture);
      else if (event.key in keyFactors && stage) stretch(keyFactors[event.key], [stage.width / 2, stage.height / 2]);
      else return;
      event.preventDefault();
    },
  };
}
