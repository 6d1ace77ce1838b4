// States that look like those of the program: right names and shapes of arrays, made-up physics that is quick to write.
const points = 41; // along the half contour
const layers = 14; // from the surface to the walls, and from the middle to the surface

const at = (object, path) => path.split('.').reduce((now, name) => now?.[name], object);

/** Case in sections -> the few numbers that the made-up physics needs. */
export function physicsOf(sections) {
  const width = at(sections, 'channel.width_um');
  const wall = at(sections, 'channel.radius_um') ?? 0.547 * (width ?? 20);
  const radius = at(sections, 'cell.radius_um');
  const modulus = at(sections, 'cell.bulk.young_modulus_kPa') ?? 3;
  const rate = at(sections, 'flow.rate_ul_per_s') ?? 0.04;
  const viscosity = at(sections, 'flow.viscosity_mPas') ?? 8;
  const load = (rate / 0.04) * (viscosity / 15) * (3.437 / modulus) * (10.94 / wall) ** 3 * (radius / 7.66) ** 2;
  return { wall, radius, deformation: 0.0361 * load, speed: rate / (Math.PI * wall * wall * 1e-3), sections };
}

export const wrongKey = ({ wall, radius }) => (radius > 0.965 * wall || radius < 0.05 * wall ? 'cell.radius_um' : null);

function surfaceRadius({ radius, deformation }, angle) {
  const c = Math.cos(angle);
  const second = 0.5 * (3 * c * c - 1);
  const third = 0.5 * (5 * c * c * c - 3 * c);
  return radius * (1 + 1.2 * deformation * second + 2 * deformation * third);
}

function contourOf(physics) {
  const x_um = [];
  const r_um = [];
  for (let k = 0; k < 2 * points; ++k) {
    const angle = (Math.PI * k) / points;
    const radius = surfaceRadius(physics, angle);
    x_um.push(radius * Math.cos(angle));
    r_um.push(radius * Math.sin(angle));
  }
  return { x_um, r_um };
}

/** Distance from the middle to the rectangle of the channel along a ray. */
function toWalls({ wall }, angle) {
  const half = 3 * wall;
  return Math.min(half / Math.abs(Math.cos(angle) || 1e-9), wall / (Math.sin(angle) || 1e-9));
}

function layerPoints(physics, region) {
  const places = [];
  for (let i = 0; i <= layers; ++i) {
    for (let k = 0; k <= points; ++k) {
      const angle = (Math.PI * k) / points;
      const surface = surfaceRadius(physics, angle);
      const outer = region === 1 ? surface : toWalls(physics, angle);
      const inner = region === 1 ? 0 : surface;
      const distance = inner + (i / layers) * (outer - inner);
      places.push([distance * Math.cos(angle), Math.max(0, distance * Math.sin(angle)), i / layers]);
    }
  }
  return places;
}

function layerTriangles(offset) {
  const triangles = [];
  for (let i = 0; i < layers; ++i) {
    for (let k = 0; k < points; ++k) {
      const a = offset + i * (points + 1) + k;
      triangles.push(a, a + 1, a + points + 1, a + 1, a + points + 2, a + points + 1);
    }
  }
  return triangles;
}

/** Fields as they follow the numbers: a line, then the arrays. */
export function fieldsOf(physics) {
  const liquid = layerPoints(physics, 0);
  const cell = layerPoints(physics, 1);
  const all = [...liquid, ...cell];
  const region = Uint8Array.from(all, (_, k) => (k < liquid.length ? 0 : 1));
  const { wall, speed, deformation } = physics;
  const velocity = all.flatMap(([x, r, t], k) => {
    if (region[k] === 1) return [0, 0];
    const relative = 2 * speed * (1 - (r / wall) ** 2) - 1.4 * speed;
    return [relative * t, -0.4 * relative * t * (1 - t) * Math.sign(x)];
  });
  const stress = all.map(([, , t], k) => (region[k] === 1 ? 4e4 * deformation * t * t : 0));
  const values = {
    speed_m_per_s: all.map((_, k) => Math.hypot(velocity[2 * k], velocity[2 * k + 1])),
    velocity_m_per_s: velocity,
    pressure_Pa: all.map(([x], k) => (region[k] === 0 ? -110 * x : 0)),
    shear_rate_per_s: all.map(([, r], k) => (region[k] === 0 ? (4e6 * speed * r) / (wall * wall) : 0)),
    stress_Pa: stress,
    stretch: all.map((_, k) => 1 + stress[k] / 1e4),
    displacement_um: all.flatMap(([x, r], k) => (region[k] === 1 ? [2 * deformation * x, -deformation * r] : [0, 0])),
  };
  const arrays = {
    xy_um: Float32Array.from(all.flatMap(([x, r]) => [x, r])),
    index: Uint32Array.from([...layerTriangles(0), ...layerTriangles(liquid.length)]),
    ...Object.fromEntries(Object.entries(values).map(([name, list]) => [`values/${name}`, Float32Array.from(list)])),
    ...solidOf(physics),
    region,
  };
  const head = {
    points: all.length,
    triangles: 4 * layers * points,
    surface: surfaceOf(physics),
    wall: { x_um: [-3 * wall, 3 * wall], r_um: [wall, wall] },
    arrays: Object.entries(arrays).map(([name, array]) => ({
      name,
      type: array.constructor.name.replace('Array', '').toLowerCase(),
      count: array.length,
    })),
  };
  return Buffer.concat([Buffer.from(`${JSON.stringify(head)}\n`), ...Object.values(arrays).map((array) => Buffer.from(array.buffer))]);
}

function surfaceOf(physics) {
  const { x_um, r_um } = contourOf(physics);
  const modulus = at(physics.sections, 'cell.cortex.modulus_mN_per_m') ?? 0;
  const half = { x_um: x_um.slice(0, points + 1), r_um: r_um.slice(0, points + 1) };
  return modulus ? { ...half, tension_mN_per_m: half.x_um.map((x) => modulus * (0.2 + 0.01 * x)) } : half;
}

function solidOf(physics) {
  if (at(physics.sections, 'channel.section') !== 'square') return {};
  const xyz = [];
  const index = [];
  for (let k = 0; k <= points; ++k) {
    for (let j = 0; j <= points; ++j) {
      const radius = surfaceRadius(physics, (Math.PI * k) / points);
      const across = radius * Math.sin((Math.PI * k) / points);
      const turn = (2 * Math.PI * j) / points;
      xyz.push(radius * Math.cos((Math.PI * k) / points), across * Math.cos(turn), across * Math.sin(turn));
      const a = k * (points + 1) + j;
      if (k < points && j < points) index.push(a, a + points + 1, a + 1, a + 1, a + points + 1, a + points + 2);
    }
  }
  return { 'surface3d/xyz_um': Float32Array.from(xyz), 'surface3d/index': Uint32Array.from(index) };
}

export function stateOf(physics, accuracy) {
  const { deformation, radius, speed, wall, sections } = physics;
  const contour = contourOf(physics);
  const pressureDrop = 61000 * speed * (1 + 0.1 * accuracy);
  return {
    program: 'rheocyte',
    version: 'mock',
    status: 'converged',
    message: 'The stationary shape was found.',
    deformation: deformation * (1 + 0.02 * accuracy),
    area_um2: Math.PI * radius * radius * (1 + deformation),
    cell_velocity_m_per_s: 1.4 * speed,
    pressure_drop_Pa: pressureDrop,
    stability_margin: Math.max(0, 1 - deformation / 0.15),
    estimated_error: 0.2 * accuracy,
    errors: {
      deformation: 0.2 * accuracy * deformation,
      area_um2: 20 * accuracy,
      cell_velocity_m_per_s: null,
      pressure_drop_Pa: 0.1 * accuracy * pressureDrop,
      stability_margin: 0.3 * accuracy,
    },
    tube_radius_um: wall,
    wall_time_s: 0.02,
    case: sections,
    contour,
    hull: contour,
  };
}

/** One step on the way to the shape: share 0..1 of the time. */
export function stepOf(physics, share) {
  const end_s = 1e-6 * at(physics.sections, 'time.end_us');
  const now = { ...physics, deformation: physics.deformation * (1 - Math.exp(-5 * share)) };
  return {
    time_s: share * end_s,
    x_um: 1e6 * share * end_s * 1.4 * physics.speed,
    deformation: now.deformation,
    velocity_m_per_s: 1.4 * physics.speed,
    contour: contourOf(now),
    progress: share,
  };
}

export function linesOf() {
  const lines = [1, 2, 3, 5, 10].map((young_modulus_kPa) => {
    const x = Array.from({ length: 20 }, (_, k) => 20 + 12 * k);
    return { young_modulus_kPa, x, y: x.map((area) => (0.0361 * 3.437 * (area / 190) ** 2) / young_modulus_kPa) };
  });
  return { lines: lines.map(cutAt(0.15)), sentence: 'Lines of the mock.' };
}

const cutAt = (limit) => (line) => {
  const kept = line.x.map((_, k) => k).filter((k) => line.y[k] <= limit);
  return { ...line, x: kept.map((k) => line.x[k]), y: kept.map((k) => line.y[k]) };
};
