// Short names of recordings that stand side by side.

/** Without their ending and without the words that all of them begin with: they differ where there is little room. */
export function distinctNames(titles: string[]): string[] {
  const names = titles.map((title) => title.replace(/\.(rtdc|csv|tsv|txt)$/, ''));
  if (new Set(names).size < 2) return names;
  let shared = 0;
  while (names.every((name) => name[shared] === names[0][shared])) ++shared;
  const start = Math.max(...['_', '-', '.', ' ', '/'].map((sign) => names[0].lastIndexOf(sign, shared - 1)), -1) + 1;
  return shared === 0 ? names : names.map((name) => name.slice(start));
}
