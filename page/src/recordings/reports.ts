// What is said of each recording: of all its events, or of those within the gates that are on, by the same rule.
import { readReport, type Item, type Moduli } from '../api';
import { store } from '../shell/store';
import { maskOf } from './analysis';
import { columnsVersion } from './columns';
import { gateSettings, gatesWithoutOption, numbersWithin, type Gate } from './gates';
import { gates, items, recordings } from './model';
import { moduli } from './moduli';

/** As the moduli of moduli.ts; those that are ready run again until the report of the events within the gates has come. */
export const reports = store<Record<number, Moduli>>({});

/** What a report rests on. */
interface Basis {
  run: Moduli;
  gates: Gate[];
  /** The events within, where the program has no words for a gate: it does not gate by what it computes itself. */
  inside: Uint8Array | null;
}

interface Report extends Basis {
  report: Moduli;
}

const found = new Map<number, Report>();
let asking: (Basis & { item: Item; stop: AbortController }) | null = null;

/** Undefined where there is nothing to ask, or not yet. */
function basisOf(item: Item): Basis | undefined {
  const run = moduli.get()[item.item];
  const active = gates.get();
  if (run?.state !== 'ready' || !active.some((gate) => gate.on)) return undefined;
  const inside = gatesWithoutOption(active).length > 0 ? maskOf(item, active) : null;
  return inside === undefined ? undefined : { run, gates: active, inside };
}

const same = (a: Basis | undefined, b: Basis | undefined): boolean =>
  a?.run === b?.run && a?.gates === b?.gates && a?.inside === b?.inside;

async function ask(item: Item, basis: Basis): Promise<void> {
  const stop = new AbortController();
  asking = { ...basis, item, stop };
  const gating = basis.inside ? { gate: numbersWithin(basis.inside) } : gateSettings(basis.gates);
  try {
    found.set(item.item, { ...basis, report: { ...basis.run, ...(await readReport(item.item, gating, stop.signal)) } });
  } catch (failure) {
    const text = failure instanceof Error ? failure.message : String(failure);
    const summary = { recommended_modulus: 'none', recommended_text: text };
    if (!stop.signal.aborted) found.set(item.item, { ...basis, report: { ...basis.run, summary, lines: [text] } });
  }
  asking = null;
  look();
}

/** One recording after another; what is out of date is stopped. */
function askOn(): void {
  if (asking && !same(basisOf(asking.item), asking)) asking.stop.abort();
  if (asking) return;
  for (const item of recordings(items.get())) {
    const basis = basisOf(item);
    if (basis && !same(basis, found.get(item.item))) return void ask(item, basis);
  }
}

let next = 0;
function look(): void {
  const runs = moduli.get();
  const report = (item: Item): Moduli => {
    const own = found.get(item.item);
    return own && same(basisOf(item), own) ? own.report : { state: 'running', done: 0 };
  };
  const gated = recordings(items.get()).filter(({ item }) => runs[item]?.state === 'ready');
  const isGated = gates.get().some((gate) => gate.on);
  reports.set(isGated ? { ...runs, ...Object.fromEntries(gated.map((item) => [item.item, report(item)])) } : runs);
  // Not at each step of a gate that is being drawn.
  next ||= window.setTimeout(() => {
    next = 0;
    askOn();
  }, 100);
}
gates.subscribe(look);
moduli.subscribe(look);
columnsVersion.subscribe(look);
