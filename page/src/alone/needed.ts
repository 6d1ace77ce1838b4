// What the page without a server needs of its browser.

export const cannotRun = (reason: string) =>
  `The program cannot run in this browser (${reason}); it needs WebAssembly with SIMD and exceptions: Chrome or Edge 95, Firefox 113, Safari 16.4, or newer.`;
