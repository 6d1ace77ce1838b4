// The field's media: choosing one puts its law at a temperature into the case. Changing the law by hand leaves it.
import { useEffect, useState } from 'preact/hooks';
import { readMedia, readMediumLaw, type Case, type Medium, type MediumLaw } from '../api';
import { numberIn } from '../draw/numbers';
import { notifyFailure } from '../shell/notices';
import { store, useStore } from '../shell/store';
import * as model from './model';

const media = store<Medium[] | null>(null);
/** The medium that was chosen and the law that it gave; it holds as long as the case says the same. */
const chosen = store<{ medium: string; temperature: number; law: MediumLaw } | null>(null);

const lawKeys = ['law', 'viscosity_mPas', 'consistency_Pa_sn', 'exponent'] as const;

const holds = (law: MediumLaw, values: Case) =>
  lawKeys.every((name) => law[name] === undefined || (values[`flow.${name}`] ?? 'newtonian') === law[name]);

function withLaw(values: Case, law: MediumLaw): Case {
  const next = { ...values };
  for (const name of lawKeys) {
    const value = law[name];
    if (value === undefined) delete next[`flow.${name}`];
    else next[`flow.${name}`] = value;
  }
  return next;
}

async function choose(medium: string, temperature: number): Promise<void> {
  if (!medium) return chosen.set(null);
  const law = await readMediumLaw(medium, temperature);
  chosen.set({ medium, temperature, law });
  model.replaceCase(withLaw(model.values.get(), law));
}

export function MediumControl() {
  const list = useStore(media);
  const now = useStore(chosen);
  const values = useStore(model.values);
  const [temperature, setTemperature] = useState('23');
  useEffect(() => {
    if (!list) void readMedia().then(media.set, notifyFailure);
  }, [list]);
  const held = now && holds(now.law, values) ? now.medium : '';
  const take = (medium: string, text: string) => {
    const degrees = numberIn(text);
    if (degrees !== null) void choose(medium, degrees).catch(notifyFailure);
  };
  return (
    <div class="control medium">
      <label for="medium">Medium</label>
      <select id="medium" value={held} onChange={(event) => take(event.currentTarget.value, temperature)}>
        <option value="">own values</option>
        {list?.map(({ medium, name }) => (
          <option key={medium} value={medium}>
            {name}
          </option>
        ))}
      </select>
      <label for="temperature">at</label>
      <input
        id="temperature"
        class="number"
        type="text"
        inputMode="decimal"
        aria-label="Temperature in °C"
        value={temperature}
        onInput={(event) => setTemperature(event.currentTarget.value)}
        onChange={(event) => held && take(held, event.currentTarget.value)}
      />
      <span class="unit">°C</span>
    </div>
  );
}
