// The size of an element on the screen, as it changes.
import { useEffect, useRef, useState } from 'preact/hooks';

export function useSize<Kind extends HTMLElement>() {
  const element = useRef<Kind>(null);
  const [size, setSize] = useState({ width: 0, height: 0 });
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => {
      const { width, height } = entry.contentRect;
      setSize({ width: Math.floor(width), height: Math.floor(height) });
    });
    observer.observe(element.current!);
    return () => observer.disconnect();
  }, []);
  return { element, ...size };
}
