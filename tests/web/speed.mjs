// Times of a tick in WebAssembly on one thread, under node. Prints one line of JSON for each case.
// Usage: node tests/web/speed.mjs [DIST]

import { load, measure } from './module.mjs';

const CASES = [
  ['scene=dam_break&columns=71', 400, 40],
  ['scene=dam_break&columns=224', 150, 20],
];
const game = await load(process.argv[2] ?? 'dist');
for (const [link, ticks, warmup] of CASES) {
  const metrics = measure(game, link, ticks, warmup);
  const stages = Object.entries(metrics.stages).map(([name, { ms_median: ms }]) => [name, ms && Number(ms.toFixed(3))]);
  console.log(JSON.stringify({
    link,
    quality: metrics.quality,
    threads: metrics.threads,
    particles: metrics.particles.total,
    ms_per_tick: metrics.ms_per_tick,
    p99: metrics.accuracy.density_error_p99,
    stages: Object.fromEntries(stages),
  }));
}
