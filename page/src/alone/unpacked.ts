// What single.mjs packs: gzip as base64.

export async function unpacked(packed: string): Promise<Uint8Array<ArrayBuffer>> {
  const letters = atob(packed);
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The bytes of every fourth place stood together. */
export async function unpackedTable(packed: string): Promise<Uint8Array<ArrayBuffer>> {
  const planes = await unpacked(packed);
  const bytes = new Uint8Array(planes.length);
  let from = 0;
  for (let plane = 0; plane < 4; ++plane) for (let at = plane; at < bytes.length; at += 4) bytes[at] = planes[from++];
  return bytes;
}

export const unpackedText = async (packed: string) => new TextDecoder().decode(await unpacked(packed));
