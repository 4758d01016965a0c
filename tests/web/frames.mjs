// Frames a second of the waterfall in headless Chromium, level by level; `dist/` must be built.
// Usage: node tests/web/frames.mjs ROUNDS WEB-BUILD-PROGRAM NODE-MODULES

import { tmpdir } from 'node:os';
import { BEGUN, LEVELS, line, rate } from '../rate.mjs';
import { begin, click, stats, until } from './player.mjs';

const [rounds, builder, modules] = process.argv.slice(2);
const player = await begin(builder, modules, tmpdir());

async function measure(level) {
  const page = await player.play(`${player.host.url}#scene=waterfall`);
  await page.keyboard.press('F4');
  await click(page, level);
  await until(page, level, ({ picture }) => picture === level);
  await page.keyboard.press('F4');
  await until(page, 'water on its way', ({ tick }) => tick > BEGUN);
  const found = await rate(() => stats(page));
  await page.context().close();
  return found;
}

const runs = new Map(LEVELS.map((level) => [level, []]));
for (let round = 0; round < Number(rounds); round += 1) {
  for (const level of LEVELS) runs.get(level).push(await measure(level));
}
for (const [level, found] of runs) console.log(line(level, found));
await player.end();
