// The settings of moduli: what the program declares, what is typed, and what is sent.
import { readSettings, type Setting } from '../api';
import { numberIn, unitText } from '../draw/numbers';
import { store } from '../shell/store';
import { items, moduliSettings } from './model';

export const declared = store<Setting[]>([]);
export const readDeclared = async (): Promise<void> => declared.set(await readSettings());

/** All that have a field; lists of texts are gates, which the page has itself. */
export const fieldsOf = (settings: Setting[]): Setting[] => settings.filter(({ kind }) => kind !== 'texts');

/** "Viscosity, mPa s" */
export const labelOf = ({ label, unit }: Setting): string => (unit === '' ? label : `${label}, ${unitText(unit)}`);

export const on = 'true';
/** What is typed and not taken yet. */
export const typing = store<{ name: string; text: string } | null>(null);
export const typeIn = (name: string, text: string): void => moduliSettings.update((all) => ({ ...all, [name]: text }));

function valueOf(kind: Setting['kind'] | undefined, text: string): unknown {
  if (kind === 'flag') return text === on;
  return (kind === 'number' ? numberIn(text) : null) ?? text;
}

/** Settings as the interface wants them: what is empty comes from the recording; own tables go by their number. */
export function settingsToSend(typed: Record<string, string>, settings = declared.get()): Record<string, unknown> {
  const given = Object.entries(typed).filter(([, text]) => text.trim() !== '');
  return Object.fromEntries(
    given.map(([name, text]) => {
      const table = name === 'table' && items.get()?.find((item) => item.kind === 'table' && item.name === text.trim());
      return [name, table ? table.item : valueOf(settings.find((setting) => setting.name === name)?.kind, text.trim())];
    }),
  );
}
