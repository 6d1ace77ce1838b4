// Stands in for the program in tests of the page without a server: the same functions, answers that are easy to foresee.
function rheocyteEngine(module) {
  const files = new Map(), encode = (text) => new TextEncoder().encode(text);
  const listed = [];
  const FS = {
    mkdirTree() {},
    mount(_type, { files: given }, place) {
      for (const file of given) files.set(`${place}/${file.name}`, file);
    },
    writeFile: (path, bytes) => files.set(path, bytes),
    readFile: (path) => files.get(path),
    readdir: (path) => ['.', '..', ...[...files.keys()].filter((name) => name.startsWith(`${path}/`)).map((name) => name.slice(path.length + 1))],
    stat: (path) => ({ mode: files.has(path) ? 0 : 1 }),
    isDir: (mode) => mode === 1,
    unlink: (path) => files.delete(path),
    rmdir() {},
  };
  const answer = (text, status = 200) => {
    module.takeHead(status, 'application/json', { 'X-Kind': 'stand-in' });
    module.takePiece(encode(text));
  };
  let done = 0;
  const state = () => answer(JSON.stringify({ state: done > 0 ? 'running' : 'none', done }));
  const moduli = async (method) => {
    while (method === 'POST' && (await module.isWanted())) done = 0.5;
    done = 0;
    state();
  };
  const answers = {
    '/api/items/0/moduli': (method) => (method === 'GET' ? state() : moduli(method)),
    '/api/table': () => answer(new TextDecoder().decode(files.get('/tables/one.cbor'))),
    '/api/echo': (method, body) => answer(JSON.stringify({ method, body })),
    '/api/items': () => answer(JSON.stringify(listed)),
    '/api/breaks': () => {
      throw new Error('memory access out of bounds');
    },
    '/api/long': (method) => {
      if (method === 'DELETE') return answer('{}');
      for (const end = performance.now() + 60_000; performance.now() < end; );
    },
    '/api/state': (_method, _body, target) => {
      while (target.includes('endless'));
      answer('{}');
    },
    '/api/short': () => {
      for (const end = performance.now() + 500; performance.now() < end; );
      answer('{}');
    },
    '/api/export': (_method, body) => {
      const { name } = JSON.parse(body);
      if (name === 'folder') for (const part of ['a.txt', 'b.txt']) files.set(`/exports/folder/${part}`, encode(`content of ${part}`));
      else files.set(`/exports/${name}`, encode('content'));
      answer(JSON.stringify({ file: `/exports/${name}` }));
    },
  };
  const open = (path) => {
    const name = path.split('/').pop();
    while (name === 'hangs.rtdc' && files.get(path).size);
    if (name === 'breaks.rtdc' && files.get(path).size) throw new Error('HDF5 broke');
    listed.push({ item: listed.length, kind: 'recording', name, state: files.get(path).size ? 'ready' : 'failed', condition: '', replicate: '' });
    return name === 'odd.rtdc' ? 'odd.rtdc: is odd.' : '';
  };
  const request = (method, target, body) => {
    const path = target.split('?')[0];
    if (path === '/api/items/1/odd') throw new Error('HDF5 broke');
    if (path === '/api/items/0/gone') throw new DOMException('', 'NotReadableError');
    return (answers[path] ?? (() => answer('{"error": "There is no such address.", "reason": "unknown"}', 404)))(method, body, target);
  };
  const calls = { rheocyte_request: request, rheocyte_open: open, rheocyte_count: () => listed.length, rheocyte_start: () => '', rheocyte_entry: () => 0 };
  const memory = { stringToNewUTF8: (text) => text, _free() {} };
  return Promise.resolve({ FS, WORKERFS: { stream_ops: {} }, ...memory, wasmTable: { get: () => request }, ccall: (name, _returns, _types, values) => calls[name](...values) });
}
