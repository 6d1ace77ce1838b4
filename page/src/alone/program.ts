// The program as WebAssembly in a worker of this page, in the place of a server: one request after another.
import { Refusal, type Program } from '../api';
import { cannotRun } from './needed';
import type { FromWorker, Open, PackedTable, Saved, Start, ToWorker } from './messages';

interface Job {
  id: number;
  method: string;
  target: string;
  body: string;
  files?: File[];
  /** Of them the one that is being opened, and why others cannot be. */
  place?: number;
  sentences: string[];
  /** How far what is computed has come, for who asks the same address. */
  state?: string;
  isLeft?: boolean;
  pieces?: ReadableStreamDefaultController<Uint8Array>;
  answered(answer: Response): void;
  opened(sentences: string[]): void;
  failed(reason: Error): void;
}

/** Work that nobody waits for any more may go on so long; then its worker is ended: with nothing in it, or with files and
 * what was computed from them. */
const patience_ms = 2000, patience_with_files_ms = 10_000;
const lost = 'Stopped; moduli that were computed before must be computed again.';

/** So long may a file be read without a sign of life; a damaged one may keep HDF5 busy for ever. */
const silence_ms = 60_000;
const hasBroken = (name: string) => `Reading ${name} broke the program down; it was started again without that file.`;
const hasChanged = (name: string) =>
  `${name} has been changed, moved or removed since it was given: give it again. The program was started again without it.`;
const isSilent = (name: string) =>
  `Nothing could be read of ${name} for ${silence_ms / 1000} s; the program was started again without that file.`;
const json = { 'Content-Type': 'application/json' };
const isSession = ({ name }: File) => name.endsWith('.toml');
const aborted = () => new DOMException('', 'AbortError');

/** What the worker is made of, as it stands in the page. */
export interface Parts {
  script: string;
  /** Compiled once for all workers. */
  code: Promise<WebAssembly.Module>;
  tables: PackedTable[];
}

export interface Listener {
  /** What was exported. */
  saved(file: Saved): void;
  /** The program has ended and begins anew, or cannot: in one sentence. */
  restarted(sentence: string): void;
}

export class ProgramInPage implements Program {
  private worker!: Worker;
  private queue: Job[] = [];
  private running: Job | null = null;
  private isReady = false;
  /** Why there is no program at all, once that is known. */
  private absence: Refusal | null = null;
  private last = 0;
  /** Files that were given together, in the order of their folders. */
  private given: File[][] = [];
  private itemFiles = new Map<number, File>();
  /** What was changed of items, to be said again to the next worker. */
  private changes = new Map<string, string>();
  /** The timer that ends reading without a sign of life. */
  private silence = 0;

  constructor(
    private readonly parts: Parts,
    private readonly listener: Listener,
  ) {
    this.start();
  }

  answer(path: string, options: RequestInit): Promise<Response> {
    const method = options.method ?? 'GET';
    const body = String(options.body ?? '');
    if (method === 'PATCH') this.changes.set(path, body);
    if (method === 'DELETE') this.leave((job) => job.target === path && job.method === 'POST');
    const { running } = this;
    if (method === 'GET' && running?.target === path && running.state !== undefined)
      return Promise.resolve(new Response(running.state, { headers: json }));
    return new Promise((answered, failed) => {
      const job = this.add({ method, target: path, body, answered, failed, opened: () => undefined });
      options.signal?.addEventListener('abort', () => this.leave((each) => each === job));
      if (options.signal?.aborted) this.leave((each) => each === job);
    });
  }

  async picture(path: string): Promise<string> {
    const answer = await this.answer(path, {});
    if (!answer.ok) throw new Error(path);
    return URL.createObjectURL(await answer.blob());
  }

  /** Lists recordings, cases, results and tables, and restores sessions: why some of them cannot be opened. */
  open(files: File[]): Promise<string[]> {
    // Sessions last: they name recordings that may have been given with them.
    const sorted = [...files].sort((a, b) => Number(isSession(a)) - Number(isSession(b)));
    this.given.push(sorted);
    return this.openAgain(sorted);
  }

  private openAgain(files: File[]): Promise<string[]> {
    return new Promise((opened, failed) => {
      this.add({ method: '', target: '', body: '', files, opened, failed, answered: () => undefined });
    });
  }

  private add(wanted: Omit<Job, 'id' | 'sentences'>): Job {
    const job = { ...wanted, id: ++this.last, sentences: [] };
    if (this.absence) this.fail(job, this.absence);
    else this.queue.push(job);
    this.next();
    return job;
  }

  /** What waits is forgotten; what runs ends when it looks for messages, or else with its worker. */
  private leave(isMeant: (job: Job) => boolean): void {
    const left = this.queue.filter(isMeant);
    this.queue = this.queue.filter((job) => !left.includes(job));
    const running = this.running;
    if (running && isMeant(running)) {
      left.push(running);
      Object.assign(running, { isLeft: true, state: undefined });
      this.tell({ kind: 'leave', id: running.id });
      const hasFiles = this.given.length > 0;
      const end = () => this.running === running && this.begin(hasFiles ? lost : null);
      window.setTimeout(end, hasFiles ? patience_with_files_ms : patience_ms);
    }
    for (const job of left) this.fail(job, aborted());
  }

  private fail(job: Job, reason: Error): void {
    job.failed(reason);
    try {
      job.pieces?.error(reason);
    } catch {
      // it had been read to its end
    }
  }

  private tell(message: ToWorker): void {
    this.worker.postMessage(message);
  }

  private start(): void {
    this.isReady = false;
    const address = URL.createObjectURL(new Blob([this.parts.script], { type: 'text/javascript' }));
    const worker = new Worker(address);
    this.worker = worker;
    const isCurrent = () => this.worker === worker;
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => isCurrent() && this.take(data);
    worker.onerror = ({ message }) => isCurrent() && this.restart(message);
    const { code, tables } = this.parts;
    code.then(
      (compiled) => isCurrent() && this.tell({ kind: 'start', code: compiled, tables } satisfies Start),
      (failure) => isCurrent() && this.restart(failure instanceof Error ? failure.message : String(failure)),
    );
  }

  private next(): void {
    if (!this.isReady || this.running) return;
    const job = this.queue.shift();
    if (!job) return;
    this.running = job;
    this.listen();
    const { id, method, target, body, files } = job;
    this.tell(files ? ({ kind: 'open', id, files } satisfies Open) : { kind: 'ask', id, method, target, body });
  }

  private take(message: FromWorker): void {
    if (message.kind === 'ready') {
      this.isReady = true;
      return this.next();
    }
    if (message.kind === 'broken') return this.restart(message.reason, message.hasChanged ? hasChanged : hasBroken);
    const job = this.running;
    if (!job || job.id !== message.id) return;
    if (message.kind === 'head') this.takeHead(job, message.status, message.headers);
    else if (message.kind === 'piece') this.takePiece(job, message.piece);
    else if (message.kind === 'works') this.takeState(job, message.state);
    else if (message.kind === 'opens') job.place = message.place;
    else if (message.kind === 'opened') this.takeOpened(job, message.place, message.item, message.sentence);
    else this.end(job, message.saved);
    this.listen();
  }

  /** To the worker, as long as it reads a file. */
  private listen(): void {
    window.clearTimeout(this.silence);
    if (this.running && this.fileOf(this.running)) this.silence = window.setTimeout(() => this.restart('', isSilent), silence_ms);
  }

  private takeHead(job: Job, status: number, headers: Record<string, string>): void {
    const body = new ReadableStream<Uint8Array>({ start: (pieces) => void (job.pieces = pieces) });
    job.answered(new Response(body, { status, headers }));
  }

  private takePiece(job: Job, piece: Uint8Array): void {
    try {
      job.pieces?.enqueue(piece);
    } catch {
      // its reader has left
    }
  }

  /** As over HTTP what takes long is answered with its state, which is asked for again until it has ended. */
  private takeState(job: Job, state: string | undefined): void {
    if (job.isLeft || state === undefined) return;
    job.state = state;
    job.answered(new Response(state, { status: 202, headers: json }));
    const asks = ({ method, target }: Job) => method === 'GET' && target === job.target;
    for (const waiting of this.queue.filter(asks)) waiting.answered(new Response(state, { headers: json }));
    this.queue = this.queue.filter((waiting) => !asks(waiting));
  }

  private takeOpened(job: Job, place: number, item: number | null, sentence: string): void {
    if (item !== null) this.itemFiles.set(item, job.files![place]);
    if (sentence !== '') job.sentences.push(sentence);
  }

  private end(job: Job, saved: Saved | undefined): void {
    if (saved) this.listener.saved(saved);
    try {
      job.pieces?.close();
    } catch {
      // its reader has left
    }
    job.opened(job.sentences);
    this.running = null;
    this.next();
  }

  /** The worker has broken down, or is silent. */
  private restart(reason: string, sentence = hasBroken): void {
    if (!this.isReady) {
      this.worker.terminate();
      const sentence = cannotRun(reason);
      this.absence = new Refusal(0, 'unreachable', sentence);
      for (const job of this.queue.splice(0)) this.fail(job, this.absence);
      return this.listener.restarted(sentence);
    }
    const culprit = this.running && this.fileOf(this.running);
    // In its place stands a file without content: the others keep their numbers.
    this.given = this.given.map((files) => files.map((file) => (file === culprit ? new File([], file.name) : file)));
    this.begin(
      culprit ? sentence(culprit.name) : 'The program broke down and was started again; please report what you did.',
    );
  }

  private failRunning(sentence: string): void {
    const job = this.running;
    this.running = null;
    if (job) this.fail(job, new Refusal(0, 'unreachable', sentence));
  }

  /** Another worker with the same files takes the place of the one before, and answers what waits. */
  private begin(sentence: string | null): void {
    this.worker.terminate();
    this.failRunning(sentence ?? 'Stopped.');
    this.listen();
    const waiting = this.queue;
    this.queue = [];
    this.itemFiles.clear();
    this.start();
    for (const files of this.given) void this.openAgain(files).catch(() => undefined);
    for (const [path, body] of this.changes) void this.answer(path, { method: 'PATCH', body }).catch(() => undefined);
    this.queue.push(...waiting);
    if (sentence) this.listener.restarted(sentence);
  }

  private fileOf(job: Job): File | null {
    if (job.files) return job.place === undefined ? null : job.files[job.place];
    const item = /^\/api\/items\/(\d+)/.exec(job.target)?.[1];
    return (item !== undefined && this.itemFiles.get(Number(item))) || null;
  }
}
