// What a second thread gains in a page: times of a tick with 100,352 particles, on one thread and on two, in turns, in one
// headless Chromium. Usage: node tests/web/threads.mjs WEB-BUILD-PROGRAM NODE-MODULES

import { launch, serve } from './browser.mjs';

const ROUNDS = 3;
const [builder, modules] = process.argv.slice(2);
const host = await serve(builder);
const browser = await launch(modules);
const middle = (numbers) => numbers.sort((a, b) => a - b)[numbers.length >> 1];
try {
  const times = new Map([[1, []], [2, []]]);
  const hashes = new Set();
  for (let round = 0; round < ROUNDS; round += 1) {
    for (const [threads, list] of times) {
      // A page at a time: another one would go on drawing.
      const page = await browser.newPage({ viewport: { width: 320, height: 200 } });
      await page.goto(`${host.url}?threads=${threads}#scene=empty`);
      await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
      const metrics = await page.evaluate(() => window.powderMaster.measure('scene=dam_break&columns=224', 60, 10));
      if (metrics.threads !== threads) throw new Error(`${metrics.threads} threads, not ${threads}`);
      list.push(metrics.ms_per_tick.median);
      hashes.add(metrics.hash);
      await page.close();
    }
  }
  const [one, two] = [...times.values()].map(middle);
  console.log(`${one.toFixed(2)} ms a tick on one thread, ${two.toFixed(2)} on two: ${(one / two).toFixed(2)} times as fast`);
  if (hashes.size !== 1) throw new Error(`the worlds differ: ${[...hashes].join(', ')}`);
} finally {
  await browser.close();
  host.stop();
}
