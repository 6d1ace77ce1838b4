import assert from 'node:assert/strict';
import test from 'node:test';
import { loadModule } from './load_module.mjs';

test('Pieces of a file are those of the file, across blocks and at its end, and bytes that were read are not read again', async () => {
  const { BlockReader } = await loadModule('alone/block_reader.ts');
  const bytes = Uint8Array.from({ length: 600_000 }, (_, k) => (k * 7) % 251);
  let questions = 0;
  const file = { size: bytes.length, slice: (first, end) => bytes.slice(first, end) };
  const reader = new BlockReader((piece) => (++questions, piece.buffer));
  for (const [place, length] of [[0, 10], [262_140, 20], [599_990, 100], [100, 599_000], [600_000, 8], [700_000, 8]]) {
    const target = new Uint8Array(length);
    const count = reader.fill(target, file, place);
    assert.equal(count, Math.max(0, Math.min(length, bytes.length - place)));
    assert.deepEqual(target.subarray(0, count), bytes.subarray(place, place + count));
  }
  assert.equal(questions, 3);
});

test('A file that is shorter than it was when it was given is an error, not an endless question', async () => {
  const { BlockReader } = await loadModule('alone/block_reader.ts');
  const reader = new BlockReader(() => new ArrayBuffer(10));
  assert.throws(() => reader.fill(new Uint8Array(50), { size: 100, slice: () => null }, 0), /shorter/);
});
