// The shape in three dimensions of a cell in a duct; three.js is loaded when it is first shown.
import { useEffect, useRef, useState } from 'preact/hooks';
import type { Case } from '../api';
import type { Fields } from '../draw/fields';
import { theme } from '../shell/theme';
import { useStore } from '../shell/store';
import { straightSize } from './cameras';
import type { SolidView } from './solid3d';

interface SolidProps {
  solid: NonNullable<Fields['surface3d']>;
  of: Case;
  stale: boolean;
}

export function Solid({ solid, of, stale }: SolidProps) {
  const box = useRef<HTMLDivElement | null>(null);
  const [view, setView] = useState<SolidView | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  const shownTheme = useStore(theme);
  useEffect(() => {
    let made: SolidView | null = null;
    let gone = false;
    const show = ({ SolidView: Made }: typeof import('./solid3d')) => {
      if (gone) return;
      made = new Made(box.current!);
      setView(made);
    };
    import('./solid3d').then(show).catch(() => setFailure('This browser draws no 3D pictures (WebGL is not there).'));
    return () => {
      gone = true;
      made?.dispose();
    };
  }, []);
  useEffect(() => {
    const camera_degree = Number(of['channel.camera_degree'] ?? (of['channel.camera'] === 'diagonal' ? 45 : 0));
    view?.show({ ...solid, ...straightSize(of), camera_degree });
  }, [view, solid, of, shownTheme]);
  return (
    <div
      ref={box}
      class={stale ? 'solid stale' : 'solid'}
      tabIndex={0}
      role="group"
      aria-roledescription="3D picture"
      aria-label="The cell in three dimensions. Arrow keys turn it, plus and minus move nearer and farther."
      onKeyDown={(event) => view?.key(event)}
    >
      {failure && <p class="waiting">{failure}</p>}
    </div>
  );
}
