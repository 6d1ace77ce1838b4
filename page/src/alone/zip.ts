// Several files as one: a ZIP archive without compression.

const table = Uint32Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; ++bit) rest = rest & 1 ? 0xedb88320 ^ (rest >>> 1) : rest >>> 1;
  return rest;
});

function checksum(bytes: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = table[(sum ^ byte) & 255] ^ (sum >>> 8);
  return ~sum >>> 0;
}

/** Numbers of 2 or 4 bytes, little endian: [size, value]. */
function packed(...numbers: [2 | 4, number][]): Uint8Array {
  const bytes = new Uint8Array(numbers.reduce((sum, [size]) => sum + size, 0));
  let at = 0;
  for (const [size, value] of numbers) for (let k = 0; k < size; ++k) bytes[at++] = (value >>> (8 * k)) & 255;
  return bytes;
}

function joined(parts: Uint8Array[]): Uint8Array {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

const version = 20, utf8 = 0x0800, firstDay = 0x0021;

export function zipOf(files: { name: string; bytes: Uint8Array }[]): Uint8Array {
  const parts: Uint8Array[] = [], directory: Uint8Array[] = [];
  let at = 0;
  for (const { name, bytes } of files) {
    const title = new TextEncoder().encode(name), sum = checksum(bytes);
    const common: [2 | 4, number][] = [[2, version], [2, utf8], [2, 0], [2, 0], [2, firstDay], [4, sum], [4, bytes.length], [4, bytes.length], [2, title.length], [2, 0]];
    parts.push(packed([4, 0x04034b50], ...common), title, bytes);
    directory.push(packed([4, 0x02014b50], [2, version], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), title);
    at += 30 + title.length + bytes.length;
  }
  const list = joined(directory);
  const end = packed([4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, list.length], [4, at], [2, 0]);
  return joined([...parts, list, end]);
}
