// The maps of the pictures: straight lines at constant speed in CIELAB, so that equal steps look equal to everyone.

type Triple = [number, number, number];

const white: Triple = [0.95047, 1, 1.08883];
const toXyz: Triple[] = [
  [0.4124564, 0.3575761, 0.1804375],
  [0.2126729, 0.7151522, 0.072175],
  [0.0193339, 0.119192, 0.9503041],
];
const fromXyz: Triple[] = [
  [3.2404542, -1.5371385, -0.4985314],
  [-0.969266, 1.8760108, 0.041556],
  [0.0556434, -0.2040259, 1.0572252],
];

const times = (matrix: Triple[], v: Triple) => matrix.map((row) => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) as Triple;

function toLab(hex: string): Triple {
  const linear = [1, 3, 5].map((at) => {
    const c = parseInt(hex.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  }) as Triple;
  const f = times(toXyz, linear).map((c, k) => {
    const ratio = c / white[k];
    return ratio > 0.008856 ? Math.cbrt(ratio) : 7.787 * ratio + 16 / 116;
  });
  return [116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])];
}

function fromLab(lab: Triple): Triple {
  const fy = (lab[0] + 16) / 116;
  const xyz = [fy + lab[1] / 500, fy, fy - lab[2] / 200].map(
    (f, k) => white[k] * (f > 0.206893 ? f ** 3 : (f - 16 / 116) / 7.787),
  ) as Triple;
  return times(fromXyz, xyz).map((c) => {
    const linear = Math.min(1, Math.max(0, c));
    return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
  }) as Triple;
}

const length = (a: Triple, b: Triple) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

function labAt(anchors: Triple[], places: number[], at: number): Triple {
  let k = 0;
  while (k < anchors.length - 2 && places[k + 1] < at) ++k;
  const fraction = (at - places[k]) / (places[k + 1] - places[k]);
  return anchors[k].map((c, d) => c + fraction * (anchors[k + 1][d] - c)) as Triple;
}

export interface ColorMap {
  /** 256 colours, as the bytes of a pixel (little endian: alpha, blue, green, red). */
  pixels: Uint32Array;
  css: string[];
}

function evenMap(...colours: string[]): ColorMap {
  const anchors = colours.map(toLab);
  const places = [0];
  for (let k = 1; k < anchors.length; ++k) places.push(places[k - 1] + length(anchors[k - 1], anchors[k]));
  const pixels = new Uint32Array(256);
  const css: string[] = [];
  for (let k = 0; k < 256; ++k) {
    const [r, g, b] = fromLab(labAt(anchors, places, (k / 255) * places[places.length - 1]));
    pixels[k] = ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
    css.push(`rgb(${r} ${g} ${b})`);
  }
  return { pixels, css };
}

export const liquidMap = evenMap('#f3f8fb', '#9cc7df', '#3f82b5', '#12406f');
export const cellMap = evenMap('#fff6df', '#fbc873', '#e5703a', '#9c1f3a');
export const tensionMap = evenMap('#e9f5ee', '#8cc9a1', '#2f8f6b', '#0b4a3f');
export const densityMap = evenMap('#440154', '#3b528b', '#21918c', '#5ec962', '#fde725');

/** Place of a value in a map: 0..255. */
export const shade = (value: number, low: number, high: number) =>
  Math.max(0, Math.min(255, Math.round((255 * (value - low)) / (high - low || 1))));
