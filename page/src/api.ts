// The program's interface: types of requests and answers, and one function for each of them.

export type Value = number | string | number[];
/** A case by dotted names, as in the case reference: "cell.radius_um" -> 7.66. */
export type Case = Record<string, Value>;
/** A case as the program writes it: sections within sections. */
export interface Sections {
  [name: string]: Value | Sections;
}

export interface KeyDescription {
  name: string;
  section: string;
  unit: string;
  sentence: string;
  kind: 'number' | 'choice' | 'word' | 'list';
  least?: number;
  greatest?: number;
  whole?: boolean;
  options?: string[];
  default: Value | null;
  required: boolean;
  only_for: { key: string; option: string; negated: boolean } | null;
  alternative: string | null;
}

/** A setting of the moduli of recordings, as the program declares it. */
export interface Setting {
  name: string;
  label: string;
  sentence: string;
  kind: 'number' | 'text' | 'texts' | 'choice' | 'flag';
  unit: string;
  /** The options of a choice; of a text some that are common. */
  words: string[];
  /** What holds without it. */
  default: string;
  /** Whether its field is in sight. */
  usual: boolean;
}

/** A feature that the program computes. */
export interface Feature {
  name: string;
  label: string;
  unit: string;
}

export interface Medium {
  medium: string;
  name: string;
}

export interface MediumLaw {
  law: string;
  viscosity_mPas?: number;
  consistency_Pa_sn?: number;
  exponent?: number;
}

export interface Outline {
  x_um: number[];
  r_um: number[];
}

/** What stands before the numbers of fields on a triangle mesh of the half plane r >= 0. */
export interface FieldsHead {
  points: number;
  triangles: number;
  /** in the order in which they follow, little endian; "values/stress_Pa" is "stress_Pa" among the values */
  arrays: { name: string; type: 'float32' | 'uint32' | 'uint8'; count: number }[];
  surface?: { x_um: number[]; r_um: number[]; tension_mN_per_m?: number[] };
  wall?: Outline;
}

export interface EncodedFields {
  head: FieldsHead;
  bytes: ArrayBuffer;
}

/** The same as text: base64 of each array under its name. */
export interface FieldsText {
  xy_um: string;
  index: string;
  region: string;
  values: Record<string, string>;
  surface?: FieldsHead['surface'];
  surface3d?: { xyz_um: string; index: string };
  wall?: Outline;
}

/** The keys of result.json that the page reads by name; there are more. */
export interface Result {
  status: string;
  message: string;
  deformation: number;
  area_um2: number;
  cell_velocity_m_per_s: number;
  pressure_drop_Pa: number;
  stability_margin: number | null;
  estimated_error: number | null;
  /** of each measure, in its unit */
  errors: Record<string, number | null>;
  /** of each measure by the numbers of the case that were asked for */
  gradients: Record<string, Record<string, number | null>>;
  wall_time_s: number;
  tube_radius_um: number;
  case: Sections;
  [name: string]: unknown;
}

export interface State extends Result {
  contour: Outline;
  hull: Outline;
  contours?: Contours;
}

/** In ducts: seen along the height, and along the diagonal (square) or the width. */
export interface Contours {
  side: Outline;
  diagonal?: Outline;
  across?: Outline;
}

export interface TimeStep {
  time_s: number;
  x_um: number;
  deformation: number;
  /** in a duct that is not alike along height and width: seen along the width */
  deformation_across?: number;
  /** of a cell off the axis, where it is now */
  offset_um?: number;
  velocity_m_per_s: number;
  contour: Outline;
  contours?: Contours;
  /** of a channel that is not straight, relative to the cell; of a duct half its width */
  wall?: Outline;
  progress: number;
  /** of some steps, where there are many */
  fields?: FieldsText;
}

export interface Isoelastic {
  young_modulus_kPa: number;
  x: number[];
  y: number[];
}

export interface Lines {
  lines: Isoelastic[];
  range?: { x: number[]; y: number[] } | null;
  table?: string | null;
  sentence?: string;
}

export type ItemKind = 'recording' | 'case' | 'result' | 'table' | 'combined';

export interface Item {
  item: number;
  kind: ItemKind;
  name: string;
  state: 'ready' | 'loading' | 'failed';
  error?: string;
  /** Another text as soon as the files have changed. */
  version?: string;
  events?: number;
  conditions?: Record<string, number | string | null>;
  /** of events by the names of their states, once there are moduli */
  counts?: Record<string, number>;
  condition: string;
  replicate: string;
  features?: string[];
  metadata?: Record<string, unknown>;
  case?: Sections;
}

export interface Columns {
  features: string[];
  events: number;
  /** Of the files that they were read from. */
  version?: string;
  columns: Float32Array[] | Float64Array[];
}

export interface Curve {
  x_um: number[];
  y_um: number[];
}

/** The model's cell of an event, laid over its image. */
export interface EventModel extends Curve {
  /** At each point of the outline: its distance from the centroid less the model's, once their mean radii agree. */
  residual_um: number[];
  residual_rms_um: number;
  source?: string;
}

/** The cell with bulk and cortex that a combined table has for an event. */
export interface CombinedCell {
  table: string;
  status: string;
  sentence: string;
  young_modulus_kPa: number | null;
  young_modulus_kPa_error: number | null;
  cortex_modulus_mN_per_m: number | null;
  cortex_modulus_mN_per_m_error: number | null;
  stiffness_kPa: number | null;
  stiffness_kPa_error: number | null;
  contour: Curve | null;
  case: Sections | null;
}

/** One event; curves in um from the upper left corner of the image, y downwards. */
export interface EventDetail {
  features: Record<string, number | null>;
  /** Of the files that it was read from. */
  version?: string;
  /** From deformation. */
  young_modulus_kPa: number | null;
  young_modulus_kPa_error: number | null;
  /** As of an elongated cell: by the outline, or by the inertia ratio. */
  young_modulus_asymmetry_kPa?: number | null;
  young_modulus_asymmetry_kPa_error?: number | null;
  young_modulus_inertia_kPa?: number | null;
  young_modulus_inertia_kPa_error?: number | null;
  state: string;
  sentence: string;
  pixel_um: number | null;
  outline: Curve | null;
  model: EventModel | null;
  combined?: CombinedCell | null;
  case: Sections | null;
}

/** What the number in an event's column "state" says. */
export interface ModulusState {
  number: number;
  name: string;
  has_modulus: boolean;
  sentence: string;
}

export interface Moduli {
  state: 'none' | 'running' | 'ready' | 'failed';
  done: number;
  error?: string;
  summary?: Record<string, unknown>;
  /** of events by the names of their states */
  counts?: Record<string, number>;
  lines?: string[];
  command?: string;
  /** of the moduli with cortex, where a combined table is there */
  command_several?: string;
}

/** Numbers, texts and flags by the names of their columns; null where there is no number. */
export type PopulationRow = Record<string, unknown>;

export interface PopulationRecording extends PopulationRow {
  recording: string;
  condition: string;
  /** from 1 on */
  session: number;
  failure: string | null;
  checks: { measure: string; fits: boolean }[];
}

/** What the page reads of population.json; there is more. */
export interface Population {
  /** solid, effective or cortex */
  model: string;
  /** what the model determines of the cells, the most accurate first; `median` is the column of the median */
  quantities: { quantity: string; median: string; symbol: string; unit: string }[];
  conditions: (PopulationRow & { condition: string })[];
  comparisons: (PopulationRow & { control: string; treated: string; quantity: string; ratio: number; p: number | null })[];
  recordings: PopulationRecording[];
  /** where conditions have doses */
  dose_responses?: (PopulationRow & { quantity: string; p_of_trend: number | null })[];
  doses?: { unit: string };
}

export interface PopulationAnswer {
  record: Population;
  lines: string[];
  command: string;
}

export interface PopulationCondition {
  name: string;
  /** in the order of the sessions */
  items: number[];
}

export interface ExportRequest {
  what: 'events' | 'companion' | 'session' | 'case' | 'result' | 'svg' | 'png';
  item?: number;
  gate?: number[] | null;
  /** of the recording to which the gate belongs */
  version?: string;
  case?: Sections;
  name?: string;
  data?: string;
}

/** What went wrong, in the program's own sentence; `reason` is the word to decide by. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    readonly reason: string,
    sentence: string,
    readonly detail: { key?: string; nearest?: Sections; last?: { deformation?: number; reached?: number } } = {},
  ) {
    super(sentence);
  }
}

async function refusal(answer: Response): Promise<Refusal> {
  const text = await answer.text();
  try {
    const body = JSON.parse(text);
    return new Refusal(answer.status, body.reason ?? 'error', body.error ?? answer.statusText, body);
  } catch {
    return new Refusal(answer.status, 'error', text.trim() || answer.statusText);
  }
}

/** Who answers. */
export interface Program {
  answer(path: string, options: RequestInit): Promise<Response>;
  /** An address from which the browser loads a picture. */
  picture(path: string): Promise<string>;
}

/** Over HTTP, unless another one is put in its place. */
let program: Program = {
  answer: (path, options) => fetch(path, { credentials: 'same-origin', ...options }),
  picture: async (path) => path,
};
export const askOf = (other: Program): void => void (program = other);
export const addressOfPicture = (path: string): Promise<string> => program.picture(path);

async function request(path: string, options: RequestInit = {}): Promise<Response> {
  const answer = await program.answer(path, options).catch(give);
  if (!answer.ok) throw await refusal(answer);
  return answer;
}

/** An answer that did not come, or not to its end: because it was given up here, or because the program has gone. */
function broken(failure: unknown): Refusal {
  if (failure instanceof Refusal) return failure;
  if (failure instanceof DOMException && failure.name === 'AbortError') return new Refusal(0, 'stopped', 'Stopped.');
  return new Refusal(0, 'unreachable', 'The program does not answer; is it still running in its terminal?');
}

function give(failure: unknown): never {
  throw broken(failure);
}

export async function json<T>(path: string, options: RequestInit = {}): Promise<T> {
  return (await request(path, options)).json().catch(give) as Promise<T>;
}

export function sending(method: string, body: unknown, signal?: AbortSignal): RequestInit {
  return { method, body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' }, signal };
}

function query(values: Record<string, string | number | undefined>): string {
  const given = Object.entries(values).filter(([, value]) => value !== undefined);
  return new URLSearchParams(given.map(([name, value]) => [name, String(value)])).toString();
}

export const readHealth = () => json<{ status: string; version: string; threads: number }>('/api/health');
export const readKeys = () => json<KeyDescription[]>('/api/keys');
export const readMedia = () => json<Medium[]>('/api/media');
export const readMediumLaw = (medium: string, temperature: number) =>
  json<MediumLaw>(`/api/media/viscosity?${query({ medium, temperature })}`);

/** A stream of this window alone: two windows of one program do not cancel each other. */
export const streamOf = (name: string) => `${name}-${Math.random().toString(36).slice(2)}`;

/** An answer that is read as it arrives: lines first, then bytes. */
class Parts {
  private readonly reader: ReadableStreamDefaultReader<Uint8Array>;
  private rest: Uint8Array = new Uint8Array(0);

  constructor(answer: Response) {
    this.reader = answer.body!.getReader();
  }

  /** Adds what arrives next; false at the end. */
  private async more(): Promise<boolean> {
    const { value, done } = await this.reader.read();
    if (done) return false;
    const both = new Uint8Array(this.rest.length + value.length);
    both.set(this.rest);
    both.set(value, this.rest.length);
    this.rest = both;
    return true;
  }

  /** The next line without its end; null if there is none. */
  async line(): Promise<string | null> {
    let end = this.rest.indexOf(10);
    while (end < 0) {
      if (!(await this.more())) return null;
      end = this.rest.indexOf(10);
    }
    const text = new TextDecoder().decode(this.rest.subarray(0, end));
    this.rest = this.rest.subarray(end + 1);
    return text;
  }

  /** The next bytes in a buffer of their own; fewer of them if the answer ends before. */
  async bytes(count: number): Promise<ArrayBuffer> {
    const found = new Uint8Array(count);
    let filled = 0;
    const take = (piece: Uint8Array) => {
      found.set(piece.subarray(0, count - filled), filled);
      filled += piece.length;
    };
    take(this.rest);
    while (filled < count) {
      const { value, done } = await this.reader.read();
      if (done) return found.buffer.slice(0, filled);
      take(value);
    }
    void this.reader.cancel().catch(() => undefined);
    return found.buffer;
  }
}

export interface StateRequest {
  stream: string;
  accuracy: number;
}

/** The numbers of a state, and its fields, which come later. */
export interface Solution {
  state: State;
  fields: Promise<EncodedFields | null>;
}

const sizes = { float32: 4, uint32: 4, uint8: 1 };

async function readFields(parts: Parts): Promise<EncodedFields | null> {
  const line = await parts.line();
  if (line === null) return null;
  const head = JSON.parse(line) as FieldsHead;
  const wanted = head.arrays.reduce((sum, { type, count }) => sum + sizes[type] * count, 0);
  const bytes = await parts.bytes(wanted);
  return bytes.byteLength === wanted ? { head, bytes } : null;
}

export async function solveState(sections: Sections, want: StateRequest, signal?: AbortSignal): Promise<Solution> {
  const path = `/api/state?${query({ stream: want.stream, accuracy: want.accuracy, fields: 'after' })}`;
  const parts = new Parts(await request(path, sending('POST', sections, signal)));
  const line = await parts.line().catch(() => null);
  if (line === null) throw new Refusal(0, 'stopped', 'Stopped.');
  return { state: JSON.parse(line) as State, fields: readFields(parts).catch(() => null) };
}

/** The same with the gradients by all numbers of the case, without fields. */
export async function solveGradients(sections: Sections, want: StateRequest): Promise<State> {
  const path = `/api/state?${query({ stream: want.stream, accuracy: want.accuracy, gradient: 'all' })}`;
  return (await (await request(path, sending('POST', sections))).json()) as State;
}

export type EvolveLine = TimeStep | { result: Result } | { error: string };

/** Follows a cell in time with its fields; calls `take` with each line as it arrives. */
export async function evolve(
  sections: Sections,
  stream: string,
  take: (line: EvolveLine) => void,
  signal?: AbortSignal,
): Promise<void> {
  const answer = await request(`/api/evolve?${query({ stream, fields: 1 })}`, sending('POST', sections, signal));
  const reader = answer.body!.pipeThrough(new TextDecoderStream()).getReader();
  let rest = '';
  for (;;) {
    const { value, done } = await reader.read().catch(give);
    const lines = (rest + (value ?? '')).split('\n');
    rest = done ? '' : lines.pop()!;
    for (const line of lines) if (line.trim()) take(JSON.parse(line) as EvolveLine);
    if (done) return;
  }
}

export const caseText = (sections: Sections) =>
  json<{ toml: string; command: string; python: string }>('/api/case/text', sending('POST', sections));
export const readCase = (toml: string) => json<{ case: Sections }>('/api/case/read', sending('POST', { toml }));
export const readCaseLines = (sections: Sections, signal?: AbortSignal) =>
  json<Lines>(`/api/lines?${query({ case: JSON.stringify(sections) })}`, { signal });

export const readSettings = () => json<Setting[]>('/api/settings');
export const readFeatures = () => json<Feature[]>('/api/features');
export const readItems = () => json<Item[]>('/api/items');
export const readItem = (item: number) => json<Item>(`/api/items/${item}`);
export const changeItem = (item: number, change: { condition?: string; replicate?: string }) =>
  json<Item>(`/api/items/${item}`, sending('PATCH', change));

/** Columns of features, one array each, in the order asked for. */
export async function readEvents(
  item: number,
  features: string[],
  type: 'float32' | 'float64' = 'float32',
  signal?: AbortSignal,
): Promise<Columns> {
  const path = `/api/items/${item}/events?${query({ features: features.join(','), type })}`;
  const answer = await request(path, { signal });
  const head = JSON.parse(answer.headers.get('X-Rheocyte-Columns')!) as { features: string[]; events: number; version?: string };
  const bytes = await answer.arrayBuffer().catch(give);
  const size = type === 'float32' ? 4 : 8;
  const column = (k: number) =>
    type === 'float32'
      ? new Float32Array(bytes, k * head.events * size, head.events)
      : new Float64Array(bytes, k * head.events * size, head.events);
  return { ...head, columns: head.features.map((_, k) => column(k)) as Float32Array[] | Float64Array[] };
}

export const readEvent = (item: number, event: number, signal?: AbortSignal) =>
  json<EventDetail>(`/api/items/${item}/events/${event}`, { signal });
/** The address changes with the file, so that the browser asks for the picture again. */
export const eventPicture = (kind: 'image' | 'mask', item: number, event: number, version?: string) =>
  `/api/items/${item}/events/${event}/${kind}?${query({ version })}`;

export const readStates = () => json<ModulusState[]>('/api/states');
export const startModuli = (item: number, settings: Record<string, unknown>) =>
  json<Moduli>(`/api/items/${item}/moduli`, sending('POST', settings));
export const readModuli = (item: number) => json<Moduli>(`/api/items/${item}/moduli`);
export const stopModuli = (item: number) => request(`/api/items/${item}/moduli`, { method: 'DELETE' });
/** With gates as settings, or the numbers of the events within. */
export const readReport = (item: number, gates: Record<string, string[]> | { gate: number[] }, signal: AbortSignal) =>
  json<Pick<Moduli, 'summary' | 'counts' | 'lines'>>(`/api/items/${item}/report`, sending('POST', gates, signal));
export const readItemLines = (item: number, x: string, y: string) =>
  json<Lines>(`/api/items/${item}/lines?${query({ x, y })}`);

export const fitPopulation = (asked: { conditions: PopulationCondition[]; settings: Record<string, unknown> }, signal?: AbortSignal) =>
  json<PopulationAnswer>('/api/population', sending('POST', asked, signal));

export const exportFile = (what: ExportRequest, signal?: AbortSignal) =>
  json<{ file: string }>('/api/export', sending('POST', what, signal));
export const readSession = () => json<{ page: Record<string, unknown> | null }>('/api/session');
export const writeSession = (page: Record<string, unknown>) => json<unknown>('/api/session', sending('PUT', { page }));
