// The workspace "Cell": controls, the picture, the numbers, and the plane of area and deformation.
import type { ComponentChildren } from 'preact';
import { useEffect } from 'preact/hooks';
import { notifyFailure } from '../shell/notices';
import { useStore } from '../shell/store';
import { Controls } from './Controls';
import * as model from './model';
import { Numbers } from './Numbers';
import { Plane } from './Plane';
import { View } from './View';
import '../look/cell.css';

/** Its parts are not drawn again when only the work changes. */
function Frame({ children }: { children: ComponentChildren }) {
  const working = useStore(model.working);
  return (
    <div class="cell" data-working={working}>
      {children}
    </div>
  );
}

export function CellWorkspace() {
  useEffect(() => void model.startCell().catch(notifyFailure), []);
  return (
    <Frame>
      <Controls />
      <View />
      <aside class="side" aria-label="Numbers">
        <Numbers />
      </aside>
      <Plane />
    </Frame>
  );
}
