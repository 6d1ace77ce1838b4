// The wheel stretches a picture.
import { useEffect, useRef } from 'preact/hooks';
import type { Pixel } from './fingers';

/** Calls `stretch` with a factor and the place of the pointer; the page must not scroll, so the listener may not be passive. */
export function useWheel(box: { current: HTMLElement | null }, stretch: (factor: number, at: Pixel) => void): void {
  const latest = useRef(stretch);
  latest.current = stretch;
  useEffect(() => {
    const element = box.current!;
    const turn = (event: WheelEvent) => {
      event.preventDefault();
      const own = element.getBoundingClientRect();
      latest.current(Math.exp(-0.0015 * event.deltaY), [event.clientX - own.left, event.clientY - own.top]);
    };
    element.addEventListener('wheel', turn, { passive: false });
    return () => element.removeEventListener('wheel', turn);
  }, [box]);
}
