import assert from 'node:assert/strict';
import { test } from 'node:test';
import { loadModule } from './load_module.mjs';

const { isComputed, labelOf, nameOf, takeFeatures, unitOf } = await loadModule('recordings/features.ts');
const { countedStates, stateLegend } = await loadModule('recordings/states.ts');
const { placeLabels } = await loadModule('draw/line_labels.ts');
const { distinctNames } = await loadModule('recordings/names.ts');
const { originOf, replacedTemperatures } = await loadModule('recordings/origin.ts');

test('features may be called as what every object of the language has', () => {
  for (const feature of ['constructor', 'toString', '__proto__', 'hasOwnProperty', 'valueOf']) {
    assert.equal(typeof nameOf(feature), 'string');
    assert.equal(unitOf(feature), '');
    assert.equal(labelOf(feature), nameOf(feature));
  }
  assert.equal(labelOf('area_um'), 'Area (µm²)');
});

test('features that the program computes have its labels', () => {
  assert.equal(labelOf('elongation_error'), 'Elongation error');
  assert.equal(isComputed('elongation_error'), false);
  takeFeatures([{ name: 'elongation_error', label: 'Standard error of the elongation', unit: '' }, { name: 'axial_tension', label: 'Axial tension', unit: 'Pa' }]);
  assert.equal(labelOf('elongation_error'), 'Standard error of the elongation');
  assert.equal(labelOf('axial_tension'), 'Axial tension (Pa)');
  assert.equal(isComputed('elongation_error') && !isComputed('area_um'), true);
});

const states = [
  { number: 0, name: 'valid', has_modulus: true, sentence: '' },
  { number: 7, name: 'unresolved', has_modulus: false, sentence: 'The standard error is too great.' },
  { number: 8, name: 'regularised', has_modulus: true, sentence: 'Held smooth.' },
];

test('the numbers of states are told with their meaning, as far as they occur', () => {
  assert.equal(stateLegend(states, [0, 0, 7]), 'State: 0 valid; 7 unresolved: The standard error is too great');
  assert.equal(stateLegend(states, []), '');
});

test('states that have a modulus are listed first, and none that no event has', () => {
  const listed = (counts) => countedStates(states, counts).map(([{ name }, count]) => [name, count]);
  assert.deepEqual(listed({ regularised: 2, unresolved: 1, valid: 3 }), [['valid', 3], ['regularised', 2], ['unresolved', 1]]);
  assert.deepEqual(listed({ unresolved: 0 }), []);
});

test('no label of a line lies on another one, on what is taken, or beyond the frame', () => {
  const frame = { left: 60, right: 400, top: 10, bottom: 300 };
  const taken = [{ left: 250, top: 10, right: 400, bottom: 60 }];
  const texts = ['0.42', '0.55', '0.7', '1', '1.5', '12'];
  const lines = texts.map((text, k) => ({ text, points: Array.from({ length: 60 }, (_, i) => [20 + 7 * i, 40 + 6 * k - 0.2 * i]) }));
  const labels = placeLabels(lines, frame, taken);
  const placed = labels.filter((box) => box !== null);
  assert.ok(placed.length >= 4, `${placed.length} labels`);
  for (const box of placed) {
    assert.ok(box.left >= frame.left && box.right <= frame.right && box.top >= frame.top && box.bottom <= frame.bottom);
    for (const other of [...placed, ...taken])
      assert.ok(box === other || box.left >= other.right || other.left >= box.right || box.top >= other.bottom || other.top >= box.bottom);
  }
});

test('a line without room has no label', () => {
  assert.deepEqual(placeLabels([{ text: '1', points: [[5, 5]] }, { text: '2', points: [] }], { left: 0, right: 10, top: 0, bottom: 10 }, []), [null, null]);
});

test('names that begin alike differ in what is shown of them', () => {
  assert.deepEqual(distinctNames(['2026-03-01_M001_a.rtdc', '2026-03-01_M002_b.rtdc']), ['M001_a', 'M002_b']);
  assert.deepEqual(distinctNames(['control_1.rtdc', 'control_12.rtdc']), ['1', '12']);
  assert.deepEqual(distinctNames(['a.rtdc', 'b.rtdc']), ['a', 'b']);
  assert.deepEqual(distinctNames(['a.csv', 'b.tsv', 'c.rtdc']), ['a', 'b', 'c']);
  assert.deepEqual(distinctNames(['a.rtdc', 'a.rtdc']), ['a', 'a']);
  assert.deepEqual(distinctNames([]), []);
});

const recording = (item, features, conditions = {}, metadata = {}) => ({ item, features, conditions, metadata });

test('a typed temperature says how many recordings lose their own', () => {
  const own = recording(0, ['area_um'], { temperature_C: 25 });
  const ofEvents = recording(1, ['area_um', 'temp'], { temperature_C: null });
  const none = recording(2, ['area_um'], { temperature_C: null });
  assert.match(replacedTemperatures('23', [own, ofEvents, none]), /^Replaces the recorded temperature of 2 of 3 recordings;/);
  assert.match(replacedTemperatures('23,5', [own]), /^Replaces the recorded temperature \(25 °C\);/);
  assert.equal(replacedTemperatures('23', [none]), '');
  assert.equal(replacedTemperatures('', [own]), '');
  assert.equal(replacedTemperatures('feature', [own]), '');
});

test('moduli say where they come from, and stored ones never pass for computed ones', () => {
  const stored = recording(0, ['emodulus_stored'], {}, { 'calculation:emodulus lut': 'LE-2D-FEM-19' });
  const companion = recording(1, ['emodulus_stored'], {}, { 'user:rheocyte emodulus': "Young's modulus (kPa)" });
  const computed = [recording(2, ['emodulus']), recording(3, ['emodulus'])];
  const tables = (third) => new Map([[2, 'HE-3D-26'], [3, third]]);
  assert.match(
    originOf('emodulus_stored', [stored, companion, ...computed], new Map()),
    /^Stored in the recordings, not computed here: from the table LE-2D-FEM-19 \(1 recording\), rheocyte \(1 recording\)\./,
  );
  assert.equal(originOf('emodulus', [stored, ...computed], tables('HE-3D-26')), 'Computed here with the table HE-3D-26 (2 recordings).');
  assert.match(originOf('emodulus', computed, tables('LE-2D-26')), /HE-3D-26 \(1 recording\), LE-2D-26 \(1 recording\)\. Differences between tables/);
  assert.equal(originOf('area_um', [recording(0, ['area_um'])], new Map()), '');
});
