// A field that is typed in: what stands in it stays when the page is drawn anew before it is entered.
import type { JSX } from 'preact';
import { useState } from 'preact/hooks';

type Own = 'value' | 'onInput' | 'onKeyDown' | 'onChange' | 'onBlur';

interface Props extends Omit<JSX.HTMLAttributes<HTMLInputElement>, Own> {
  value: string | number;
  /** Gets the text with Enter or when the field is left, which then shows its value again; Escape takes it back. */
  take(text: string): void;
  /** Gets what stands in the field while it is typed, and null once that is taken or dropped. */
  watch?(text: string | null): void;
  /** Whether a text can be taken; one that cannot is marked, and dropped. All can if this is not given. */
  canTake?(text: string): boolean;
  /** Marks the value itself as one that cannot be. */
  isWrong?: boolean;
}

export function TypedInput({ value, take, watch, canTake = () => true, isWrong = false, ...rest }: Props) {
  const [typed, remember] = useState<string | null>(null);
  const setTyped = (text: string | null) => {
    remember(text);
    watch?.(text);
  };
  return (
    <input
      {...rest}
      value={typed ?? value}
      aria-invalid={isWrong || (typed !== null && !canTake(typed))}
      onInput={({ currentTarget }) => setTyped(currentTarget.value)}
      onKeyDown={({ key }) => key === 'Escape' && setTyped(null)}
      onChange={({ currentTarget }) => {
        if (canTake(currentTarget.value)) take(currentTarget.value);
        setTyped(null);
      }}
      onBlur={() => setTyped(null)}
    />
  );
}
