// What the mock answers below /api/items.
import { MockRecordings } from './recordings.mjs';

let recordings = new MockRecordings();

/** Starts anew; the second recording has so many events. */
export const resetRecordings = (events) => void (recordings = new MockRecordings(events));

const send = (response, body, status = 200) => {
  response.writeHead(status, { 'Content-Type': 'application/json' });
  response.end(JSON.stringify(body));
};

async function bodyOf(request) {
  let text = '';
  for await (const piece of request) text += piece;
  return text ? JSON.parse(text) : {};
}

function columns({ response, url }, item) {
  const features = url.searchParams.get('features').split(',');
  const wide = url.searchParams.get('type') === 'float64';
  const found = features.map((feature) => recordings.column(item, feature));
  const head = { features, events: found[0].length, type: wide ? 'float64' : 'float32' };
  response.writeHead(200, { 'Content-Type': 'application/octet-stream', 'X-Rheocyte-Columns': JSON.stringify(head) });
  for (const values of found) response.write(Buffer.from((wide ? values : Float32Array.from(values)).buffer));
  response.end();
}

const picture = (kind) => ({ response }, item, event) => {
  response.writeHead(200, { 'Content-Type': 'image/png' });
  response.end(recordings.picture(Number(item), Number(event), kind));
};

const routes = [
  ['GET', /^\/api\/items$/, ({ response }) => send(response, recordings.list())],
  ['GET', /^\/api\/items\/(\d+)$/, ({ response }, item) => send(response, recordings.item(Number(item)))],
  ['PATCH', /^\/api\/items\/(\d+)$/, async ({ request, response }, item) => {
    Object.assign(recordings.items[item].about, await bodyOf(request));
    send(response, recordings.item(Number(item)));
  }],
  ['GET', /^\/api\/items\/(\d+)\/events$/, (context, item) => columns(context, Number(item))],
  ['GET', /^\/api\/items\/(\d+)\/events\/(\d+)$/, ({ response }, item, event) => send(response, recordings.event(Number(item), Number(event)))],
  ['GET', /^\/api\/items\/(\d+)\/events\/(\d+)\/image$/, picture('image')],
  ['GET', /^\/api\/items\/(\d+)\/events\/(\d+)\/mask$/, picture('mask')],
  ['POST', /^\/api\/items\/(\d+)\/moduli$/, async ({ request, response }, item) => {
    recordings.start(Number(item), await bodyOf(request));
    send(response, recordings.moduli(Number(item)), 202);
  }],
  ['GET', /^\/api\/items\/(\d+)\/moduli$/, ({ response }, item) => send(response, recordings.moduli(Number(item)))],
  ['DELETE', /^\/api\/items\/(\d+)\/moduli$/, ({ response }, item) => {
    recordings.stop(Number(item));
    send(response, recordings.moduli(Number(item)));
  }],
  ['GET', /^\/api\/items\/(\d+)\/lines$/, ({ response, url }) => send(response, recordings.lines(url.searchParams.get('x'), url.searchParams.get('y')))],
];

/** The handler of a request, if it is one about items. */
export function recordingRoute(method, path) {
  for (const [own, pattern, handle] of routes) {
    const match = own === method && pattern.exec(path);
    if (match) return (context) => handle(context, ...match.slice(1));
  }
  return undefined;
}
