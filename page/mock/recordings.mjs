// Recordings of the mock: events from formulas, images of ellipses, moduli after a moment.
import { deflateSync } from 'node:zlib';
import { crc32 } from './crc32.mjs';

const pixel_um = 0.34;
const size = { width: 250, height: 80 };

/** Numbers that look random and are the same every time (Park and Miller). */
function random(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

function eventsOf(count, seed, stiffness) {
  const next = random(seed);
  const normal = () => Math.sqrt(-2 * Math.log(next())) * Math.cos(2 * Math.PI * next());
  const names = ['area_um', 'deform', 'area_ratio', 'bright_avg', 'pos_x', 'pos_y', 'time', 'temp', 'constructor'];
  const columns = Object.fromEntries(names.map((name) => [name, new Float64Array(count)]));
  for (let i = 0; i < count; ++i) {
    const large = i % 4 === 0;
    const area = Math.max(12, (large ? 105 : 62) + (large ? 14 : 8) * normal());
    columns.area_um[i] = area;
    columns.deform[i] = Math.abs((0.006 + 0.00042 * (area - 20)) / stiffness + 0.006 * normal());
    columns.area_ratio[i] = 1 + 0.03 * Math.abs(normal());
    columns.bright_avg[i] = 110 + 6 * normal();
    columns.pos_x[i] = 40 + 3 * normal();
    columns.pos_y[i] = 13.6 + 0.3 * normal();
    columns.time[i] = i / 100;
    columns.temp[i] = 23 + 0.2 * normal();
    columns.constructor[i] = i; // a file may call a feature like that
  }
  return columns;
}

const modulusOf = (area, deform) => (deform > 0.004 && area > 30 ? (0.028 * (area / 60)) / (deform + 0.001) : NaN);

function moduliOf({ area_um, deform }) {
  const emodulus = deform.map((value, i) => modulusOf(area_um[i], value));
  const state = emodulus.map((value, i) => (Number.isFinite(value) ? 0 : area_um[i] > 30 ? 4 : 2));
  return { emodulus, state, standard_error: emodulus.map((value) => 0.05 * value) };
}

const conditions = (flow) => ({ channel_width_um: 20, flow_rate_ul_s: flow, medium: 'CellCarrier', temperature_C: 23 });

function recording(item, name, count, seed, stiffness) {
  const columns = eventsOf(count, seed, stiffness);
  const about = { item, kind: 'recording', name, state: 'ready', events: count, conditions: conditions(0.04), condition: '', replicate: '' };
  return { about, columns, computed: null, run: null };
}

/** By a combined table: a bulk of 1 kPa with a cortex of 2 mN/m. */
const combinedOf = (cell) => ({
  table: 'HC-2D-26',
  status: 'resolved',
  sentence: 'E = 1 +- 0.1 kPa, E2D = 2 +- 0.3 mN/m.',
  young_modulus_kPa: 1,
  young_modulus_error_kPa: 0.1,
  cortex_modulus_mN_per_m: 2,
  cortex_modulus_error_mN_per_m: 0.3,
  stiffness_kPa: 1.4,
  stiffness_error_kPa: 0.05,
  contour: ring(cell, (angle) => 1 - 0.005 * Math.cos(3 * angle)),
  case: { channel: { width_um: 20 }, flow: { rate_ul_per_s: 0.04, viscosity_mPas: 5 }, cell: { radius_um: 5, bulk: { young_modulus_kPa: 1 }, cortex: { law: 'neo-hookean', modulus_mN_per_m: 2 } } },
});

export class MockRecordings {
  constructor(largest = 3000) {
    this.items = [
      recording(0, 'control_1.rtdc', 1000, 11, 1),
      recording(1, 'treated_1.rtdc', largest, 29, 1.4),
      { about: { item: 2, kind: 'recording', name: 'broken.rtdc', state: 'failed', error: 'broken.rtdc is no HDF5 file.', condition: '', replicate: '' } },
    ];
  }

  list() {
    return this.items.map(({ about }) => about);
  }

  item(number) {
    const found = this.items[number];
    const names = Object.keys({ ...found.columns, ...found.computed });
    return { ...found.about, features: found.columns ? names : undefined, metadata: {} };
  }

  column(number, feature) {
    const { columns, computed } = this.items[number];
    return computed && Object.hasOwn(computed, feature) ? computed[feature] : columns[feature];
  }

  start(number, settings) {
    this.items[number].run = { begin: Date.now(), settings };
    this.items[number].computed = null;
  }

  moduli(number) {
    const found = this.items[number];
    if (!found.run) return { state: 'none', done: 0, settings: {}, command: `rheocyte extract ${found.about.name}` };
    const done = Math.min(1, (Date.now() - found.run.begin) / 700);
    const command = `rheocyte extract ${found.about.name}`;
    if (done < 1) return { state: 'running', done, command };
    found.computed ??= moduliOf(found.columns);
    const counts = (state) => found.computed.state.filter((value) => value === state).length;
    const summary = { valid: counts(0), too_stiff: counts(4), too_small: counts(2) };
    return { state: 'ready', done: 1, command, summary, lines: ['the medium is shear-thinning (exponent 0.655)'], features: Object.keys(found.computed) };
  }

  stop(number) {
    this.items[number].run = null;
  }

  event(number, event) {
    const { columns, computed } = this.items[number];
    const features = Object.fromEntries(Object.entries({ ...columns, ...computed }).map(([name, values]) => [name, values[event]]));
    const cell = cellOf(features);
    const modulus = modulusOf(features.area_um, features.deform);
    const has = Number.isFinite(modulus);
    const outline = ring(cell, (angle) => 1 + 0.015 * Math.cos(3 * angle) - 0.01);
    return {
      event,
      features,
      young_modulus_kPa: has ? modulus : null,
      standard_error_kPa: has ? 0.05 * modulus : null,
      state: has ? 'valid' : 'too stiff',
      sentence: has ? '' : 'The event is deformed less than the stiffest cell of the table.',
      pixel_um,
      outline,
      model: has ? { ...ring(cell, () => 1), residual_um: residualOf(cell), residual_rms_um: 0.05 } : null,
      combined: has ? combinedOf(cell) : null,
      case: has ? { channel: { width_um: 20 }, flow: { rate_ul_per_s: 0.04, viscosity_mPas: 5 }, cell: { radius_um: 5, bulk: { young_modulus_kPa: modulus } } } : null,
    };
  }

  lines(x, y) {
    if (x !== 'area_um' || y !== 'deform') return { lines: [], range: null, table: null, sentence: 'There are isoelasticity lines over area_um and deform only.' };
    const areas = Array.from({ length: 60 }, (_, k) => 20 + 2.5 * k);
    const lines = [0.4, 0.6, 0.9, 1.5, 2.5, 4].map((young_modulus_kPa) => ({
      young_modulus_kPa,
      x: areas,
      y: areas.map((area) => (0.028 * area) / 60 / young_modulus_kPa),
    }));
    const range = { x: [20, 170, 170, 20], y: [0.001, 0.01, 0.2, 0.03] };
    return { lines, range, table: 'LE-2D-MC049-26', sentence: '' };
  }

  picture(number, event, kind) {
    return kind === 'image' || kind === 'mask' ? pictureOf(cellOf(this.event(number, event).features), kind) : null;
  }
}

const cellOf = ({ area_um, deform, pos_x, pos_y }) => {
  const radius = Math.sqrt(area_um / Math.PI);
  const stretch = 1 + 3 * Math.sqrt(deform) * 0.6;
  return { a: radius * Math.sqrt(stretch), b: radius / Math.sqrt(stretch), x: pos_x, y: pos_y };
};

const angles = Array.from({ length: 90 }, (_, k) => (k * Math.PI) / 45);
const ring = ({ a, b, x, y }, factor) => ({
  x_um: angles.map((angle) => x + a * factor(angle) * Math.cos(angle)),
  y_um: angles.map((angle) => y + b * factor(angle) * Math.sin(angle)),
});
const residualOf = ({ a, b }) => angles.map((angle) => Math.sqrt(a * b) * 0.015 * Math.cos(3 * angle));

function pictureOf({ a, b, x, y }, kind) {
  const next = random(5);
  const rows = Buffer.alloc((size.width + 1) * size.height);
  for (let row = 0; row < size.height; ++row)
    for (let column = 0; column < size.width; ++column) {
      const distance = Math.hypot(((column + 0.5) * pixel_um - x) / a, ((row + 0.5) * pixel_um - y) / b);
      const rim = 60 * Math.exp(-(((distance - 1) / 0.07) ** 2));
      const grey = kind === 'mask' ? (distance <= 1 ? 255 : 0) : 128 - rim + (distance < 1 ? 12 : 0) + 8 * (next() - 0.5);
      rows[row * (size.width + 1) + 1 + column] = grey;
    }
  return png(rows);
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type), data]);
  const out = Buffer.alloc(8 + body.length);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc32(body), 4 + body.length);
  return out;
}

function png(rows) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(size.width, 0);
  head.writeUInt32BE(size.height, 4);
  head[8] = 8; // bits of a grey pixel
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  return Buffer.concat([signature, chunk('IHDR', head), chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}
