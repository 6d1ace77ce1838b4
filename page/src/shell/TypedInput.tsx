// A field that is typed in: what stands in it stays when the page is drawn anew before it is entered.
import type { JSX } from 'preact';
import { useState } from 'preact/hooks';

interface Props extends Omit<JSX.HTMLAttributes<HTMLInputElement>, 'value' | 'onInput' | 'onChange'> {
  value: string | number;
  /** Gets the text when it is entered or the field is left; the field then shows its value again. */
  take(text: string): void;
}

export function TypedInput({ value, take, ...rest }: Props) {
  const [typed, setTyped] = useState<string | null>(null);
  return (
    <input
      {...rest}
      value={typed ?? value}
      onInput={({ currentTarget }) => setTyped(currentTarget.value)}
      onChange={({ currentTarget }) => {
        setTyped(null);
        take(currentTarget.value);
      }}
    />
  );
}
