// The view with the built page and virtual recordings, until it is stopped: to see what has been changed.
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { prepareRecordings } from './tests/prepared.mjs';
import { startTarget } from './tests/target.mjs';

process.env.RHEOCYTE_PAGE ??= fileURLToPath(new URL('dist', import.meta.url));
const folder = await mkdtemp(join(tmpdir(), 'rheocyte-recordings-'));
const target = await startTarget(await prepareRecordings(folder));
console.log(target.address);
process.once('SIGINT', async () => {
  await target.stop();
  await rm(folder, { recursive: true });
});
