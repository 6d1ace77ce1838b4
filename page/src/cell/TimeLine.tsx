// A case in time: computing its steps, playing them, and the line on which they stand.
import { Progress } from '../shell/Progress';
import { useStore } from '../shell/store';
import * as model from './model';
import { compute, leaveTime, pause, play, run, showStep, stopTime, type Run } from './time';

function Player({ now }: { now: Run }) {
  const last = now.steps.length - 1;
  const step = now.steps[now.shown];
  return (
    <>
      <button onClick={now.playing ? pause : play} disabled={last < 1}>
        {now.playing ? 'Pause' : 'Play'}
      </button>
      <input
        type="range"
        class="time-slider"
        min={0}
        max={Math.max(1, last)}
        value={now.shown}
        aria-label="Time"
        aria-valuetext={step ? `${(1e6 * step.time_s).toFixed(1)} µs` : ''}
        onInput={(event) => {
          pause();
          showStep(Number(event.currentTarget.value));
        }}
      />
      <span class="time-now">{step ? `${(1e6 * step.time_s).toFixed(1)} µs` : '–'}</span>
    </>
  );
}

/** The deformation over time, in some ducts dashed what is seen along the width, with the step that is shown. */
function Trace({ now }: { now: Run }) {
  const { steps, shown } = now;
  if (steps.length < 2) return null;
  const end = steps[steps.length - 1].time_s || 1;
  const high = Math.max(...steps.flatMap((step) => [step.deformation, step.deformation_across ?? 0])) || 1;
  const at = (k: number, value = steps[k].deformation) => `${((400 * steps[k].time_s) / end).toFixed(1)} ${(38 - (34 * value) / high).toFixed(1)}`;
  const across = steps.flatMap(({ deformation_across: value }, k) => (value === undefined ? [] : [at(k, value)]));
  return (
    <svg class="time-trace" viewBox="0 0 400 40" preserveAspectRatio="none" aria-hidden="true">
      <path d={`M${steps.map((_, k) => at(k)).join('L')}`} fill="none" stroke="var(--accent)" stroke-width={1.5} vector-effect="non-scaling-stroke" />
      {across.length > 1 && (
        <path d={`M${across.join('L')}`} fill="none" stroke="var(--accent)" stroke-dasharray="4 3" stroke-width={1.5} vector-effect="non-scaling-stroke" />
      )}
      <path d={`M${at(shown).split(' ')[0]} 0V40`} stroke="var(--ink)" vector-effect="non-scaling-stroke" />
    </svg>
  );
}

export function TimeLine() {
  const values = useStore(model.values);
  const now = useStore(run);
  if (!model.isInTime(values)) return null;
  const progress = now?.steps[now.steps.length - 1]?.progress ?? 0;
  return (
    <div class="time-line" role="group" aria-label="Time line">
      {!now && (
        <button class="primary" onClick={() => void compute(values)}>
          Follow the cell in time
        </button>
      )}
      {now && <Player now={now} />}
      {now && <Trace now={now} />}
      {now?.running && <Progress label="Following the cell" done={progress} onStop={stopTime} />}
      {now && !now.running && (
        <button class="quiet" onClick={leaveTime}>
          Close
        </button>
      )}
      {now?.failure && (
        <p class="wrong" role="alert">
          {now.failure}
        </p>
      )}
    </div>
  );
}
