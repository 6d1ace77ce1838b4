// Recordings for tests and development: virtual cells by `rheocyte synth`, the same ones every time, and a damaged file.
import { execFile } from 'node:child_process';
import { writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { program } from './target.mjs';

const run = promisify(execFile);
const virtualCells = fileURLToPath(new URL('../../examples/recordings/virtual-cells.toml', import.meta.url));

/** Writes a recording of examples/recordings/virtual-cells.toml with other values of some keys. */
export const synthesise = (file, settings) =>
  run(program, ['synth', virtualCells, '-o', file, '--quiet', ...settings.flatMap((each) => ['--set', each])]);

/** Soft and stiff cells with pictures, more cells without, and a file that is no recording: paths in this order. */
export async function prepareRecordings(folder, more = 1200) {
  const [control, treated, broken] = ['control_1.rtdc', 'treated_1.rtdc', 'broken.rtdc'].map((name) => join(folder, name));
  const spread = ['cell.bulk.young_modulus_kPa.mean=3', 'cell.bulk.young_modulus_kPa.sd=2'];
  await synthesise(control, ['recording.cells=300', 'recording.seed=11', ...spread]);
  await synthesise(treated, [`recording.cells=${more}`, 'recording.seed=29', 'recording.pictures="none"']);
  await writeFile(broken, 'no recording\n');
  return [control, treated, broken];
}
