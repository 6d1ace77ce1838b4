// The middle: the picture, its colour bars and switches, and what the page says when a state does not exist.
import { useMemo } from 'preact/hooks';
import type { Outline } from '../api';
import { fieldsOfText, type Fields } from '../draw/fields';
import { Progress, useLasting } from '../shell/Progress';
import { useStore } from '../shell/store';
import { Channel } from './Channel';
import { ColorBar, TensionBar } from './ColorBar';
import { tensionRange } from './Lines';
import { cellFields, changeLooks, liquidFields, looks, paintsOf, type Looks } from './looks';
import * as model from './model';
import type { Scene } from './scene';
import { Solid } from './Solid';
import { run } from './time';
import { TimeLine } from './TimeLine';

const tubeRadius = (solved: model.Solved) => solved.state.tube_radius_um ?? 0.547 * Number(solved.of['channel.width_um'] ?? 20);

/** Half the height of the picture: the tube's radius, or half of what the camera sees of a duct across the flow. */
function wallOf(solved: model.Solved): number {
  if ((solved.of['channel.section'] ?? 'tube') === 'tube') return tubeRadius(solved);
  const turned = solved.of['channel.section'] === 'rectangle' && Number(solved.of['channel.camera_degree'] ?? 0) > 45;
  return 0.5 * Number(solved.of[turned ? 'channel.height_um' : 'channel.width_um'] ?? 20);
}

export type Painted = ReturnType<typeof paintsOf>;
const nothing: Painted = { legends: [null, null], paints: [null, null] };

function sceneOf(solved: model.Solved, painted: Painted): Scene {
  return {
    fields: solved.fields,
    paints: painted.paints,
    contour: solved.state.contour,
    hull: solved.state.hull,
    undeformed_um: Number(solved.of['cell.radius_um']),
    radius_um: wallOf(solved),
    place_um: 0,
    revision: solved.revision,
  };
}

function useScene(): [Scene | null, Painted] {
  const solved = useStore(model.solved);
  const values = useStore(model.values);
  const now = useStore(looks);
  const time = useStore(run);
  const step = time?.steps[time.shown];
  const stepFields = useMemo(() => (step?.fields ? fieldsOfText(step.fields) : null), [step]);
  const fields = step ? stepFields : (solved?.fields ?? null);
  const painted = useMemo(() => (fields ? paintsOf(fields, now) : nothing), [fields, now]);
  const scene = useMemo((): Scene | null => {
    if (step) return timeScene({ ...step, fields }, painted, values, solved);
    return solved && sceneOf(solved, painted);
  }, [step, fields, solved, painted, values]);
  return [scene, painted];
}

interface ShownStep {
  contour: Outline;
  x_um: number;
  fields: Fields | null;
}

/** Where there are many steps, some have a contour alone; the channel is that of the case. */
function timeScene({ contour, x_um, fields }: ShownStep, painted: Painted, values: Record<string, unknown>, solved: model.Solved | null): Scene {
  const profile = values['channel.profile.R_um'] as number[] | undefined;
  const places = values['channel.profile.x_um'] as number[] | undefined;
  const width = Number(values['channel.width_um'] ?? 20);
  const radius_um = profile ? Math.max(...profile) : Number(values['channel.radius_um'] ?? 0.547 * width);
  const wall = profile && places ? { x_um: places.map((x) => x - x_um), r_um: profile } : undefined;
  return {
    fields,
    paints: painted.paints,
    contour,
    hull: null,
    undeformed_um: Number(values['cell.radius_um']),
    radius_um,
    place_um: 0,
    revision: solved?.revision ?? 0,
    wall,
  };
}

function Switch({ name, title, now }: { name: keyof Looks; title: string; now: Looks }) {
  return (
    <label class="switch">
      <input type="checkbox" checked={Boolean(now[name])} onChange={(event) => changeLooks({ [name]: event.currentTarget.checked })} />
      {title}
    </label>
  );
}

/** Why there is no state, and the way out. */
function Refused() {
  const refusal = useStore(model.refused);
  if (!refusal) return null;
  const reached = refusal.detail.last?.deformation;
  return (
    <div class="refused" role="alert">
      <p>{refusal.message}</p>
      {reached !== undefined && <p>{`The last state that exists has the deformation ${reached.toFixed(5)}.`}</p>}
      <div class="row">
        {refusal.detail.nearest && (
          <button class="primary" onClick={model.goToNearest}>
            Nearest state that exists
          </button>
        )}
        <button onClick={model.undo}>Undo</button>
      </div>
    </div>
  );
}

function Working() {
  const lasting = useLasting(useStore(model.working) !== 'idle');
  return lasting ? <Progress label="Solving" onStop={model.stopSolving} /> : null;
}

export function View() {
  const now = useStore(looks);
  const refusal = useStore(model.refused);
  const solved = useStore(model.solved);
  const [scene, { legends }] = useScene();
  const solid = solved?.fields?.surface3d ?? null;
  const tension = useMemo(() => tensionRange(solved?.fields?.surface), [solved?.fields]);
  const stale = refusal !== null;
  const empty = solved?.fields ? 'not in this cell' : '';
  return (
    <section class="view" aria-label="The cell in its channel">
      <div class="stage">
        {scene && (now.solid && solid ? <Solid solid={solid} solved={solved!} stale={stale} /> : <Channel scene={scene} looks={now} stale={stale} />)}
        {!scene && <p class="waiting">The first state is being solved.</p>}
        <Refused />
        <div class="working">
          <Working />
        </div>
      </div>
      <TimeLine />
      <div class="legends">
        <ColorBar label="Field in the liquid" choices={liquidFields} chosen={now.liquid} legend={legends[0]} empty={empty} choose={(liquid) => changeLooks({ liquid })} />
        <ColorBar label="Field in the cell" choices={cellFields} chosen={now.cell} legend={legends[1]} empty={empty} choose={(cell) => changeLooks({ cell })} />
        <fieldset class="switches">
          <legend class="hidden">Lines</legend>
          <Switch name="streamlines" title="Streamlines" now={now} />
          <Switch name="undeformed" title="Undeformed" now={now} />
          <Switch name="hull" title="Hull" now={now} />
          <Switch name="tension" title="Tension" now={now} />
          {tension && now.tension && <TensionBar low={tension[0]} high={tension[1]} />}
          {solid && <Switch name="solid" title="3D" now={now} />}
        </fieldset>
      </div>
    </section>
  );
}
