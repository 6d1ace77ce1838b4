// Reads pieces of files by whole blocks, the latest of which are kept: HDF5 asks for some bytes at a time, and each question
// to the browser takes far longer than what it brings.

const block_bytes = 1 << 18, most_blocks = 128;

export class BlockReader {
  /** By number of the file and place of the block; the last one that was used stands last. */
  private readonly blocks = new Map<string, Uint8Array>();
  private readonly numbers = new WeakMap<Blob, number>();
  private files = 0;

  constructor(private readonly read: (piece: Blob) => ArrayBuffer) {}

  /** Fills as much of the target as the file has from this place on, and returns how much. */
  fill(target: Uint8Array, file: Blob, place: number): number {
    const end = Math.min(file.size, place + target.length);
    for (let at = place; at < end; ) {
      const from = at % block_bytes;
      const part = this.block(file, at - from).subarray(from, from + end - at);
      if (part.length === 0) throw new Error('the file is shorter than it was');
      target.set(part, at - place);
      at += part.length;
    }
    return Math.max(0, end - place);
  }

  private block(file: Blob, first: number): Uint8Array {
    const number = this.numbers.get(file) ?? ++this.files;
    this.numbers.set(file, number);
    const key = `${number} ${first}`;
    const bytes = this.blocks.get(key) ?? new Uint8Array(this.read(file.slice(first, first + block_bytes)));
    this.blocks.delete(key);
    this.blocks.set(key, bytes);
    if (this.blocks.size > most_blocks) this.blocks.delete(this.blocks.keys().next().value!);
    return bytes;
  }
}
