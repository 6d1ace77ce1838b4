// What the view tells of a case are the numbers of `rheocyte solve`, to the last digit, where both begin from nothing.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { promisify } from 'node:util';
import { noProgram, program, startTarget } from './target.mjs';

const run = promisify(execFile);
const newtonian = { rate_ul_per_s: 0.04, viscosity_mPas: 15 };
const powerLaw = { rate_ul_per_s: 0.04, law: 'power-law', consistency_Pa_sn: 0.179, exponent: 0.677 };
const carreau = { rate_ul_per_s: 0.04, law: 'carreau', zero_shear_viscosity_mPas: 30, relaxation_time_ms: 0.1, exponent: 0.6 };

const cell = (radius_um, young_modulus_kPa, flow = newtonian, more = {}, channel = { width_um: 20 }, accuracy = 1e-3) => ({
  channel,
  flow,
  cell: { radius_um, bulk: { young_modulus_kPa }, ...more },
  numerics: { accuracy },
});
const cortex = (law, modulus_mN_per_m, more = {}) => ({ cortex: { law, modulus_mN_per_m, ...more } });

// Neighbours differ by more than a fifth: no session answers one from the other.
const cases = {
  'a small cell': cell(4, 2),
  'the cell of the paper': cell(7.66, 3.437, newtonian, {}, { width_um: 20 }, 1e-4),
  'a stiff cell': cell(7, 12),
  'a large cell': cell(8.6, 9),
  'a nearly rigid cell': cell(6, 200),
  'a tube': cell(5, 20, newtonian, {}, { radius_um: 8 }),
  'a wide channel': cell(12, 2.5, newtonian, {}, { width_um: 40 }),
  'a slow flow': cell(5, 1, { rate_ul_per_s: 0.01, viscosity_mPas: 15 }),
  'a viscous liquid': cell(7, 30, { rate_ul_per_s: 0.06, viscosity_mPas: 60 }),
  'a linear solid': { ...cell(6, 6), cell: { radius_um: 6, bulk: { law: 'linear', young_modulus_kPa: 6 } } },
  'power law': cell(6.5, 3, powerLaw),
  'power law, stiff': cell(7.5, 8, powerLaw),
  'power law, thinner': cell(6, 2, { ...powerLaw, exponent: 0.5 }),
  Carreau: cell(6.5, 3, carreau),
  'Carreau, stiff': cell(7, 10, carreau),
  'a surface tension': cell(7, 2.5, newtonian, { cortex: { tension_mN_per_m: 5 } }),
  'a cortex under tension': cell(7, 4, newtonian, cortex('linear', 10, { tension_mN_per_m: 6 })),
  'a neo-Hookean cortex': cell(6.5, 6, newtonian, cortex('neo-hookean', 20, { tension_ratio: 0.3 })),
  'a cortex in a power law': cell(6.5, 5, powerLaw, cortex('linear', 15, { tension_mN_per_m: 12 })),
  'a square channel': cell(7, 5, newtonian, {}, { width_um: 20, section: 'square' }, 0.05),
};

function tomlOf(sections, path = '') {
  const isSection = ([, value]) => typeof value === 'object';
  const entries = Object.entries(sections);
  const own = entries.filter((entry) => !isSection(entry)).map(([name, value]) => `${name} = ${JSON.stringify(value)}\n`);
  const within = entries.filter(isSection).map(([name, value]) => tomlOf(value, path ? `${path}.${name}` : name));
  return (path && own.length ? `[${path}]\n` : '') + own.join('') + within.join('');
}

async function viewed(target, sections) {
  const token = new URL(target.address).searchParams.get('token');
  const head = { Authorization: `Bearer ${token}` };
  const answer = await fetch(new URL('/api/state', target.address), { method: 'POST', headers: head, body: JSON.stringify(sections) });
  const body = await answer.json();
  assert.equal(answer.status, 200, body.error);
  return body;
}

async function solved(sections) {
  const folder = await mkdtemp(join(tmpdir(), 'rheocyte-test-'));
  try {
    await writeFile(join(folder, 'case.toml'), tomlOf(sections));
    await run(program, ['solve', join(folder, 'case.toml'), '-o', join(folder, 'result'), '--no-picture', '--quiet'], { cwd: folder });
    return JSON.parse(await readFile(join(folder, 'result', 'result.json'), 'utf8'));
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

/** How long the computer took is another number each time. */
function withoutTimes({ wall_time_s: _, statistics, ...result }) {
  const counts = Object.entries(statistics).filter(([name]) => !name.endsWith('_s'));
  return { ...result, statistics: Object.fromEntries(counts) };
}

test(`${Object.keys(cases).length} cases have the numbers of the command line`, { skip: noProgram }, async (all) => {
  const target = await startTarget();
  try {
    for (const [name, sections] of Object.entries(cases))
      await all.test(name, async () => {
        const [shown, wanted] = [withoutTimes(await viewed(target, sections)), withoutTimes(await solved(sections))];
        for (const key of Object.keys(wanted)) assert.deepEqual(shown[key], wanted[key], key);
      });
  } finally {
    await target.stop();
  }
});
