// Frames and ticks a second of a game that plays by itself: what the measurements of window and page share.

import { sleep } from './poll.mjs';

export const LEVELS = ['full', 'good', 'plain'];

// Ticks that the water of the waterfall takes to get all the way down.
export const BEGUN = 180;

// Counts them for some seconds by what `stats` tells.
export async function rate(stats, seconds = 12) {
  const before = await stats();
  const begun = performance.now();
  await sleep(1000 * seconds);
  const after = await stats();
  const passed = (performance.now() - begun) / 1000;
  return [(after.frame - before.frame) / passed, (after.tick - before.tick) / passed];
}

// A line of a table: the median of several runs, and the least and most frames.
export function line(where, runs) {
  const sorted = (k) => runs.map((run) => run[k]).sort((a, b) => a - b);
  const [frames, ticks] = [sorted(0), sorted(1)];
  const middle = Math.floor(runs.length / 2);
  const number = (x) => x.toFixed(1);
  return `| ${where} | ${number(frames[middle])} | ${number(frames[0])}–${number(frames.at(-1))} | ${number(ticks[middle])} |`;
}
