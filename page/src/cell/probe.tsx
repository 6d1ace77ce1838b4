// The value under the pointer, or under a mark that the arrow keys move.
import { useState } from 'preact/hooks';
import { scalarField } from '../draw/fields';
import { significant } from '../draw/numbers';
import { regionAt, valueAt, type Cover } from '../draw/raster';
import type { Scene } from './scene';
import { leftOf, xOf, yOf, type Stage } from './frame';
import { cellFields, liquidFields } from './looks';

interface Spot {
  x_um: number;
  r_um: number;
  byKey: boolean;
}

const keySteps: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** The fields at a spot, in the words of the legends. */
function valuesAt(scene: Scene, cover: Cover, { x_um, r_um }: Spot): string[] {
  const { fields } = scene;
  const region = fields && regionAt(fields, cover, x_um, r_um);
  if (!fields || region === null) return [];
  return (region === 0 ? liquidFields : cellFields).flatMap(({ name, title, unit, factor }) => {
    const values = scalarField(fields, name);
    const value = values && valueAt(fields, cover, values, x_um, r_um);
    return value === null ? [] : [`${title} ${significant(factor * value)} ${unit}`];
  });
}

function Readout({ stage, spot, sentences }: { stage: Stage; spot: Spot; sentences: string[] }) {
  const right = xOf(stage, spot.x_um) > stage.width - 260;
  const left = Math.max(4, xOf(stage, spot.x_um) + (right ? -252 : 16));
  const top = Math.min(stage.height - 96, Math.max(4, yOf(stage, spot.r_um) + 12));
  return (
    <div class="readout" style={{ left: `${left}px`, top: `${top}px` }} aria-live={spot.byKey ? 'polite' : 'off'}>
      <p>{`x ${spot.x_um.toFixed(2)} µm, r ${spot.r_um.toFixed(2)} µm`}</p>
      {sentences.map((sentence) => (
        <p key={sentence}>{sentence}</p>
      ))}
    </div>
  );
}

export function useProbe(stage: Stage | null, scene: Scene, cover: (() => Cover) | null) {
  const [spot, setSpot] = useState<Spot | null>(null);
  const pointed = (event: PointerEvent) => {
    if (!stage) return;
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    const x_um = leftOf(stage) + (event.clientX - box.left) / stage.scale;
    setSpot({ x_um, r_um: (stage.axis - (event.clientY - box.top)) / stage.scale, byKey: false });
  };
  const pressed = (event: KeyboardEvent) => {
    const step = keySteps[event.key];
    if (event.key === 'Escape') setSpot(null);
    if (!step || !stage) return;
    event.preventDefault();
    const far = (event.shiftKey ? 24 : 4) / stage.scale;
    setSpot((now) => ({
      x_um: (now?.x_um ?? stage.middle_um) + step[0] * far,
      r_um: (now?.r_um ?? 0) + step[1] * far,
      byKey: true,
    }));
  };
  const sentences = spot && cover && scene.fields ? valuesAt(scene, cover(), spot) : [];
  return {
    point: pointed,
    press: pressed,
    leave: () => setSpot(null),
    mark: spot?.byKey ? spot : null,
    readout: spot && stage && sentences.length > 0 ? <Readout stage={stage} spot={spot} sentences={sentences} /> : null,
  };
}
