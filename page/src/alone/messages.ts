// What page and worker say to each other.
export interface PackedTable {
  name: string;
  /** of most of its numbers, in bytes */
  size: number;
  content: string;
}

export interface Start {
  kind: 'start';
  code: WebAssembly.Module;
  tables: PackedTable[];
}

export interface Ask {
  kind: 'ask';
  id: number;
  method: string;
  /** path and query */
  target: string;
  body: string;
}

export interface Open {
  kind: 'open';
  id: number;
  /** files that were given together lie in one folder */
  files: File[];
}

/** Nobody waits any more for what is computed. */
export interface Leave {
  kind: 'leave';
  id: number;
}

export type ToWorker = Start | Ask | Open | Leave;

export interface Saved {
  name: string;
  bytes: Uint8Array;
}

export type FromWorker =
  | { kind: 'ready' }
  | { kind: 'head'; id: number; status: number; headers: Record<string, string> }
  | { kind: 'piece'; id: number; piece: Uint8Array }
  | { kind: 'end'; id: number; saved?: Saved }
  /** A sign of life; `state` is what GET of the same address would answer meanwhile: how far it has come. */
  | { kind: 'works'; id: number; state?: string }
  /** The file of this place among those given together is read now. */
  | { kind: 'opens'; id: number; place: number }
  /** The number of the item that it has become, if it is one; why it cannot be opened, or nothing. */
  | { kind: 'opened'; id: number; place: number; item: number | null; sentence: string }
  /** `hasChanged`: a file is no longer what it was when it was given. */
  | { kind: 'broken'; reason: string; hasChanged: boolean };
