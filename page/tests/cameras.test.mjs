import assert from 'node:assert/strict';
import test from 'node:test';
import { loadModule } from './load_module.mjs';

const { sightsOf, halfOfStraight, titleOfAside } = await loadModule('cell/cameras.ts');
const { streamlines } = await loadModule('draw/streamlines.ts');

const outline = (size) => ({ x_um: [size, -size, size], r_um: [0, size, -size] });
const wall = { x_um: [-20, 20], r_um: [50, 10] };
const step = { contour: outline(1), contours: { side: outline(2), across: outline(3) }, wall };
const chip = { 'channel.section': 'square', 'channel.profile.x_um': [30, 70], 'channel.profile.width_um': [100, 20] };

test('In a planar funnel the cell is seen from above between the walls of the funnel, and from the side between straight ones', () => {
  const [above, side] = sightsOf(chip, step);
  assert.deepEqual([above.title, side.title], ['From above', 'From the side']);
  assert.deepEqual([above.contour, side.contour], [outline(2), outline(3)]);
  assert.deepEqual(above.wall, wall);
  assert.equal(above.radius_um, 25, 'the cell is not lost in a wide channel');
  assert.equal(side.radius_um, 10);
  assert.equal(side.wall, undefined);
  assert.equal(sightsOf({ ...chip, 'channel.camera_degree': 90 }, step)[0].title, 'From the side');
});

test('In tubes and in straight squares all cameras see the same', () => {
  const [tube, ...others] = sightsOf({ 'channel.profile.x_um': [0, 10], 'channel.profile.R_um': [20, 10] }, step);
  assert.deepEqual([others.length, tube.title, tube.radius_um], [0, '', 20]);
  const alike = { ...step, contours: { side: outline(2), diagonal: outline(2) } };
  assert.deepEqual(sightsOf({ 'channel.section': 'square', 'channel.width_um': 30 }, alike), [{ title: '', contour: outline(1), radius_um: 15 }]);
});

test('A cell off the axis is shown in the plane of its offset', () => {
  const rectangle = { 'channel.section': 'rectangle', 'channel.width_um': 30, 'channel.height_um': 20 };
  assert.equal(titleOfAside(rectangle), '');
  assert.equal(halfOfStraight({ ...rectangle, 'cell.offset_um': [0, 2] }), 10);
  assert.equal(halfOfStraight({ ...rectangle, 'cell.offset_um': [2, 0] }), 15);
  assert.deepEqual(sightsOf({ ...chip, 'cell.offset_um': [2, 0] }, step).map(({ title, contour }) => [title, contour]), [['From above', outline(1)]]);
});

/** Liquid between two ends, below and above the axis, that flows as `velocity` says. */
function fieldsOf(velocity) {
  const points = [];
  for (let x = -30; x <= 30; x += 2) for (let r = -10; r <= 10; r += 1) points.push([x, r]);
  const triangles = [];
  for (let k = 0; k + 22 < points.length; ++k) if ((k + 1) % 21) triangles.push(k, k + 1, k + 21, k + 1, k + 22, k + 21);
  return {
    places: new Float32Array(points.flat()),
    whole: true,
    triangles: new Uint32Array(triangles),
    region: new Uint8Array(points.length),
    values: { velocity_m_per_s: new Float32Array(points.flatMap(([x, r]) => velocity(x, r))) },
  };
}

test('Streamlines of both sides of the axis stay in the liquid that was computed and do not wind for ever', () => {
  const straight = streamlines(fieldsOf(() => [1, 0]), -50, 50, 10);
  assert.ok(straight.length >= 16, 'on both sides');
  for (const { points } of straight) assert.ok(points.every(([x, r]) => Math.abs(x) <= 30 && r === points[0][1]));
  for (const { points } of streamlines(fieldsOf((x, r) => [x > 0 ? r : 1, x > 0 ? 20 - x : 0]), -50, 50, 10)) assert.ok(points.length < 200);
});
