// What the workspace shows and keeps in the session: recordings, plots, gates, the event under inspection.
import { changeItem, readItem, readItems, type Item } from '../api';
import { notifyFailure } from '../shell/notices';
import { nextPicture } from '../shell/next_picture';
import { keepInSession, sessionChanged } from '../shell/session';
import { store } from '../shell/store';
import { youngModulus } from './features';
import type { Gate } from './gates';
import type { ScaleKind, Span } from './scale';

export interface Axis {
  feature: string;
  scale: ScaleKind;
  /** null: as the events want it. */
  span: Span | null;
}

export interface Plot {
  id: number;
  /** null: the recording in focus. */
  item: number | null;
  x: Axis;
  y: Axis;
  /** A feature, or by the density of events. */
  colour: string;
  contours: boolean;
  lines: boolean;
}

export interface Choice {
  item: number;
  event: number;
}

export type Tool = 'look' | 'box' | 'polygon';

export const byDensity = 'density';
const axis = (feature: string): Axis => ({ feature, scale: 'linear', span: null });
const newPlot = (id: number): Plot => ({
  id,
  item: null,
  x: axis('area_um'),
  y: axis('deform'),
  colour: byDensity,
  contours: true,
  lines: true,
});

export const items = store<Item[] | null>(null);
export const focus = store<number | null>(null);
export const plots = store<Plot[]>([newPlot(1)]);
export const gates = store<Gate[]>([]);
/** The gates of the plots: numbers follow at once, plots of many events with the next picture. */
export const paintedGates = store<Gate[]>([]);
gates.subscribe((latest) => void nextPicture().then(() => latest === gates.get() && paintedGates.set(latest)));
export const choice = store<Choice | null>(null);
/** An event is looked at as long as its recording stands in a plot. */
const leaveEvent = () => {
  const item = choice.get()?.item;
  if (item !== undefined && !plots.get().some((plot) => (plot.item ?? focus.get()) === item)) choice.set(null);
};
focus.subscribe(leaveEvent);
plots.subscribe(leaveEvent);
export const tool = store<Tool>('look');
/** The name of the tab that is shown. */
export const panel = store<string>('statistics');
/** The number in the tabs Statistics and Populations. */
export const measured = store<string>(youngModulus);
export const moduliSettings = store<Record<string, string>>({});

const saved = { focus, plots, gates, choice, panel, measured, moduliSettings };

/** To be called once, when the workspace is first shown. */
export function keepModel(): void {
  keepInSession('recordings', {
    save: () => Object.fromEntries(Object.entries(saved).map(([name, part]) => [name, part.get()])),
    restore(value) {
      const found = value as Record<string, never>;
      for (const [name, part] of Object.entries(saved)) if (found[name] !== undefined) part.set(found[name]);
    },
  });
  for (const part of Object.values(saved)) (part as { subscribe(listener: () => void): void }).subscribe(sessionChanged);
}

export const recordings = (all: Item[] | null): Item[] => (all ?? []).filter((item) => item.kind === 'recording');
export const itemOf = (number: number | null): Item | undefined => items.get()?.find((item) => item.item === number);
/** What a recording is called in a list: the name of its file. */
export const titleOf = (item: Item): string => item.name.split('/').pop() ?? item.name;

/** Why it cannot be read. In the page without a server files lie in folders that nobody knows. */
export const failureOf = ({ name, error }: Item): string => error?.replace(/^\/recordings\/\d+\//, '') ?? `${name} cannot be read.`;

function replaceItem(found: Item): void {
  items.update((all) => (all ?? []).map((item) => (item.item === found.item ? { ...item, ...found } : item)));
}

/** Reads an item's features and metadata again. */
export async function refreshItem(number: number): Promise<void> {
  replaceItem(await readItem(number));
}

let listed = '';
let next: number | undefined;
const readLater = (milliseconds: number) => {
  window.clearTimeout(next);
  next = window.setTimeout(readAgain, milliseconds);
};

/** Files may change while the page is open; one that nobody looks at does not ask. */
function readAgain(): void {
  if (document.hidden) readLater(3000);
  else readRecordings().catch(() => readLater(3000)); // whoever wants something of the program is told that it has gone
}
document.addEventListener('visibilitychange', () => void (next !== undefined && readAgain()));

/** The list holds no features; those of the same file are known already. */
const withFeatures = (item: Item, before?: Item): Item =>
  before && before.version === item.version ? { features: before.features, metadata: before.metadata, ...item } : item;

/** Takes what the list says; features and metadata come with a second request. */
function takeList(found: Item[]): void {
  const text = JSON.stringify(found);
  if (text === listed) return;
  listed = text;
  const before = new Map((items.get() ?? []).map((item) => [item.item, item]));
  items.set(found.map((item) => withFeatures(item, before.get(item.item))));
}

/** Reads the list, and from then on again and again: soon while recordings are being opened. */
export async function readRecordings(): Promise<void> {
  window.clearTimeout(next);
  const found = await readItems();
  takeList(found);
  const ready = recordings(found).filter((item) => item.state === 'ready');
  const own = recordings(found).find((item) => item.item === focus.get());
  if (!own || own.state === 'failed') focus.set(ready[0]?.item ?? null);
  for (const item of ready) if (!itemOf(item.item)?.features) await refreshItem(item.item).catch(notifyFailure);
  readLater(found.some((item) => item.state === 'loading') ? 600 : 3000);
}

export async function rename(number: number, change: { condition?: string; replicate?: string }): Promise<void> {
  try {
    replaceItem({ ...itemOf(number)!, ...change });
    replaceItem(await changeItem(number, change));
  } catch (failure) {
    notifyFailure(failure);
  }
}

export const changePlot = (id: number, change: Partial<Plot>): void =>
  plots.update((all) => all.map((plot) => (plot.id === id ? { ...plot, ...change } : plot)));

/** A second plot shows another recording at first, if there is one, over the same axes. */
export function secondPlot(wanted: boolean): void {
  const other = recordings(items.get()).find((item) => item.state === 'ready' && item.item !== focus.get());
  plots.update(([first]) => (wanted ? [first, { ...first, id: 2, item: other?.item ?? null }] : [first]));
}

/** A gate with a number of its own. */
export function addGate(gate: Omit<Gate, 'id' | 'on'>): void {
  gates.update((all) => [...all, { ...gate, id: 1 + Math.max(0, ...all.map((each) => each.id)), on: true } as Gate]);
}
export const changeGate = (id: number, change: Partial<Gate>): void =>
  gates.update((all) => all.map((gate) => (gate.id === id ? ({ ...gate, ...change } as Gate) : gate)));
export const removeGate = (id: number): void => gates.update((all) => all.filter((gate) => gate.id !== id));

/** Limits of a feature: they replace those that there are for it. */
export function limitFeature(feature: string, low: number | null, high: number | null): void {
  const own = gates.get().find((gate) => gate.kind === 'range' && gate.feature === feature);
  if (own) changeGate(own.id, { low, high, on: true });
  else addGate({ kind: 'range', feature, low, high } as Omit<Gate, 'id' | 'on'>);
}
