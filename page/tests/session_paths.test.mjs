import assert from 'node:assert/strict';
import test from 'node:test';
import { loadModule } from './load_module.mjs';

test('A session finds the files of the page by their names, also those with umlauts and apostrophes, and leaves other paths', async () => {
  const { withPaths, isSession } = await loadModule('alone/session_paths.ts');
  const line = (path) => `items = '''\n[{"path":${path},"condition":"a path"}]\n'''`;
  const places = new Map([['a.rtdc', '/recordings/2/a.rtdc'], ["M\u00fcller's.rtdc", "/recordings/1/M\u00fcller's.rtdc"]]);
  const found = (path) => withPaths(line(path), places);
  assert.equal(found('"/data/a.rtdc"'), line(' "/recordings/2/a.rtdc"'));
  assert.equal(found('"M\\u00fcller\\u0027s.rtdc"'), line(' "/recordings/1/M\\u00fcller\\u0027s.rtdc"'));
  assert.equal(found('"/data/b.rtdc"'), line('"/data/b.rtdc"'));
  assert.deepEqual([isSession('# A session of rheocyte view; ...\n'), isSession('[cell]\n')], [true, false]);
});
