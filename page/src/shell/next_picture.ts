/** Done after the next picture of the page; where none is drawn because the page is hidden, after a moment. */
export const nextPicture = () =>
  new Promise<void>((drawn) => {
    window.requestAnimationFrame(() => window.setTimeout(drawn));
    window.setTimeout(drawn, 100);
  });
