// What single.mjs packs: gzip, of whose bytes 13 bits each are two of 91 letters.

import type { PackedTable } from './messages';

const first = 33, count = 91;
/** The values of letters by their codes: printable ones without < " and \. */
const values = new Int8Array(128);
for (let code = first, value = 0; code < 127; ++code) if (!'<"\\'.includes(String.fromCharCode(code))) values[code] = value++;

function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  const isOdd = text.length % 2;
  const bytes = new Uint8Array(Math.floor((13 * ((text.length - isOdd) / 2) + 6 * isOdd) / 8));
  let held = 0, bits = 0, at = 0;
  for (let k = 0; k < text.length; k += 2) {
    const isPair = k + 1 < text.length;
    held |= (values[text.charCodeAt(k)] + (isPair ? count * values[text.charCodeAt(k + 1)] : 0)) << bits;
    bits += isPair ? 13 : 6;
    for (; bits >= 8; bits -= 8, held >>= 8) bytes[at++] = held & 255;
  }
  return bytes;
}

export async function unpacked(packed: string): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytesOf(packed)]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Of numbers of this size the first bytes stand together, the second ones, and so on. */
export async function unpackedTable({ content, size }: PackedTable): Promise<Uint8Array<ArrayBuffer>> {
  const planes = await unpacked(content);
  const bytes = new Uint8Array(planes.length);
  let from = 0;
  for (let plane = 0; plane < size; ++plane) for (let at = plane; at < bytes.length; at += size) bytes[at] = planes[from++];
  return bytes;
}

export const unpackedText = async (packed: string) => new TextDecoder().decode(await unpacked(packed));
