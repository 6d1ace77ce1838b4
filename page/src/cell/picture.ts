// The picture as a file: one SVG with the colours embedded, legends and numbers below; PNG is drawn from it.
import { unitText, tickLabels, ticks } from '../draw/numbers';
import { token } from '../shell/theme';
import type { Legend } from './looks';
import type { Solved } from './model';

const foot = 96;
const escaped = (text: string) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;');

function legendSvg({ field, map, low, high }: Legend, x: number, y: number): string {
  const width = 240;
  const values = ticks(field.factor * low, field.factor * high, 5);
  const labels = tickLabels(values);
  const place = (value: number) => (width * (value / field.factor - low)) / (high - low || 1);
  const pieces = Array.from({ length: 64 }, (_, k) => {
    const colour = map.css[Math.round((k / 63) * 255)];
    return `<rect x="${(k * width) / 64}" y="8" width="${width / 64 + 0.5}" height="10" fill="${colour}"/>`;
  });
  const marks = values.map((value, k) => `<text x="${place(value).toFixed(1)}" y="32" text-anchor="middle">${labels[k]}</text>`);
  const title = field.unit ? `${field.title} (${unitText(field.unit)})` : field.title;
  return `<g transform="translate(${x} ${y})"><text y="0">${escaped(title)}</text>${pieces.join('')}${marks.join('')}</g>`;
}

function numbersText({ state }: Solved): string {
  const stated = state.errors.deformation;
  const error = stated ? ` ± ${stated.toExponential(0)}` : '';
  return `deformation ${state.deformation.toFixed(6)}${error}   area ${state.area_um2.toFixed(2)} µm²   velocity ${state.cell_velocity_m_per_s.toPrecision(4)} m/s   pressure drop ${state.pressure_drop_Pa.toPrecision(4)} Pa`;
}

/** The drawn picture (canvas and lines of the page) as a text of SVG. */
export function pictureSvg(legends: (Legend | null)[], solved: Solved): { svg: string; width: number; height: number } {
  const lines = document.querySelector<SVGSVGElement>('.channel svg.lines');
  const canvas = document.querySelector<HTMLCanvasElement>('.channel canvas');
  if (!lines || !canvas) throw new Error('There is no picture of the channel to save; show the channel, not the 3D shape.');
  const [width, height] = [lines.width.baseVal.value, lines.height.baseVal.value];
  const drawn = legends.filter((legend): legend is Legend => legend !== null);
  const bars = drawn.map((legend, k) => legendSvg(legend, 20 + k * 300, height + 24));
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height + foot}" viewBox="0 0 ${width} ${height + foot}" font-family="system-ui, sans-serif" font-size="12" fill="${token('--ink')}">
<rect width="100%" height="100%" fill="${token('--ground')}"/>
<image href="${canvas.toDataURL('image/png')}" width="${width}" height="${height}"/>
<svg width="${width}" height="${height}" fill="none">${lines.innerHTML}</svg>
${bars.join('\n')}
<text x="20" y="${height + foot - 10}" xml:space="preserve">${escaped(numbersText(solved))}</text>
</svg>
`;
  return { svg, width, height: height + foot };
}

export async function picturePng(picture: { svg: string; width: number; height: number }): Promise<Blob> {
  const address = URL.createObjectURL(new Blob([picture.svg], { type: 'image/svg+xml' }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = 2 * picture.width;
    canvas.height = 2 * picture.height;
    canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, fail) => canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error('The picture could not be drawn.')))));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** Bytes as base64, in pieces that a call's arguments can hold. */
export async function base64(blob: Blob): Promise<string> {
  const bytes = new Uint8Array(await blob.arrayBuffer());
  let text = '';
  for (let k = 0; k < bytes.length; k += 8192) text += String.fromCharCode(...bytes.subarray(k, k + 8192));
  return window.btoa(text);
}
