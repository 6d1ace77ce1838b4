// The middle: the picture, its colour bars and switches, and what the page says when a state does not exist.
import { useMemo } from 'preact/hooks';
import type { Case, TimeStep } from '../api';
import { fieldsOfText, type Fields } from '../draw/fields';
import { Progress, useLasting } from '../shell/Progress';
import { useStore } from '../shell/store';
import { halfOfStraight, sightsOf, titleOfAside } from './cameras';
import { Channel } from './Channel';
import { ColorBar, TensionBar } from './ColorBar';
import { tensionRange } from './Lines';
import { cellFields, changeLooks, liquidFields, looks, paintsOf, type Looks } from './looks';
import * as model from './model';
import type { Scene } from './scene';
import { Solid } from './Solid';
import { run } from './time';
import { TimeLine } from './TimeLine';

export type Painted = ReturnType<typeof paintsOf>;
const nothing: Painted = { legends: [null, null], paints: [null, null] };

function sceneOf(solved: model.Solved, painted: Painted): Scene {
  return {
    title: titleOfAside(solved.of),
    fields: solved.fields,
    paints: painted.paints,
    contour: solved.state.contour,
    hull: solved.state.hull,
    undeformed_um: Number(solved.of['cell.radius_um']),
    radius_um: halfOfStraight(solved.of, solved.state.tube_radius_um),
    revision: solved.revision,
  };
}

interface Shown {
  scenes: Scene[];
  painted: Painted;
  solid: Fields['surface3d'];
  /** what is shown belongs to */
  of: Case;
}

function useShown(): Shown {
  const solved = useStore(model.solved);
  const values = useStore(model.values);
  const now = useStore(looks);
  const time = useStore(run);
  const step = time?.steps[time.shown];
  const stepFields = useMemo(() => (step?.fields ? fieldsOfText(step.fields) : null), [step]);
  const fields = step ? stepFields : (solved?.fields ?? null);
  const painted = useMemo(() => (fields ? paintsOf(fields, now) : nothing), [fields, now]);
  const scenes = useMemo((): Scene[] => {
    if (step) return timeScenes(step, fields, painted, values, solved);
    return solved ? [sceneOf(solved, painted)] : [];
  }, [step, fields, solved, painted, values]);
  return { scenes, painted, solid: fields?.surface3d ?? null, of: step || !solved ? values : solved.of };
}

/** Of each camera. Where there are many steps, some have a contour alone; the fields are those of the first camera. */
function timeScenes(step: TimeStep, fields: Fields | null, painted: Painted, values: Case, solved: model.Solved | null): Scene[] {
  return sightsOf(values, step).map((sight, k) => ({
    ...sight,
    fields: k === 0 ? fields : null,
    paints: k === 0 ? painted.paints : nothing.paints,
    hull: null,
    undeformed_um: Number(values['cell.radius_um']),
    revision: solved?.revision ?? 0,
  }));
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
  const {
    scenes,
    painted: { legends },
    solid,
    of,
  } = useShown();
  const tension = useMemo(() => tensionRange(solved?.fields?.surface), [solved?.fields]);
  const stale = refusal !== null;
  const empty = solved?.fields ? 'not in this cell' : '';
  return (
    <section class="view" aria-label="The cell in its channel">
      <div class={scenes.length > 1 && !(now.solid && solid) ? 'stage two' : 'stage'}>
        {now.solid && solid ? (
          <Solid solid={solid} of={of} stale={stale} />
        ) : (
          scenes.map((scene) => <Channel key={scene.title} scene={scene} looks={now} stale={stale} />)
        )}
        {scenes.length === 0 && <p class="waiting">The first state is being solved.</p>}
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
