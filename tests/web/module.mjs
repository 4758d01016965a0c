// The game's module under node: no page, no game, only the simulation.

import { copyFileSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

// Loads what `cargo web --build` left in a folder, and returns what it exports.
export async function load(dist) {
  const { names } = JSON.parse(readFileSync(join(dist, 'files.json'), 'utf8'));
  // Node takes a script for a module by its ending.
  const folder = mkdtempSync(join(tmpdir(), 'powder-master-'));
  const script = join(folder, 'powder-master.mjs');
  copyFileSync(join(dist, names['powder-master.js']), script);
  globalThis.powderHost = { failed: (message) => { throw new Error(message); } };
  try {
    const game = await import(pathToFileURL(script).href);
    game.initSync({ module: readFileSync(join(dist, names['powder-master.wasm'])) });
    return game;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

// Runs what a link asks for, for so many ticks: the object that `run --metrics` writes.
export function measure(game, link, ticks, warmup = 0) {
  return JSON.parse(game.measure(JSON.stringify([...new URLSearchParams(link)]), ticks, warmup));
}
