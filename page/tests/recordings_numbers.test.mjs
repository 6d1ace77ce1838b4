import assert from 'node:assert/strict';
import { test } from 'node:test';
import { loadModule } from './load_module.mjs';

const { describe, medianInterval, meanInterval, quantiles, studentPoint } = await loadModule('recordings/statistics.ts');
const { ticksOf, counted, zoomed, spanOf } = await loadModule('recordings/scale.ts');
const { applyGates, gateOptions, gateSettings, gatesWithoutOption, SlabbedPolygon } = await loadModule('recordings/gates.ts');
const { Density, densityCells, levelsEnclosing } = await loadModule('recordings/density.ts');
const { fitOf, inOrderOfConditions, sessionsOf } = await loadModule('recordings/population_fits.ts');
const { isolines } = await loadModule('recordings/isolines.ts');
const { placesOf } = await loadModule('recordings/places.ts');
const { PixelCounts, nearestEvent, paint, colourByMean } = await loadModule('recordings/points.ts');
const { alongAngles, centroid } = await loadModule('recordings/residual.ts');

/** Numbers that look random and are the same every time (Park and Miller). */
function numbers(count, seed = 7) {
  let state = seed;
  return Float64Array.from({ length: count }, () => (state = (state * 48271) % 2147483647) / 2147483647);
}
const normal = (count, seed) => {
  const [a, b] = [numbers(count, seed), numbers(count, seed + 1)];
  return a.map((value, i) => Math.sqrt(-2 * Math.log(value)) * Math.cos(2 * Math.PI * b[i]));
};

test('quantiles are those of the sorted values, linear between two of them', () => {
  const values = numbers(1001);
  const sorted = values.slice().sort();
  assert.deepEqual(quantiles(values.slice(), [0, 0.25, 0.5, 1]), [sorted[0], sorted[250], sorted[500], sorted[1000]]);
  assert.deepEqual(quantiles(Float64Array.of(4, 1, 3, 2), [0.25, 0.5, 0.75]), [1.75, 2.5, 3.25]);
});

test('single outliers do not change which values are the quantiles', () => {
  const values = numbers(1001).map((value, i) => (i === 500 ? 1e9 : i === 700 ? -1e12 : value));
  const sorted = values.slice().sort();
  assert.deepEqual(quantiles(values, [0, 0.25, 0.5, 0.75, 1]), [0, 250, 500, 750, 1000].map((k) => sorted[k]));
});

test('equal values and few values have quantiles as well', () => {
  assert.deepEqual(quantiles(new Float64Array(50).fill(3), [0.25, 0.5]), [3, 3]);
  assert.deepEqual(quantiles(Float64Array.of(5), [0.25, 0.75]), [5, 5]);
  assert.ok(Number.isNaN(quantiles(new Float64Array(0), [0.5])[0]));
});

test('statistics leave out what is no number and what lies outside the mask', () => {
  const found = describe([1, NaN, 3, 100, 5], Uint8Array.of(1, 1, 1, 0, 1));
  assert.equal(found.count, 3);
  assert.equal(found.mean, 3);
  assert.equal(found.standardDeviation, 2);
  assert.equal(found.median, 3);
  assert.ok(Math.abs(found.standardError - 2 / Math.sqrt(3)) < 1e-15); // rounding
});

test('no events have a count of zero and no other number', () => {
  const found = describe([], null);
  assert.equal(found.count, 0);
  assert.ok([found.mean, found.median, found.standardDeviation, found.standardError].every(Number.isNaN));
});

test('the 95 % interval of the median holds the true median in about 95 of 100 samples', () => {
  let held = 0;
  for (let k = 0; k < 400; ++k) {
    const { low, high } = medianInterval(numbers(101, 1000 + 37 * k));
    if (low <= 0.5 && 0.5 <= high) ++held;
  }
  assert.ok(held > 400 * 0.92 && held < 400 * 0.985, `${held} of 400`); // three standard deviations of a count at 95 %
});

test("the interval of replicates is Student's", () => {
  const { value, low, high } = meanInterval([1, 2, 3]);
  assert.equal(value, 2);
  assert.ok(Math.abs(high - 2 - 4.303 / Math.sqrt(3)) < 1e-12 && Math.abs(low + high - 4) < 1e-12);
  assert.ok(Number.isNaN(meanInterval([1]).low));
  assert.ok(Math.abs(studentPoint(60) - 2.0) < 2e-3); // tables: 2.000
});

test('ticks are evenly spaced within the axis, and their labels are their places', () => {
  for (const [low, high] of [[0, 200], [-0.02, 0.11], [0, 1], [1e-6, 9e-6], [-3e7, 2e7]]) {
    const ticks = ticksOf('linear', { low, high }, 5);
    assert.ok(ticks.length >= 2 && ticks.length <= 11, `${ticks.length} from ${low} to ${high}`);
    const step = ticks[1].place - ticks[0].place;
    ticks.forEach(({ place, label }, k) => {
      assert.ok(place >= low - 1e-9 * step && place <= high + 1e-9 * step);
      assert.ok(Math.abs(place - ticks[0].place - k * step) < 1e-9 * (high - low)); // rounding
      assert.ok(Math.abs(Number(label.replace('\u2212', '-')) - place) < 1e-3 * step, `${label} at ${place}`);
    });
  }
});

test('a logarithmic axis has decades, and plain numbers where it is short', () => {
  const decades = ticksOf('log', { low: -1, high: 3 }, 6).filter((tick) => tick.label);
  assert.deepEqual(decades.map((tick) => tick.label), ['0.1', '1', '10', '100', '1000']);
  const short = ticksOf('log', { low: Math.log10(2), high: Math.log10(5) }, 4);
  assert.deepEqual(short.map((tick) => tick.label), ['2', '3', '4', '5']);
});

test('counts are written in groups of three', () => {
  assert.equal(counted(1234567), '1\u202f234\u202f567');
  assert.equal(counted(999), '999');
});

test('zooming leaves the place under the pointer where it is', () => {
  const { low, high } = zoomed({ low: 0, high: 10 }, 2, 4);
  assert.deepEqual([low, high], [2, 7]);
});

test('an axis is not squeezed by single outliers', () => {
  const values = numbers(10000);
  values[0] = 1e6;
  assert.ok(spanOf(values.sort()).high < 1.2);
});

test('a range gate holds its ends and no event without a number', () => {
  const gate = { kind: 'range', id: 1, on: true, feature: 'area_um', low: 2, high: 3 };
  const inside = applyGates([gate], 5, () => [1, 2, 3, 4, NaN]);
  assert.deepEqual([...inside], [0, 1, 1, 0, 0]);
  assert.equal(applyGates([{ ...gate, on: false }], 5, () => [1, 2, 3, 4, NaN]), null);
});

test('a polygon gate agrees with winding numbers at random places', () => {
  const star = Array.from({ length: 14 }, (_, k) => {
    const radius = k % 2 ? 0.2 : 0.5;
    return [0.5 + radius * Math.cos((Math.PI * k) / 7), 0.5 + radius * Math.sin((Math.PI * k) / 7)];
  });
  const polygon = new SlabbedPolygon(star);
  const winds = (x, y) => {
    const turn = star.reduce((sum, [ax, ay], k) => {
      const [bx, by] = star[(k + 1) % star.length];
      return sum + Math.atan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y));
    }, 0);
    return Math.abs(turn) > Math.PI;
  };
  const [xs, ys] = [numbers(5000, 3), numbers(5000, 5)];
  for (let i = 0; i < xs.length; ++i) assert.equal(polygon.holds(xs[i], ys[i]), winds(xs[i], ys[i]));
});

test('a polygon that was drawn on logarithmic axes has edges that are straight there', () => {
  const gate = { kind: 'polygon', id: 1, on: true, x: 'a', y: 'b', xScale: 'log', yScale: 'log', points: [[1, 1], [100, 100], [100, 1]] };
  const columns = { a: [10, 10], b: [9, 11] };
  assert.deepEqual([...applyGates([gate], 2, (name) => columns[name])], [1, 0]);
});

test('a polygon gate is an option of the command line', () => {
  const gate = { kind: 'polygon', id: 1, on: true, x: 'area_um', y: 'deform', xScale: 'log', yScale: 'linear', points: [[40, 0.01], [90, 0.01], [90.5, 1e-7]] };
  assert.equal(gateOptions([gate]), '--polygon log:area_um,deform=40,0.01:90,0.01:90.5,1e-7');
});

test('several gates count together; a feature that is missing excludes all events', () => {
  const low = { kind: 'range', id: 1, on: true, feature: 'a', low: 2, high: null };
  const high = { kind: 'range', id: 2, on: true, feature: 'a', low: null, high: 4 };
  assert.deepEqual([...applyGates([low, high], 5, () => [1, 2, 3, 4, 5])], [0, 1, 1, 1, 0]);
  assert.deepEqual([...applyGates([low], 2, () => undefined)], [0, 0]);
  assert.equal(gateOptions([low, { ...high, on: false }]), '--min a=2');
  assert.equal(gateOptions([{ ...low, feature: 'emodulus_stored' }]), '--min emodulus=2'); // its name in the file
});

test('a gate on a computed modulus is no option of the command that computes it', () => {
  const area = { kind: 'range', id: 1, on: true, feature: 'area_um', low: 40, high: null };
  const modulus = { kind: 'range', id: 2, on: true, feature: 'emodulus', low: 2, high: null };
  const polygon = { kind: 'polygon', id: 3, on: true, x: 'area_um', y: 'emodulus', xScale: 'log', yScale: 'linear', points: [[40, 1], [90, 1], [90, 5]] };
  assert.equal(gateOptions([area, modulus, polygon]), '--min area_um=40');
  assert.deepEqual(gatesWithoutOption([area, modulus, { ...polygon, on: false }]), [modulus]);
});

test('the contours enclose the fractions of the events that they state', () => {
  const [xs, ys] = [normal(40000, 11), normal(40000, 23)];
  const density = new Density(placesOf(xs, ys, 'linear', 'linear'), null, { low: -5, high: 5 }, { low: -5, high: 5 });
  for (const fraction of [0.5, 0.95]) {
    const [level] = levelsEnclosing(density, [fraction]);
    let within = 0;
    for (let i = 0; i < xs.length; ++i) if (density.at(xs[i], ys[i]) >= level) ++within;
    assert.ok(Math.abs(within / xs.length - fraction) < 0.02, `${within / xs.length}`); // smoothing widens by less
  }
});

test('the level lines of a round hill are circles and closed', () => {
  const n = 101;
  const hill = Float64Array.from({ length: n * n }, (_, k) => -Math.hypot((k % n) - 50, Math.floor(k / n) - 50));
  const lines = isolines(hill, n, n, -30);
  assert.equal(lines.length, 1);
  assert.deepEqual(lines[0][0], lines[0].at(-1));
  for (const [x, y] of lines[0]) assert.ok(Math.abs(Math.hypot(x - 50, y - 50) - 30) < 0.02); // chords of a cell
  assert.equal(isolines(hill, n, n, -60).length, 4); // four arcs that end at the rim
});

test('two hills have two lines, a valley between them does not join them', () => {
  const n = 64;
  const hills = Float64Array.from({ length: n * n }, (_, k) => {
    const [x, y] = [k % n, Math.floor(k / n)];
    return Math.exp(-((x - 16) ** 2 + (y - 32) ** 2) / 30) + Math.exp(-((x - 48) ** 2 + (y - 32) ** 2) / 30);
  });
  assert.equal(isolines(hills, n, n, 0.5).length, 2);
});

test('every event in view is counted into its pixel, others into none', () => {
  const xs = Float64Array.of(0.1, 0.1, 0.9, 2, NaN);
  const ys = Float64Array.of(0.1, 0.1, 0.9, 0.5, 0.5);
  const view = { x: { low: 0, high: 1 }, y: { low: 0, high: 1 }, width: 10, height: 10 };
  const counts = new PixelCounts();
  const places = placesOf(xs, ys, 'linear', 'linear');
  counts.count(places, Uint8Array.of(1, 0, 1, 1, 1), view);
  assert.equal(counts.seen, 3);
  assert.equal(counts.inside.reduce((a, b) => a + b, 0), 2);
  assert.equal(counts.outside.reduce((a, b) => a + b, 0), 1);
  assert.equal(nearestEvent(places, null, view, 9, 1, 2), 2);
  assert.equal(nearestEvent(places, null, view, 5, 5, 2), -1);
});

test('a pixel has the colour of the mean of its events', () => {
  const view = { x: { low: 0, high: 1 }, y: { low: 0, high: 1 }, width: 1, height: 1 };
  const places = placesOf([0.5, 0.5], [0.5, 0.5], 'linear', 'linear');
  const counts = new PixelCounts();
  counts.count(places, null, view);
  counts.sum(places, null, view, [0, 1]);
  const table = Uint32Array.from({ length: 256 }, (_, k) => k);
  const out = new Uint32Array(1);
  paint(out, counts, view, { muted: 0, radius: 0 }, colourByMean(counts, { low: 0, high: 1 }, table, 7));
  assert.equal(out[0], 128);
});

test('residuals go around the outline by their angle, upwards in the image being positive', () => {
  const outline = { x_um: [4, 3, 2, 3], y_um: [4, 3, 4, 5] }; // right, above, left, below
  assert.deepEqual(centroid(outline), [3, 4]);
  const { angle_deg, distance_um } = alongAngles(outline, [1, 2, 3, 4]);
  assert.deepEqual(angle_deg, [-90, 0, 90, 180]);
  assert.deepEqual(distance_um, [4, 1, 2, 3]);
});

test('gates are the same as settings and as options', () => {
  const gates = [
    { kind: 'range', id: 1, on: true, feature: 'area_um', low: 40, high: null },
    { kind: 'range', id: 2, on: true, feature: 'area_ratio', low: null, high: 1.05 },
    { kind: 'range', id: 3, on: false, feature: 'deform', low: 0, high: 1 },
    { kind: 'polygon', id: 5, on: true, x: 'area_um', y: 'deform', xScale: 'log', yScale: 'linear', points: [[40, 0], [90, 0], [90, 0.1]] },
  ];
  const settings = gateSettings(gates);
  assert.deepEqual(settings, { min: ['area_um=40'], max: ['area_ratio=1.05'], polygon: ['log:area_um,deform=40,0:90,0:90,0.1'] });
  const options = Object.entries(settings).flatMap(([name, texts]) => texts.map((text) => `--${name} ${text}`));
  assert.equal(gateOptions(gates), options.join(' '));
});

test('conditions are those of the list, their recordings in the order of the replicates', () => {
  const item = (number, condition, replicate, state = 'ready') => ({ item: number, condition, replicate, state });
  const list = [item(0, 'drug', '10'), item(1, 'control', '2'), item(2, 'drug', '9'), item(3, 'control', '1'), item(4, '', '1'), item(5, 'drug', '8', 'failed')];
  assert.deepEqual(sessionsOf(list), [
    { name: 'drug', items: [2, 0] },
    { name: 'control', items: [3, 1] },
  ]);
});

test('recordings stand in the order of their conditions, and those without a condition last', () => {
  const item = (number, condition) => ({ item: number, condition, replicate: '', state: 'ready' });
  const list = [item(0, ''), item(1, 'drug'), item(2, 'control'), item(3, 'drug')];
  assert.deepEqual(inOrderOfConditions(list).map(({ item: number }) => number), [1, 3, 2, 0]);
});

test('fitted medians belong to the recordings and conditions that were fitted, by the name of the number of the events', () => {
  const name = 'young_modulus_median_kPa';
  const row = (value) => ({ [name]: value, [`${name}_low`]: value && 0.9 * value, [`${name}_high`]: value && 1.1 * value });
  const recording = (condition, session, value) => ({ recording: `${condition}${session}`, condition, session, checks: [], ...row(value) });
  const record = {
    model: 'solid',
    quantities: [{ quantity: 'young_modulus', median: name, symbol: 'E', unit: 'kPa' }],
    conditions: [{ condition: 'a', ...row(2) }, { condition: 'b', ...row(4) }],
    comparisons: [],
    recordings: [recording('a', 1, 2), recording('a', 2, 2.2), recording('b', 1, 4), recording('b', 2, null)],
  };
  const fitted = [{ name: 'a', items: [7, 3] }, { name: 'b', items: [0, 1] }];
  const { medians, means } = fitOf(record, fitted, 'emodulus');
  assert.deepEqual([...medians].map(([item, { median }]) => [item, median.value]), [[7, 2], [3, 2.2], [0, 4]]);
  assert.deepEqual([...means].map(([condition, { value }]) => [condition, value]), [['a', 2], ['b', 4]]);
  assert.equal(fitOf(record, fitted, 'area_um'), undefined);
  assert.equal(fitOf({ ...record, model: 'cortex' }, fitted, 'emodulus'), undefined, "the bulk's modulus is another number");
  assert.equal(fitOf({ ...record, model: 'cortex' }, fitted, 'young_modulus_with_cortex_kPa').medians.size, 3);
});
