// Challenges go in a browser as they do on a desktop: plays each by its solution here and there, and compares stars, counts and
// the hash of the world at the end.
// Usage: node tests/web/challenges.mjs PATH-OF-powder-master [DIST] [QUALITY…]

import { execFileSync } from 'node:child_process';
import { isDeepStrictEqual } from 'node:util';
import { load } from './module.mjs';

const [program, dist = 'dist', ...wanted] = process.argv.slice(2);
const qualities = wanted.length > 0 ? wanted : ['balanced'];
const game = await load(dist);
let [all, wrong] = [0, 0];
for (const quality of qualities) {
  const words = ['challenge', '--quality', quality, '--json', '-'];
  for (const there of JSON.parse(execFileSync(program, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] }))) {
    const here = JSON.parse(game.challenge(there.challenge, quality));
    const stars = Object.values(here.stars).filter(Boolean).length;
    const good = isDeepStrictEqual(here, there) && stars === 3;
    [all, wrong] = [all + 1, wrong + (good ? 0 : 1)];
    console.log(`${good ? 'ok' : 'FAILED'}: ${there.challenge} at ${quality}, ${stars} stars: ${here.hash} here, ${there.hash} there`);
  }
}
if (all === 0 || wrong > 0) process.exitCode = 1;
console.log(`${all - wrong} of ${all} challenges are won with all stars, the same here and there`);
