// A plot as a picture: the points as they stand on the canvas, all else as lines, in the colours of the theme.
const copied = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'font-family', 'font-size', 'font-weight', 'opacity', 'paint-order'];

function withStyles(source: SVGElement): SVGElement {
  const copy = source.cloneNode(true) as SVGElement;
  const from = [source, ...source.querySelectorAll<SVGElement>('*')];
  const to = [copy, ...copy.querySelectorAll<SVGElement>('*')];
  from.forEach((element, k) => {
    const style = window.getComputedStyle(element);
    for (const name of copied) to[k].setAttribute(name, style.getPropertyValue(name));
    to[k].removeAttribute('class');
  });
  return copy;
}

/** The text of an SVG file of a plot. */
export function svgOf(frame: HTMLElement): string {
  const svg = frame.querySelector('svg')!;
  const canvas = frame.querySelector('canvas')!;
  const copy = withStyles(svg);
  for (const name of ['tabindex', 'role']) copy.removeAttribute(name);
  copy.querySelector('.crosshair')?.remove();
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  const ground = window.getComputedStyle(document.body).backgroundColor;
  const { left, top, width, height } = canvas.style;
  const place = `x="${parseFloat(left)}" y="${parseFloat(top)}" width="${parseFloat(width)}" height="${parseFloat(height)}"`;
  const behind = `<rect width="100%" height="100%" fill="${ground}"/><image ${place} href="${canvas.toDataURL('image/png')}"/>`;
  return new XMLSerializer().serializeToString(copy).replace(/(<svg[^>]*>)/, `$1${behind}`);
}

/** Twice the size on the screen. */
export async function pngOf(frame: HTMLElement): Promise<string> {
  const image = new Image();
  const text = svgOf(frame);
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = 2 * frame.clientWidth;
  canvas.height = 2 * frame.clientHeight;
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL('image/png').replace(/^data:[^,]*,/, '');
}

/** Base64 of a text in UTF-8. */
export function base64(text: string): string {
  let bytes = '';
  for (const byte of new TextEncoder().encode(text)) bytes += String.fromCharCode(byte);
  return btoa(bytes);
}
