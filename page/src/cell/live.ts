// The live solver: one request at a time, the newest case wins. First an answer good enough to look at, then the wanted one.
// The numbers and the contour of an answer are shown before its fields, which meanwhile are sampled, sent and painted.
import { Refusal, solveState, type EncodedFields, type Sections, type Solution, type State } from '../api';
import { nextPicture } from '../shell/next_picture';

export interface Answer {
  revision: number;
  state: State;
  /** false: display accuracy, the wanted one follows */
  final: boolean;
  /** counts the answers */
  order: number;
}

export interface Listener {
  busy(revision: number, refining: boolean): void;
  answered(answer: Answer): void;
  /** the fields of an answer, some time after it */
  sampled(order: number, fields: EncodedFields): void;
  refused(revision: number, refusal: Refusal): void;
  idle(): void;
}

interface Wanted {
  revision: number;
  sections: Sections;
  accuracy: number;
  /** good enough to look at while a slider moves */
  displayAccuracy: number;
}

/** Work younger than this is let finish when the next case is there: a moving slider shows every answer it can get. */
const patience_ms = 120;
const pause_ms = 200;

export class LiveSolver {
  private wanted: Wanted | null = null;
  private running: { revision: number; final: boolean; since: number; abort: AbortController } | null = null;
  private timer: number | undefined;
  private answers = 0;

  constructor(
    private readonly stream: string,
    private readonly listener: Listener,
  ) {}

  /** The newest case. What is under way for an older one is finished if it is young, else cancelled. */
  want(wanted: Wanted): void {
    this.wanted = wanted;
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
    const accuracy = final ? wanted.accuracy : Math.max(wanted.displayAccuracy, wanted.accuracy);
    const run = { revision: wanted.revision, final, since: performance.now(), abort: new AbortController() };
    this.running = run;
    this.listener.busy(run.revision, final);
    solveState(wanted.sections, { stream: this.stream, accuracy }, run.abort.signal).then(
      (solution) => this.running === run && this.finish(run.revision, solution, final || accuracy === wanted.accuracy),
      (failure) => this.running === run && this.fail(run.revision, failure as Refusal),
    );
  }

  private finish(revision: number, { state, fields }: Solution, final: boolean): void {
    this.running = null;
    const order = ++this.answers;
    this.listener.answered({ revision, state, final, order });
    // The contour is on the screen before the processor paints.
    const painted = Promise.all([fields, nextPicture()]).then(([found]) => found && this.listener.sampled(order, found));
    if (this.wanted && this.wanted.revision !== revision) this.start(false);
    else if (final) void painted.then(() => this.rest(revision));
    else this.timer = window.setTimeout(() => this.start(true), pause_ms);
  }

  /** Nothing is left to do, unless something has been wanted meanwhile. */
  private rest(revision: number): void {
    if (!this.running && this.wanted?.revision === revision) this.listener.idle();
  }

  private fail(revision: number, refusal: Refusal): void {
    this.running = null;
    if (this.wanted && this.wanted.revision !== revision) return this.start(false);
    if (refusal.reason !== 'superseded' && refusal.reason !== 'stopped') this.listener.refused(revision, refusal);
    this.listener.idle();
  }
}
