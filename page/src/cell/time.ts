// A cell followed in time: the steps as they arrive, and which of them is shown.
import { evolve, streamOf, type Case, type EvolveLine, type Result, type TimeStep } from '../api';
import { store } from '../shell/store';
import { sectionsOf } from './case';

export interface Run {
  steps: TimeStep[];
  /** index of the step that is shown */
  shown: number;
  playing: boolean;
  running: boolean;
  result: Result | null;
  failure: string | null;
}

export const run = store<Run | null>(null);
const stream = streamOf('time');
let abort: AbortController | null = null;
let frame = 0;

const update = (change: Partial<Run>) => run.update((now) => now && { ...now, ...change });

function take(line: EvolveLine): void {
  const now = run.get();
  if (!now) return;
  if ('error' in line) update({ failure: line.error });
  else if ('result' in line) update({ result: line.result });
  else {
    const steps = [...now.steps, line];
    update({ steps, shown: now.playing ? now.shown : steps.length - 1 });
  }
}

/** Computes the way of a case in time and shows each step as it arrives. */
export async function compute(of: Case): Promise<void> {
  leaveTime();
  const mine = new AbortController();
  abort = mine;
  run.set({ steps: [], shown: 0, playing: false, running: true, result: null, failure: null });
  const only = (line: EvolveLine) => abort === mine && take(line);
  const failure = await evolve(sectionsOf(of), stream, only, mine.signal).then(
    () => null,
    (problem: Error) => problem.message,
  );
  if (abort !== mine) return;
  update(failure && failure !== 'Stopped.' ? { running: false, failure } : { running: false });
}

/** Ends the computation; the steps so far stay. */
export function stopTime(): void {
  abort?.abort();
  update({ running: false });
}

export function leaveTime(): void {
  abort?.abort();
  abort = null;
  pause();
  run.set(null);
}

export function showStep(shown: number): void {
  const last = (run.get()?.steps.length ?? 1) - 1;
  update({ shown: Math.max(0, Math.min(last, shown)) });
}

export function pause(): void {
  window.cancelAnimationFrame(frame);
  update({ playing: false });
}

/** Plays all steps, or those with fields, within six seconds, from the shown one, or anew from the end. */
export function play(): void {
  const now = run.get();
  if (!now || now.steps.length < 2) return;
  const end_s = now.steps[now.steps.length - 1].time_s;
  const rate = end_s / 6;
  const from_s = now.shown >= now.steps.length - 1 ? 0 : now.steps[now.shown].time_s;
  const withFields = now.steps.some((step) => step.fields);
  const began = performance.now();
  update({ playing: true });
  const tick = () => {
    const at_s = from_s + ((performance.now() - began) / 1000) * rate;
    const { steps } = run.get() ?? now;
    const next = steps.findIndex((step) => step.time_s >= at_s && (step.fields || !withFields));
    if (next < 0) return update({ shown: steps.length - 1, playing: false });
    showStep(next);
    frame = window.requestAnimationFrame(tick);
  };
  frame = window.requestAnimationFrame(tick);
}
