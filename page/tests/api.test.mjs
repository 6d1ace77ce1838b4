import assert from 'node:assert/strict';
import test from 'node:test';
import { loadModule } from './load_module.mjs';

test('what is given up while its answer arrives is stopped, not failed', async () => {
  const { evolve, readItems } = await loadModule('api.ts');
  const control = new AbortController();
  const former = globalThis.fetch;
  // The first line of an answer that never ends by itself; without a signal it breaks.
  globalThis.fetch = async (_, { signal }) => {
    const start = (stream) => {
      stream.enqueue(new TextEncoder().encode('{"time_s": 0}\n'));
      signal?.addEventListener('abort', () => stream.error(signal.reason));
      if (!signal) stream.error(new TypeError('network error'));
    };
    return new Response(new ReadableStream({ start }));
  };
  try {
    await assert.rejects(evolve({}, 'a', () => control.abort(), control.signal), { reason: 'stopped' });
    await assert.rejects(readItems(), { reason: 'unreachable' });
  } finally {
    globalThis.fetch = former;
  }
});
