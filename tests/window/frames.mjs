// Frames a second of the waterfall in a window under Xvfb, level by level, programs in turn.
// Usage: node tests/window/frames.mjs ROUNDS PROGRAM…

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { BEGUN, LEVELS, line, rate } from '../rate.mjs';
import { display, keepLevel, open } from './game.mjs';

const [rounds, ...programs] = process.argv.slice(2);
const server = await display();

async function measure(program, level) {
  const folder = mkdtempSync(join(tmpdir(), 'powder-master-frames-'));
  keepLevel(folder, level);
  const game = await open(resolve(program), server.name, folder, ['waterfall']);
  await game.until('water on its way', ({ tick }) => tick > BEGUN);
  const found = await rate(game.stats);
  await game.kill();
  rmSync(folder, { recursive: true });
  return found;
}

const runs = new Map();
for (let round = 0; round < Number(rounds); round += 1) {
  for (const level of LEVELS) {
    for (const program of programs) {
      const name = `${program}, ${level}`;
      runs.set(name, [...(runs.get(name) ?? []), await measure(program, level)]);
    }
  }
}
for (const [name, found] of runs) console.log(line(name, found));
server.stop();
