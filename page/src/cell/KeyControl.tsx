// One key of the case as a control: a slider with its number and unit, a choice, or a list.
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { Case, KeyDescription, Value } from '../api';
import { numberIn, plain, unitText } from '../draw/numbers';
import { useStore } from '../shell/store';
import { TypedInput } from '../shell/TypedInput';
import { titleOf } from './keys';
import * as model from './model';
import { isAtEnd, placeOf, sliderScale, steps, valueOf } from './scale';

interface ControlProps {
  of: KeyDescription;
  values: Case;
}

const idOf = (key: KeyDescription) => `key-${key.name.replace(/[._]/g, '-')}`;

/** The sentence of a refusal that names this key. */
function useWrong(key: KeyDescription): string | null {
  const refusal = useStore(model.refused);
  return refusal?.detail.key === key.name ? refusal.message : null;
}

interface NumberFieldProps {
  of: KeyDescription;
  value: number | undefined;
  wrong: string | null;
}

function NumberField({ of, value, wrong }: NumberFieldProps) {
  const take = (text: string) => {
    const number = numberIn(text)!;
    model.change(of.name, of.whole ? Math.round(number) : number);
  };
  return (
    <TypedInput
      id={idOf(of)}
      type="text"
      inputMode="decimal"
      autocomplete="off"
      class="number"
      aria-label={`${titleOf(of)}${of.unit ? ` in ${unitText(of.unit)}` : ''}`}
      isWrong={wrong !== null}
      value={value === undefined ? '' : plain(value)}
      canTake={(text) => numberIn(text) !== null}
      take={take}
    />
  );
}

/** Where the slider is centred: moves when the value is set by other means, or when the slider meets its end. */
function useAnchor(value: number): [number, { moved(value: number): void; settled(atEnd: boolean): void }] {
  const [anchor, setAnchor] = useState(value);
  const own = useRef(value);
  // Before the next event: a late look would take the slider's own earlier value for one set by other means.
  useLayoutEffect(() => {
    if (value === own.current) return;
    own.current = value;
    setAnchor(value);
  }, [value]);
  return [
    anchor,
    { moved: (next) => (own.current = next), settled: (atEnd) => atEnd && setAnchor(own.current) },
  ];
}

function NumberControl({ of, values }: ControlProps) {
  const given = (values[of.name] ?? of.default ?? undefined) as number | undefined;
  const value = given ?? of.least ?? 0;
  const [anchor, slider] = useAnchor(value);
  const scale = sliderScale(of, values, anchor);
  const at = placeOf(scale, value);
  const wrong = useWrong(of);
  const moved = (place: number) => {
    const next = valueOf(scale, place, of.whole);
    slider.moved(next);
    model.change(of.name, next, false);
  };
  const settled = () => {
    slider.settled(isAtEnd(scale, at));
    model.settleChange();
  };
  return (
    <div class="control" data-key={of.name} title={of.sentence}>
      <label for={idOf(of)}>{titleOf(of)}</label>
      <NumberField of={of} value={given} wrong={wrong} />
      <span class="unit">{unitText(of.unit)}</span>
      <input
        type="range"
        min={0}
        max={steps}
        step={1}
        value={at}
        aria-label={titleOf(of)}
        aria-valuetext={`${plain(value)} ${unitText(of.unit)}`}
        onInput={(event) => moved(Number(event.currentTarget.value))}
        onChange={settled}
      />
      {wrong && <p class="wrong">{wrong}</p>}
    </div>
  );
}

function ChoiceControl({ of, values }: ControlProps) {
  const value = String(values[of.name] ?? of.default ?? of.options![0]);
  const wrong = useWrong(of);
  return (
    <div class="control options" data-key={of.name} title={of.sentence}>
      <label for={idOf(of)}>{titleOf(of)}</label>
      <select id={idOf(of)} value={value} onChange={(event) => model.change(of.name, event.currentTarget.value)}>
        {of.options!.map((option) => (
          <option key={option} value={option}>
            {option}
          </option>
        ))}
      </select>
      {wrong && <p class="wrong">{wrong}</p>}
    </div>
  );
}

function ListControl({ of, values }: ControlProps) {
  const value = values[of.name] as number[] | undefined;
  const wrong = useWrong(of);
  const numbersIn = (text: string) => text.split(/[\s,;]+/).filter(Boolean).map(Number);
  const canTake = (text: string) => numbersIn(text).length > 0 && numbersIn(text).every(Number.isFinite);
  return (
    <div class="control list" data-key={of.name} title={of.sentence}>
      <label for={idOf(of)}>{`${titleOf(of)} (${unitText(of.unit)})`}</label>
      <TypedInput
        id={idOf(of)}
        type="text"
        placeholder="numbers, with commas"
        value={value?.map(plain).join(', ') ?? ''}
        canTake={canTake}
        take={(text) => model.change(of.name, numbersIn(text) as Value)}
      />
      {wrong && <p class="wrong">{wrong}</p>}
    </div>
  );
}

export function KeyControl(props: ControlProps) {
  if (props.of.kind === 'choice') return <ChoiceControl {...props} />;
  if (props.of.kind === 'list') return <ListControl {...props} />;
  return props.of.kind === 'number' ? <NumberControl {...props} /> : null;
}
