// A server for development and for tests that need no program: the page, and answers in the shapes of the program's.
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { readKeys } from './keys.mjs';
import { recordingRoute, resetRecordings } from './recording_routes.mjs';
import { fieldsOf, linesOf, physicsOf, stateOf, stepOf, wrongKey } from './state.mjs';

const dist = fileURLToPath(new URL('../dist/', import.meta.url));
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css' };
const policy = "default-src 'self'; img-src 'self' blob: data:";
const media = [
  { medium: 'CellCarrier', name: '0.49 % MC-PBS (CellCarrier)' },
  { medium: 'water', name: 'water' },
];

const settings = [
  { name: 'table', label: 'Table', kind: 'text', unit: '' },
  { name: 'viscosity_mPas', label: 'Viscosity', kind: 'number', unit: 'mPa s' },
  { name: 'temperature', label: 'Temperature', kind: 'number', unit: 'degC' },
  { name: 'temperature_if_missing', label: 'Temperature if missing', kind: 'number', unit: 'degC' },
].map((each) => ({ ...each, sentence: each.label, words: [], default: '', usual: true }));

const features = [
  { name: 'emodulus', label: "Young's modulus E", unit: 'kPa' },
  { name: 'state', label: 'State of the modulus', unit: '' },
  { name: 'standard_error', label: 'Standard error of E', unit: 'kPa' },
];

const streams = new Map();
let session = null;

const answer = (response, status, body) => {
  response.writeHead(status, { 'Content-Type': 'application/json', 'Content-Security-Policy': policy });
  response.end(JSON.stringify(body));
};
const refuse = (response, status, reason, error, more = {}) => answer(response, status, { error, reason, ...more });

async function bodyOf(request) {
  let text = '';
  for await (const piece of request) text += piece;
  return text ? JSON.parse(text) : {};
}

async function state({ request, response, url }) {
  const sections = await bodyOf(request);
  const turn = (streams.get(url.searchParams.get('stream')) ?? 0) + 1;
  streams.set(url.searchParams.get('stream'), turn);
  await pause(Number(process.env.MOCK_DELAY_MS ?? 5));
  if (streams.get(url.searchParams.get('stream')) !== turn) return refuse(response, 409, 'superseded', 'A newer request came.');
  const physics = physicsOf(sections);
  const wrong = wrongKey(physics);
  if (wrong) return refuse(response, 400, 'case', 'The cell does not fit into the channel.', { key: wrong });
  if (physics.deformation > 0.15) {
    const modulus = (sections.cell.bulk.young_modulus_kPa * physics.deformation) / 0.14;
    const bulk = { ...sections.cell.bulk, young_modulus_kPa: Number(modulus.toPrecision(4)) };
    const nearest = { ...sections, cell: { ...sections.cell, bulk } };
    const last = { deformation: 0.14, reached: 0.9 };
    return refuse(response, 422, 'no-state', 'The surface of the rear shoulder wrinkles: no smooth shape exists.', { nearest, last });
  }
  response.writeHead(200, { 'Content-Type': 'application/octet-stream', 'Content-Security-Policy': policy });
  response.write(`${JSON.stringify(stateOf(physics, Number(url.searchParams.get('accuracy'))))}\n`);
  response.end(fieldsOf(physics));
}

async function evolve({ request, response }) {
  const physics = physicsOf(await bodyOf(request));
  response.writeHead(200, { 'Content-Type': 'application/x-ndjson' });
  for (let k = 0; k <= 40; ++k) {
    response.write(`${JSON.stringify(stepOf(physics, k / 40))}\n`);
    await pause(5);
  }
  response.end(`${JSON.stringify({ result: stateOf(physics, 1e-4) })}\n`);
}

async function text({ request, response }) {
  const sections = await bodyOf(request);
  const python = `import rheocyte\ncell = rheocyte.solve(${JSON.stringify(sections)})\n`;
  answer(response, 200, { toml: '', command: 'rheocyte solve case.toml', python });
}

async function keepSession({ request, response }) {
  session = (await bodyOf(request)).page;
  answer(response, 200, {});
}

async function exported({ request, response }) {
  const { name } = await bodyOf(request);
  answer(response, 200, { file: join('/somewhere', name) });
}

const routes = {
  'GET /api/health': ({ response }) => answer(response, 200, { status: 'ok', program: 'rheocyte', version: 'mock', threads: 1 }),
  'GET /api/keys': ({ response }) => answer(response, 200, readKeys()),
  'GET /api/settings': ({ response }) => answer(response, 200, settings),
  'GET /api/features': ({ response }) => answer(response, 200, features),
  'GET /api/media': ({ response }) => answer(response, 200, media),
  'GET /api/media/viscosity': ({ response }) => answer(response, 200, { law: 'power-law', consistency_Pa_sn: 0.179, exponent: 0.677 }),
  'POST /api/state': state,
  'POST /api/evolve': evolve,
  'POST /api/case/text': text,
  'GET /api/lines': ({ response }) => answer(response, 200, linesOf()),
  'GET /api/session': ({ response }) => answer(response, 200, { page: session }),
  'PUT /api/session': keepSession,
  'POST /api/export': exported,
};

async function asset(response, path) {
  const name = normalize(path === '/' ? '/index.html' : path);
  try {
    const bytes = await readFile(join(dist, `${name}.gz`));
    const head = { 'Content-Type': types[extname(name)] ?? 'application/octet-stream', 'Content-Encoding': 'gzip' };
    response.writeHead(200, { ...head, 'Content-Security-Policy': policy });
    response.end(bytes);
  } catch {
    refuse(response, 404, 'path', `There is no ${path}.`);
  }
}

/** Starts on a free port of the loopback address, or on the given one; resolves to its address and a way to stop it. */
export async function startMock(port = 0) {
  session = null;
  resetRecordings();
  const server = createServer((request, response) => {
    const url = new URL(request.url, 'http://localhost');
    const route = routes[`${request.method} ${url.pathname}`] ?? recordingRoute(request.method, url.pathname);
    const work = route ? route({ request, response, url }) : asset(response, url.pathname);
    Promise.resolve(work).catch((failure) => refuse(response, 500, 'mock', String(failure)));
  });
  await new Promise((ready) => server.listen(port, '127.0.0.1', ready));
  return { address: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) console.log(`mock: ${(await startMock(8765)).address}`);
