// The worker: the program as WebAssembly (src/engine/engine.cc), whose loader stands before this script.
import type { Ask, FromWorker, Open, Saved, Start, ToWorker } from './messages';
import { BlockReader } from './block_reader';
import { isSession, withPaths } from './session_paths';
import { unpackedTable } from './unpacked';
import { zipOf } from './zip';

interface Engine {
  ccall(name: string, returns: 'string' | 'number' | null, types: string[], values: (string | number)[]): string;
  stringToNewUTF8(text: string): number;
  _free(place: number): void;
  FS: {
    mkdirTree(path: string): void;
    mount(type: unknown, options: { files: File[] }, place: string): void;
    writeFile(path: string, bytes: Uint8Array): void;
    readFile(path: string): Uint8Array;
    readdir(path: string): string[];
    stat(path: string): { mode: number };
    isDir(mode: number): boolean;
    unlink(path: string): void;
    rmdir(path: string): void;
  };
  WORKERFS: { stream_ops: { read: Read } };
  wasmTable: { get(place: number): Compute };
}

/** Of the files that are mounted. */
type Read = (stream: { node: { contents: Blob } }, buffer: Uint8Array, offset: number, length: number, position: number) => number;

declare class FileReaderSync {
  readAsArrayBuffer(piece: Blob): ArrayBuffer;
}

declare function rheocyteEngine(options: object): Promise<Engine>;

type Compute = (...values: number[]) => unknown;
/** Promises within WebAssembly, which not all browsers have. */
const pauses = WebAssembly as unknown as { Suspending?: new (wait: unknown) => unknown; promising(compute: Compute): Compute };

const tables = '/tables', exports = '/exports', given = '/recordings', sessions = '/sessions';

let engine: Engine;
/** Answers a request: method, target and body as places in memory, and the size of the body. */
let compute: Compute;
let opened = 0;
/** Of tables and files that were given, by their names. */
const places = new Map<string, string>();
/** Of what is answered now. */
let id = 0;
let head = { status: 0, type: '', headers: {} as Record<string, string> };
let text = '';
/** Of what is computed now. */
let target = '';
let looked = 0, isLooking = false, isLeft = false;

const tell = (message: FromWorker, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

const question = new FileReaderSync();
const reader = new BlockReader((piece) => question.readAsArrayBuffer(piece));
const readBlocks: Read = ({ node: { contents } }, buffer, offset, length, position) =>
  reader.fill(buffer.subarray(offset, offset + length), contents, position);

const isExport = (target: string) => target === '/api/export';

/** While the program asks whether it should go on, messages are taken: without that it ends with its worker alone. */
const canPause = pauses.Suspending !== undefined;

/** For the loader, which makes of the exports those that it calls. */
type Take = (instance: WebAssembly.Instance) => WebAssembly.Exports;

const instantiate = (program: WebAssembly.Module) => (imports: WebAssembly.Imports, take: Take) => {
  for (const part of Object.values(imports))
    for (const [key, value] of Object.entries(part))
      if (canPause && (value as { name?: string }).name === 'engine_is_wanted')
        part[key] = new pauses.Suspending!(value) as WebAssembly.ImportValue;
  return take(new WebAssembly.Instance(program, imports));
};

function pausing(whole: Compute): Compute {
  try {
    return canPause ? pauses.promising(whole) : whole;
  } catch {
    return whole; // that stands in for the program
  }
}

async function start(message: Start): Promise<void> {
  engine = await rheocyteEngine({
    instantiateWasm: instantiate(message.code),
    print: () => undefined,
    printErr: () => undefined,
    takeHead: (status: number, type: string, headers: Record<string, string>) => void (head = { status, type, headers }),
    takePiece,
    isWanted,
  });
  engine.WORKERFS.stream_ops.read = readBlocks;
  for (const folder of [tables, exports, given, sessions]) engine.FS.mkdirTree(folder);
  for (const table of message.tables) {
    places.set(table.name, `${tables}/${table.name}`);
    engine.FS.writeFile(`${tables}/${table.name}`, await unpackedTable(table));
  }
  engine.ccall('rheocyte_start', null, ['string', 'string'], [tables, exports]);
  compute = pausing(engine.wasmTable.get(Number(engine.ccall('rheocyte_entry', 'number', [], []))));
  tell({ kind: 'ready' });
}

/** Lets a message of the page be taken while the program waits. */
const messages = new MessageChannel();
const messageTaken = () =>
  new Promise<void>((taken) => {
    messages.port1.onmessage = () => taken();
    messages.port2.postMessage(null);
  });

const look_every_ms = 100;
/** Of work whose state can be asked for. */
const hasState = /^\/api\/items\/\d+\/moduli$/;

/** Asked by the program while it computes, as often as it likes: whether the page still waits. Tells that it works. */
function isWanted(): boolean | Promise<boolean> {
  if (isLeft || isLooking || performance.now() - looked < look_every_ms) return !isLeft;
  looked = performance.now();
  tell({ kind: 'works', id, state: hasState.test(target) ? state() : undefined });
  return canPause ? messageTaken().then(() => !isLeft) : true;
}

/** The program answers a question within the answer that it computes. */
function state(): string | undefined {
  const outer = head;
  text = '';
  isLooking = true;
  engine.ccall('rheocyte_request', null, ['string', 'string', 'number', 'number'], ['GET', target, 0, 0]);
  isLooking = false;
  const found = head.status === 200 ? text : undefined;
  head = outer;
  text = '';
  return found;
}

let isHeadSent = false;
let exporting = false;

function takePiece(piece: Uint8Array): void {
  if (exporting || isLooking) return void (text += new TextDecoder().decode(piece));
  sendHead();
  tell({ kind: 'piece', id, piece }, [piece.buffer]);
}

function sendHead(): void {
  if (isHeadSent) return;
  isHeadSent = true;
  tell({ kind: 'head', id, status: head.status, headers: { ...head.headers, 'Content-Type': head.type } });
}

function begin(message: Ask | Open): void {
  id = message.id;
  isHeadSent = false;
  text = '';
}

/** A file, or all files of a folder, which leave the file system of the program. */
function taken(place: string): Saved {
  const name = place.split('/').pop()!;
  const { FS } = engine;
  if (!FS.isDir(FS.stat(place).mode)) {
    const bytes = FS.readFile(place);
    FS.unlink(place);
    return { name, bytes };
  }
  const files: Saved[] = [];
  const gather = (folder: string) => {
    for (const entry of FS.readdir(folder).filter((each) => each !== '.' && each !== '..')) {
      const path = `${folder}/${entry}`;
      if (FS.isDir(FS.stat(path).mode)) gather(path);
      else {
        files.push({ name: path.slice(place.length - name.length), bytes: FS.readFile(path) });
        FS.unlink(path);
      }
    }
    FS.rmdir(folder);
  };
  gather(place);
  return { name: `${name}.zip`, bytes: zipOf(files) };
}

/** What is exported becomes a download of the page. */
function endExport(): Saved | undefined {
  const { file } = JSON.parse(text) as { file?: string };
  const saved = head.status === 200 && file ? taken(file) : undefined;
  exporting = false;
  takePiece(new TextEncoder().encode(saved ? JSON.stringify({ file: `${saved.name}, among the downloads` }) : text));
  return saved;
}

async function ask(message: Ask): Promise<void> {
  begin(message);
  ({ target } = message);
  looked = performance.now();
  isLeft = false;
  exporting = isExport(target);
  const size = new TextEncoder().encode(message.body).length;
  // Not on the stack, on which others may stand when it goes on.
  const texts = [message.method, target, message.body].map((each) => engine.stringToNewUTF8(each));
  await compute(...texts, size);
  texts.forEach((place) => engine._free(place));
  const saved = exporting ? endExport() : undefined;
  sendHead();
  tell({ kind: 'end', id, saved }, saved ? [saved.bytes.buffer] : []);
}

const count = () => Number(engine.ccall('rheocyte_count', 'number', [], []));

/** Where a file is to be read: a session names files as they lie here. */
function placeOf(file: File, path: string): string {
  if (!file.name.endsWith('.toml')) return path;
  const text = new TextDecoder().decode(engine.FS.readFile(path));
  if (!isSession(text)) return path;
  const session = `${sessions}/${file.name}`;
  engine.FS.writeFile(session, new TextEncoder().encode(withPaths(text, places)));
  return session;
}

function open(message: Open): void {
  begin(message);
  const folder = `${given}/${++opened}`;
  engine.FS.mkdirTree(folder);
  engine.FS.mount(engine.WORKERFS, { files: message.files }, folder);
  for (const { name } of message.files) places.set(name, `${folder}/${name}`);
  message.files.forEach((file, place) => {
    tell({ kind: 'opens', id, place });
    const before = count();
    const sentence = engine.ccall('rheocyte_open', 'string', ['string'], [placeOf(file, `${folder}/${file.name}`)]);
    tell({ kind: 'opened', id, place, item: count() > before ? before : null, sentence });
  });
  tell({ kind: 'end', id });
}

self.onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  try {
    if (data.kind === 'start') await start(data);
    else if (data.kind === 'ask') await ask(data);
    else if (data.kind === 'leave') isLeft ||= data.id === id;
    else open(data);
  } catch (failure) {
    const hasChanged = failure instanceof DOMException && /^Not(Found|Readable)Error$/.test(failure.name);
    tell({ kind: 'broken', reason: String(failure instanceof Error ? failure.message : failure), hasChanged });
  }
};
