// Sentences to the user, at the lower edge: what was written and where, what failed and why.
import { store, useStore } from './store';

interface Notice {
  id: number;
  kind: 'done' | 'failed';
  sentence: string;
}

const notices = store<Notice[]>([]);
let last = 0;

export function dismiss(id: number): void {
  notices.update((all) => all.filter((notice) => notice.id !== id));
}

export function notify(sentence: string, kind: Notice['kind'] = 'done'): void {
  const id = ++last;
  notices.update((all) => [...all.filter((other) => other.sentence !== sentence).slice(-2), { id, kind, sentence }]);
  if (kind === 'done') window.setTimeout(() => dismiss(id), 8000);
}

/** For promises whose failure the user should read. */
export function notifyFailure(failure: unknown): void {
  notify(failure instanceof Error ? failure.message : String(failure), 'failed');
}

export function Notices() {
  const shown = useStore(notices);
  return (
    <div class="notices" role="status" aria-live="polite">
      {shown.map((notice) => (
        <div key={notice.id} class={`notice ${notice.kind}`}>
          <p>{notice.sentence}</p>
          <button class="quiet" aria-label="Dismiss" onClick={() => dismiss(notice.id)}>
            ×
          </button>
        </div>
      ))}
    </div>
  );
}
