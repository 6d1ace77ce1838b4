/** What the files of a folder export as default (bundling.mjs). */
declare module 'every:./tabs' {
  const tabs: import('./recordings/tab').Tab[];
  export default tabs;
}
