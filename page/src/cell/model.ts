// What the workspace "Cell" knows: the case, its state as solved last, the way there, and what can be undone.
import { caseText, readCaseLines, readKeys, streamOf, type Case, type EncodedFields, type Lines, type Refusal, type State, type Value } from '../api';
import { decodeFields, type Fields } from '../draw/fields';
import { place, replacePlace } from '../shell/place';
import { keepInSession, sessionChanged } from '../shell/session';
import { store } from '../shell/store';
import { caseOf, caseOfQuery, firstCase, queryOf, sameCase, sectionsOf } from './case';
import { History } from './history';
import { completed, keysByName, optionOf, withKey, type Keys } from './keys';
import { LiveSolver, type Answer } from './live';
import { leaveTime } from './time';

/** The last good state with its fields; `of` is the case that it belongs to. */
export interface Solved {
  revision: number;
  of: Case;
  state: State;
  /** of this state, or of the one before until they are there */
  fields: Fields | null;
  final: boolean;
}

export interface TracePoint {
  area_um2: number;
  deformation: number;
}

export const keys = store<Keys>(new Map());
export const values = store<Case>(firstCase);
export const solved = store<Solved | null>(null);
export const refused = store<Refusal | null>(null);
export const working = store<'idle' | 'solving' | 'refining'>('idle');
export const trace = store<TracePoint[]>([]);
export const lines = store<Lines | null>(null);
export const steps = store<{ canUndo: boolean; canRedo: boolean }>({ canUndo: false, canRedo: false });

const history = new History<Case>();
const cases = new Map<number, Case>();
/** In a square channel the first estimate of the error costs a sixth of that at 1e-3, and its true error is a tenth of it. */
const displayAccuracies = { tube: 1e-3, duct: 3e-2 };
let revision = 0;
/** The case before the slider began to move; null while none moves. */
let before: Case | null = null;
/** Values of keys that lost their effect, to come back with it. */
const earlier: Case = {};
let linesOf = '';
/** The answer whose fields are shown. */
let sampled = 0;

const solver = new LiveSolver(streamOf('cell'), {
  busy: (_, refining) => working.set(refining ? 'refining' : 'solving'),
  idle: () => working.set('idle'),
  answered: take,
  sampled: takeFields,
  refused: (_, refusal) => refused.set(refusal),
});

export const stopSolving = () => solver.stop();
export const currentRevision = () => revision;
export const isInTime = (of: Case) => (optionOf(keys.get(), of, 'time.scheme') ?? 'stationary') !== 'stationary';

function take({ revision: answered, state, final }: Answer): void {
  const of = cases.get(answered) ?? values.get();
  for (const old of [...cases.keys()]) if (old < answered) cases.delete(old);
  refused.set(null);
  solved.set({ revision: answered, of, state, fields: solved.get()?.fields ?? null, final });
  const point = { area_um2: state.area_um2, deformation: state.deformation };
  trace.update((points) => [...points.slice(-400), point]);
}

/** Fields may come after those of a later answer: then they are in vain. */
function takeFields(order: number, encoded: EncodedFields): void {
  if (order < sampled) return;
  sampled = order;
  const fields = decodeFields(encoded);
  solved.update((now) => now && { ...now, fields });
}

/** Solves the current case; a case in time is played on demand instead. */
function solve(): void {
  const now = values.get();
  leaveTime();
  if (isInTime(now)) return solver.stop();
  cases.set(++revision, now);
  const accuracy = Number(optionOf(keys.get(), now, 'numerics.accuracy') ?? 1e-4);
  const isDuct = (optionOf(keys.get(), now, 'channel.section') ?? 'tube') !== 'tube';
  solver.want({ revision, sections: sectionsOf(now), accuracy, displayAccuracy: isDuct ? displayAccuracies.duct : displayAccuracies.tube });
}

function show(next: Case): void {
  for (const [name, value] of Object.entries(values.get())) if (!(name in next)) earlier[name] = value;
  values.set(next);
  refused.set(null);
  solve();
}

function settle(): void {
  steps.set({ canUndo: history.canUndo, canRedo: history.canRedo });
  replacePlace({ workspace: 'cell', query: queryOf(values.get()) });
  sessionChanged();
  void updateLines();
}

/** A control has changed. While a slider moves (`settled` false) the whole movement is one step to undo. */
export function change(name: string, value: Value, settled = true): void {
  const next = withKey(keys.get(), values.get(), name, value, earlier);
  before ??= values.get();
  if (!sameCase(next, values.get())) show(next);
  if (settled) settleChange();
}

export function settleChange(): void {
  const start = before;
  before = null;
  if (!start || sameCase(start, values.get())) return;
  history.record(start);
  settle();
}

/** Several keys at once, or a whole case from elsewhere: one step to undo. */
export function replaceCase(next: Case): void {
  settleChange();
  const whole = completed(keys.get(), next, earlier);
  if (sameCase(whole, values.get())) return;
  history.record(values.get());
  show(whole);
  settle();
}

function travel(next: Case | undefined): void {
  if (!next) return;
  show(next);
  settle();
}
export const undo = () => travel(history.undo(values.get()));
export const redo = () => travel(history.redo(values.get()));

/** The nearest state that exists, as the program offers it. */
export function goToNearest(): void {
  const nearest = refused.get()?.detail.nearest;
  if (nearest) replaceCase(caseOf(nearest));
}

export const clearTrace = () => trace.set([]);
export const textsOfCase = () => caseText(sectionsOf(values.get()));

/** Isoelasticity lines belong to channel and flow alone; the cell may change without asking again. */
async function updateLines(): Promise<void> {
  const now = values.get();
  const law = ['cell.bulk.law', 'cell.cortex.law'];
  const text = JSON.stringify(Object.entries(now).filter(([name]) => /^(channel|flow)\./.test(name) || law.includes(name)));
  if (text === linesOf) return;
  linesOf = text;
  const found = await readCaseLines(sectionsOf(now)).catch((failure: Refusal) => ({ lines: [], sentence: failure.message }));
  if (text === linesOf) lines.set(found);
}

function caseOfAddress(): Case {
  const kinds = new Map([...keys.get().values()].map((key) => [key.name, key.kind]));
  const asked = caseOfQuery(place.get().query, kinds);
  return Object.keys(asked).length ? asked : values.get();
}

/** Reads the keys, then shows the case of the address, of the session, or the first one. */
export async function startCell(): Promise<void> {
  if (keys.get().size) return void resume();
  keys.set(keysByName(await readKeys()));
  keepInSession('cell', {
    save: () => ({ case: values.get() }),
    restore: (kept) => (solved.get() ? show : values.set)((kept as { case: Case }).case),
  });
  values.set(completed(keys.get(), caseOfAddress()));
  solve();
  settle();
  place.subscribe((now) => {
    if (now.workspace === 'cell' && [...now.query].length) replaceCase(caseOfAddress());
  });
}

function resume(): void {
  const asked = completed(keys.get(), caseOfAddress());
  if (!sameCase(asked, values.get())) replaceCase(asked);
}

/** A case from the other workspace or from a file: shown here, and the address says so. */
export function openCase(next: Case): void {
  if (keys.get().size) replaceCase(next);
  else values.set(next);
}
