// The controls at the left, generated from the declared keys: a group for each section, rare keys behind "More".
import type { Case, KeyDescription, Value } from '../api';
import { useStore } from '../shell/store';
import { KeyControl } from './KeyControl';
import { hasEffect, isRare, isShown, sectionTitle, titleOf, type Keys } from './keys';
import { MediumControl } from './MediumControl';
import * as model from './model';

/** What a quantity becomes when the other one of two alternatives states it. */
function inOtherTerms(values: Case, from: string): Value {
  const value = Number(values[from] ?? 0);
  const modulus = Number(values['cell.cortex.modulus_mN_per_m'] ?? 1);
  const round = (number: number) => Number(number.toPrecision(4));
  switch (from) {
    case 'channel.width_um':
      return round(0.547 * value);
    case 'channel.radius_um':
      return round(value / 0.547);
    case 'cell.cortex.tension_mN_per_m':
      return round(value / modulus);
    default:
      return round(value * modulus);
  }
}

function Alternative({ of, keys, values }: { of: KeyDescription; keys: Keys; values: Case }) {
  const other = of.alternative ? keys.get(of.alternative) : undefined;
  if (!other || !hasEffect(keys, values, other)) return null;
  const swap = () => model.change(other.name, inOtherTerms(values, of.name));
  return (
    <button class="quiet alternative" onClick={swap}>
      {`Give ${titleOf(other).toLowerCase()} instead`}
    </button>
  );
}

function Group({ section, members, keys, values }: { section: string; members: KeyDescription[]; keys: Keys; values: Case }) {
  const shown = members.filter((key) => isShown(keys, values, key));
  if (!shown.length) return null;
  const usual = shown.filter((key) => !isRare(key));
  const rare = shown.filter(isRare);
  const control = (key: KeyDescription) => (
    <div key={key.name}>
      <KeyControl of={key} values={values} />
      <Alternative of={key} keys={keys} values={values} />
    </div>
  );
  return (
    <section class="group" aria-label={sectionTitle(section)}>
      <h2>{sectionTitle(section)}</h2>
      {section === 'flow' && <MediumControl />}
      {usual.map(control)}
      {rare.length > 0 && usual.length > 0 && (
        <details>
          <summary>More</summary>
          {rare.map(control)}
        </details>
      )}
      {usual.length === 0 && rare.map(control)}
    </section>
  );
}

export function Controls() {
  const keys = useStore(model.keys);
  const values = useStore(model.values);
  const sections = [...new Set([...keys.values()].map((key) => key.section))];
  return (
    <aside class="controls" aria-label="The case">
      {sections.map((section) => (
        <Group
          key={section}
          section={section}
          members={[...keys.values()].filter((key) => key.section === section)}
          keys={keys}
          values={values}
        />
      ))}
    </aside>
  );
}
