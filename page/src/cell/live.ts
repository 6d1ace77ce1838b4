// The live solver: one request at a time, the newest case wins. First an answer good enough to look at, then the wanted one.
import { Refusal, solveState, type Sections, type State } from '../api';

export interface Answer {
  revision: number;
  state: State;
  /** false: display accuracy, the wanted one follows */
  final: boolean;
}

export interface Listener {
  busy(revision: number, refining: boolean): void;
  answered(answer: Answer): void;
  refused(revision: number, refusal: Refusal): void;
  idle(): void;
}

interface Wanted {
  revision: number;
  sections: Sections;
  accuracy: number;
}

const displayAccuracy = 1e-3;
/** Work younger than this is let finish when the next case is there: a moving slider shows every answer it can get. */
const patience_ms = 120;
const pause_ms = 200;

export class LiveSolver {
  private wanted: Wanted | null = null;
  private running: { revision: number; final: boolean; since: number; abort: AbortController } | null = null;
  private timer: number | undefined;

  constructor(
    private readonly stream: string,
    private readonly listener: Listener,
  ) {}

  /** The newest case. What is under way for an older one is finished if it is young, else cancelled. */
  want(revision: number, sections: Sections, accuracy: number): void {
    this.wanted = { revision, sections, accuracy };
    window.clearTimeout(this.timer);
    const now = this.running;
    if (!now) return this.start(false);
    if (now.final || performance.now() - now.since > patience_ms) return this.restart();
    this.timer = window.setTimeout(() => this.restart(), patience_ms);
  }

  /** Ends what is under way; the last answer stays. */
  stop(): void {
    window.clearTimeout(this.timer);
    this.wanted = null;
    this.running?.abort.abort();
    this.running = null;
    this.listener.idle();
  }

  private restart(): void {
    if (!this.wanted || this.running?.revision === this.wanted.revision) return;
    this.running?.abort.abort();
    this.running = null;
    this.start(false);
  }

  private start(final: boolean): void {
    window.clearTimeout(this.timer);
    const wanted = this.wanted;
    if (!wanted) return;
    const accuracy = final ? wanted.accuracy : Math.max(displayAccuracy, wanted.accuracy);
    const run = { revision: wanted.revision, final, since: performance.now(), abort: new AbortController() };
    this.running = run;
    this.listener.busy(run.revision, final);
    solveState(wanted.sections, { stream: this.stream, accuracy, fields: true }, run.abort.signal).then(
      (state) => this.running === run && this.finish(run.revision, state, final || accuracy === wanted.accuracy),
      (failure) => this.running === run && this.fail(run.revision, failure as Refusal),
    );
  }

  private finish(revision: number, state: State, final: boolean): void {
    this.running = null;
    this.listener.answered({ revision, state, final });
    if (this.wanted && this.wanted.revision !== revision) this.start(false);
    else if (final) this.listener.idle();
    else this.timer = window.setTimeout(() => this.start(true), pause_ms);
  }

  private fail(revision: number, refusal: Refusal): void {
    this.running = null;
    if (this.wanted && this.wanted.revision !== revision) return this.start(false);
    if (refusal.reason !== 'superseded' && refusal.reason !== 'stopped') this.listener.refused(revision, refusal);
    this.listener.idle();
  }
}
