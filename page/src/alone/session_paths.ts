// A session names files by their paths on the computer, or in the page, where it was saved.

const opening = '# A session of rheocyte view';
/** JSON within TOML's literal text: ASCII without apostrophes. */
const paths = /"(path|table)":\s*("(?:[^"\\]|\\.)*")/g;

export const isSession = (text: string) => text.startsWith(opening);

const escaped = (text: string) =>
  JSON.stringify(text).replace(/[^ -&(-~]/g, (letter) => `\\u${letter.charCodeAt(0).toString(16).padStart(4, '0')}`);

/** The session with the paths of `places` in place of those whose files have the same names. */
export function withPaths(session: string, places: Map<string, string>): string {
  return session.replace(paths, (all, key: string, text: string) => {
    const place = places.get((JSON.parse(text) as string).split('/').pop()!);
    return place === undefined ? all : `"${key}": ${escaped(place)}`;
  });
}
