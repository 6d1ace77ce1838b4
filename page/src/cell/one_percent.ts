// What one per cent more of a number of the case does to the deformation: asked for while somebody looks.
import { solveGradients, streamOf, type Case, type State } from '../api';
import { store } from '../shell/store';
import { sectionsOf } from './case';
import { optionOf } from './keys';
import * as model from './model';

export interface Influence {
  key: string;
  /** relative change of the deformation by one per cent more */
  change: number;
}

export interface Influences {
  /** of the state that they belong to */
  revision: number;
  list: Influence[];
}

export const isOpen = store(false);
export const influences = store<Influences | null>(null);

/** The strongest ones first; a number that is 0 has no per cent. */
export function influencesOf(state: State, of: Case, count: number): Influence[] {
  const numbers = Object.entries(state.gradients).map(([key, measures]) => ({
    key,
    change: (0.01 * Number(of[key] ?? 0) * (measures.deformation ?? 0)) / state.deformation,
  }));
  return numbers.filter(({ change }) => change !== 0).sort((a, b) => Math.abs(b.change) - Math.abs(a.change)).slice(0, count);
}

const shown = 6;
let asked = 0;

/** A later case of the stream takes the solver away from this request: then there is nothing to show. */
async function ask(): Promise<void> {
  const solved = model.solved.get();
  if (!isOpen.get() || model.working.get() !== 'idle' || !solved?.final || asked === solved.revision) return;
  asked = solved.revision;
  const accuracy = Number(optionOf(model.keys.get(), solved.of, 'numerics.accuracy') ?? 1e-4);
  const state = await solveGradients(sectionsOf(solved.of), { stream: streamOf('cell'), accuracy }).catch(() => null);
  if (state) influences.set({ revision: solved.revision, list: influencesOf(state, valuesOf(state, solved.of), shown) });
  else if (asked === solved.revision) asked = 0;
}

/** The numbers of the case with its defaults. */
function valuesOf(state: State, of: Case): Case {
  const whole: Case = { ...of };
  for (const key of Object.keys(state.gradients)) {
    const value = key.split('.').reduce<unknown>((part, name) => (part as Record<string, unknown> | undefined)?.[name], state.case);
    if (typeof value === 'number') whole[key] = value;
  }
  return whole;
}

model.working.subscribe(() => void ask());
model.solved.subscribe(() => void ask());
isOpen.subscribe(() => void ask());
