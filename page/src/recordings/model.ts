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
export type Panel = 'statistics' | 'gates' | 'distributions';

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
export const tool = store<Tool>('look');
export const panel = store<Panel>('statistics');
/** The feature of the statistics and the distributions. */
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

function replaceItem(found: Item): void {
  items.update((all) => (all ?? []).map((item) => (item.item === found.item ? { ...item, ...found } : item)));
}

/** Reads an item's features and metadata again. */
export async function refreshItem(number: number): Promise<void> {
  replaceItem(await readItem(number));
}

/** Reads the list, again after a moment while recordings are being opened; features come with a second request. */
export async function readRecordings(): Promise<void> {
  const found = await readItems();
  const before = new Map((items.get() ?? []).map((item) => [item.item, item]));
  items.set(found.map((item) => ({ ...before.get(item.item), ...item })));
  const ready = recordings(found).filter((item) => item.state === 'ready');
  if (!ready.some((item) => item.item === focus.get())) focus.set(ready[0]?.item ?? null);
  for (const item of ready) if (!itemOf(item.item)?.features) await refreshItem(item.item).catch(notifyFailure);
  if (found.some((item) => item.state === 'loading')) window.setTimeout(() => void readRecordings().catch(notifyFailure), 600);
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
