// Files that the user gives to the page, by choosing or dropping them, where the program is part of the page.
import { notifyFailure } from './notices';
import { store, useStore } from './store';

export type Opener = (files: File[]) => Promise<void>;
/** null: the program gets its files when it is started. */
export const opener = store<Opener | null>(null);

const endings = '.rtdc,.csv,.tsv,.toml,.json,.txt';

export function OpenFiles() {
  const open = useStore(opener);
  if (!open) return null;
  return (
    <label class="open-files">
      <span>Drop recordings anywhere on this page, or choose them. They stay on this computer.</span>
      <input
        type="file"
        multiple
        accept={endings}
        onChange={({ currentTarget }) => {
          const files = [...(currentTarget.files ?? [])];
          currentTarget.value = '';
          if (files.length > 0) void open(files).catch(notifyFailure);
        }}
      />
    </label>
  );
}
