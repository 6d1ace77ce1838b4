// Progress of whatever takes longer than half a second, with a way to stop it.
import { useEffect, useState } from 'preact/hooks';

interface ProgressProps {
  label: string;
  /** 0..1; without it the end is not known. */
  done?: number;
  onStop?: () => void;
}

export function Progress({ label, done, onStop }: ProgressProps) {
  return (
    <div class="progress" role="group" aria-label={label}>
      <span class="progress-label">{label}</span>
      <progress value={done} max={1} aria-label={label} />
      {onStop && (
        <button class="quiet" onClick={onStop}>
          Stop
        </button>
      )}
    </div>
  );
}

/** True once `running` has lasted half a second: shorter work shows nothing. */
export function useLasting(running: boolean): boolean {
  const [lasting, setLasting] = useState(false);
  useEffect(() => {
    setLasting(false);
    if (!running) return;
    const timer = window.setTimeout(() => setLasting(true), 500);
    return () => window.clearTimeout(timer);
  }, [running]);
  return running && lasting;
}
