// The workplace "Cell": controls, the picture, the numbers, and the plane of area and deformation.
import { useEffect } from 'preact/hooks';
import { notifyFailure } from '../shell/notices';
import { useStore } from '../shell/store';
import { Controls } from './Controls';
import * as model from './model';
import { Numbers } from './Numbers';
import { Plane } from './Plane';
import { View } from './View';
import '../look/cell.css';

export function CellWorkplace() {
  const working = useStore(model.working);
  useEffect(() => void model.startCell().catch(notifyFailure), []);
  return (
    <div class="cell" data-working={working}>
      <Controls />
      <View />
      <aside class="side" aria-label="Numbers">
        <Numbers />
      </aside>
      <Plane />
    </div>
  );
}
