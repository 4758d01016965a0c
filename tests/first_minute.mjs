// The first minute of somebody who has never seen the game: only what is written on the screen, by mouse, at the pace of a
// person who looks around. It is there to be looked at: a picture each five seconds.

import assert from 'node:assert/strict';
import { sleep } from './poll.mjs';

const STEP = 5;

// What is done in each five seconds, by a `hand` in a window or in a page. Places are those of a window of 1280 × 800.
const STEPS = [
  ['looks', async () => {}],
  ['pours what is in the hand', async ({ stroke }) => stroke('left', [[760, 260], [820, 250], [880, 260], [820, 270], [760, 260]])],
  ['presses sand and pours it', async ({ click, stroke }) => {
    await click('sand');
    await stroke('left', [[520, 300], [560, 290], [600, 300], [560, 310], [520, 300]]);
  }],
  ['erases rock', async ({ stroke }) => stroke('right', [[300, 520], [340, 500], [380, 490], [420, 480]])],
  ['opens all elements', async ({ click }) => click(/^all elements/)],
  ['takes lava', async ({ click }) => click('lava')],
  ['pours it onto the water', async ({ stroke }) => stroke('left', [[700, 300], [740, 300], [780, 300], [740, 300], [700, 300]])],
  ['blows', async ({ click, stroke }) => {
    await click('wind');
    await stroke('left', [[500, 600], [620, 590], [740, 580]]);
  }],
  ['takes that back', async ({ click }) => click(/^undo/)],
  ['opens the gallery', async ({ click }) => click(/^gallery/)],
  ['plays the fountain', async ({ click }) => click('Fountain')],
  ['asks for help', async ({ click }) => click(/help/)],
];

// Plays it. A hand has `click(name)`, `stroke(button, points)`, `picture(name)` and `stats()`.
export async function firstMinute(hand) {
  const begun = Date.now();
  const told = [];
  for (const [k, [name, act]] of STEPS.entries()) {
    const before = await hand.stats();
    await act(hand);
    const rest = begun + 1000 * STEP * (k + 1) - Date.now();
    await sleep(Math.max(rest, 0));
    const seconds = Math.round((Date.now() - begun) / 1000);
    await hand.picture(`minute-${String(k + 1).padStart(2, '0')}`);
    const now = await hand.stats();
    assert.ok(now.paused || now.tick !== before.tick || now.scene !== before.scene, `${name}: the world stands`);
    told.push(`${String(seconds).padStart(3)} s  ${name}: ${now.scene}, ${now.particles} particles, ${now.framesPerSecond.toFixed(0)} frames a second; ${now.messages.join(' | ')}`);
  }
  const end = await hand.stats();
  assert.equal(end.scene, 'fountain', 'the gallery played another scene');
  return told.join('\n');
}
