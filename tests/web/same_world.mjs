// The world in a browser is the one on a desktop, bit for bit: compares the hash of each scene after 600 ticks.
// Usage: node tests/web/same_world.mjs PATH-OF-powder-master [DIST]

import { execFileSync } from 'node:child_process';
import { load, measure } from './module.mjs';

const TICKS = 600;
const [program, dist = 'dist'] = process.argv.slice(2);
const run = (...words) => execFileSync(program, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] });

const game = await load(dist);
const scenes = run('list', 'scenes').trim().split('\n').map((line) => line.split('\t')[0]);
let different = 0;
for (const scene of scenes) {
  const there = run('run', scene, '--ticks', String(TICKS)).match(/hash=([0-9a-f]{16})/)[1];
  const here = measure(game, `scene=${scene}`, TICKS);
  const same = here.hash === there && here.ticks === TICKS;
  different += same ? 0 : 1;
  console.log(`${same ? 'ok' : 'FAILED'}: ${scene}, ${here.particles.total} particles: ${here.hash} here, ${there} there`);
}
if (scenes.length === 0 || different > 0) process.exitCode = 1;
console.log(`${scenes.length - different} of ${scenes.length} scenes are the same after ${TICKS} ticks`);
