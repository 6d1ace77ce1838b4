// What the session file keeps of the page. Each part names itself and says how it is saved and restored.
import { readSession, writeSession } from '../api';

interface Kept {
  save(): unknown;
  restore(value: unknown): void;
}

const parts = new Map<string, Kept>();
let restored: Record<string, unknown> = {};
let timer: number | undefined;

/** A part that was saved in the session is restored at once. */
export function keepInSession(name: string, part: Kept): void {
  parts.set(name, part);
  if (name in restored) part.restore(restored[name]);
}

function saved(): Record<string, unknown> {
  const page = { ...restored };
  for (const [name, part] of parts) page[name] = part.save();
  return page;
}

/** Restores the session of the program, parts that are kept later when they are; false where there is none. */
export async function startSession(): Promise<boolean> {
  restored = (await readSession().catch(() => ({ page: null }))).page ?? {};
  for (const [name, part] of parts) if (name in restored) part.restore(restored[name]);
  return Object.keys(restored).length > 0;
}

export const sendSession = () => writeSession(saved());

/** What has changed is not sent any more: another session takes its place. */
export const leaveSession = () => window.clearTimeout(timer);

/** Sends the session a moment after the last change. */
export function sessionChanged(): void {
  window.clearTimeout(timer);
  timer = window.setTimeout(() => void sendSession().catch(() => undefined), 1000);
}
