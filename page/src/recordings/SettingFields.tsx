// The fields of the settings that the program declares.
import type { Setting } from '../api';
import { useStore } from '../shell/store';
import { TypedInput } from '../shell/TypedInput';
import { items, moduliSettings } from './model';
import { labelOf, on, typeIn, typing } from './settings';

interface FieldProps {
  of: Setting;
  typed: string;
}

function Choice({ of, typed }: FieldProps) {
  return (
    <select value={typed} onChange={({ currentTarget }) => typeIn(of.name, currentTarget.value)}>
      <option value="">automatic</option>
      {of.words.map((word) => (
        <option key={word}>{word}</option>
      ))}
    </select>
  );
}

const Flag = ({ of, typed }: FieldProps) => (
  <input type="checkbox" checked={typed === on} onChange={({ currentTarget }) => typeIn(of.name, currentTarget.checked ? on : '')} />
);

function Text({ of, typed }: FieldProps) {
  const tables = (useStore(items) ?? []).filter((item) => item.kind === 'table').map((table) => table.name);
  const words = of.name === 'table' ? tables : of.words;
  const list = words.length > 0 ? `words-${of.name}` : undefined;
  return (
    <>
      <TypedInput
        type="text"
        inputMode={of.kind === 'number' ? 'decimal' : 'text'}
        value={typed}
        placeholder="automatic"
        list={list}
        take={(text) => typeIn(of.name, text)}
        watch={(text) => typing.set(text === null ? null : { name: of.name, text })}
      />
      {list && (
        <datalist id={list}>
          {words.map((word) => (
            <option key={word} value={word} />
          ))}
        </datalist>
      )}
    </>
  );
}

export function SettingFields({ of }: { of: Setting[] }) {
  const typed = useStore(moduliSettings);
  return (
    <div class="settings">
      {of.map((setting) => {
        const Field = setting.kind === 'flag' ? Flag : setting.kind === 'choice' ? Choice : Text;
        return (
          <label key={setting.name} class="setting" title={`${setting.sentence}${setting.default && `; default: ${setting.default}`}`}>
            <span>{labelOf(setting)}</span>
            <Field of={setting} typed={typed[setting.name] ?? ''} />
          </label>
        );
      })}
    </div>
  );
}
