// Plays the page in a real headless Chromium as a person would, with mouse, keys and fingers, and looks at the picture.
// Usage: node tests/web/play.mjs WEB-BUILD-PROGRAM NODE-MODULES FOLDER-FOR-SCREENSHOTS [ONE-PART]

import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { onADesktop } from './parts/desktop.mjs';
import { onADenseScreen, onAPhone } from './parts/phone.mjs';
import { onAPlainHost, overAnUpdate } from './parts/hosts.mjs';
import { whereItCanNot, whereItGoesWrong } from './parts/trouble.mjs';
import { begin } from './player.mjs';

const [builder, modules, shots, wanted] = process.argv.slice(2);
mkdirSync(shots, { recursive: true });

const all = { onADesktop, onAPhone, onADenseScreen, onAPlainHost, overAnUpdate, whereItCanNot, whereItGoesWrong };
const parts = Object.values(all).filter((part) => !wanted || part.name === wanted);
assert.ok(parts.length > 0, `no part ${wanted}; there are ${Object.keys(all).join(', ')}`);

const player = await begin(builder, modules, shots);
try {
  for (const part of parts) await part(player);
  assert.deepEqual(player.complaints, [], 'the console has errors');
  console.log(`${player.passed()} passed, 0 failed; screenshots in ${shots}`);
} catch (error) {
  const told = player.complaints.join('\n');
  console.error(`FAILED after ${player.passed()} passed: ${error.stack}\nconsole: ${told}\nscreenshots in ${shots}`);
  process.exitCode = 1;
} finally {
  await player.end();
}
