// The window is resized and goes away while every tick is late: the game goes on, the world takes no notice, and the picture
// is right afterwards. Without a window manager nothing can be minimised; what one does to a window that is, is to unmap it.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { poll } from '../poll.mjs';
import { difference, display, isDrawn, keepLevel, open } from './game.mjs';

// Down to the smallest, and up to the screen's, across and along.
const SIZES = [[640, 400], [1280, 400], [480, 320], [900, 800], [481, 799], [1280, 800]];
const FULL = SIZES.at(-1);
// A tick of the 115,200 particles at which `reference` plays this dam takes some 100 ms on one thread; one that is in time takes less
// than this.
const IN_TIME = 1000 / 60;
const SCENE = ['dam_break', '--set', 'columns=120', '--quality', 'reference', '--threads', '1'];

export async function resizeWhileLate(program, folder) {
  // Left to itself it would draw less once frames have been slow for a while, and be another picture.
  keepLevel(folder, 'full');
  const screen = await display();
  let game;
  try {
    game = await open(program, screen.name, folder, [...SCENE, '--record', 'late.pmr']);
    const late = await game.until('ticks are late', ({ tick, msPerTick }) => tick > 5 && msPerTick > IN_TIME);
    const ticksOn = async (what) => {
      const { tick } = await game.stats();
      return game.until(`the world goes on ${what}`, (now) => now.tick > tick + 2);
    };
    // The HUD is laid out anew for each size, and nothing of its bars is outside.
    const fits = ([width, height]) => game.untilWidgets(`the HUD fits ${width} × ${height}`, (all) => {
      const bar = all.find(({ name }) => name === 'pause')?.place;
      return bar !== undefined && bar[0] >= 0 && bar[1] >= 0 && bar[0] + bar[2] <= width && bar[1] + bar[3] <= height;
    });
    for (const size of SIZES) {
      await game.resize(size);
      await fits(size);
      await ticksOn(`at ${size.join(' × ')}`);
    }
    // Faster than any frame can follow.
    for (let k = 0; k < 60; k += 1) await game.resize(SIZES[k % SIZES.length], false);
    await game.resize(FULL);
    await ticksOn('after sixty sizes in a row');
    for (let k = 0; k < 3; k += 1) {
      await game.hide();
      await ticksOn('out of sight');
      await game.resize(SIZES[k]);
      await game.show();
      await ticksOn('in sight again');
    }
    await game.resize(FULL);
    await fits(FULL);

    // The picture of a world that stands is the same before and after, and it is one of water.
    await game.tell('pause');
    await game.until('it stands', ({ paused, messages }) => paused && messages.length === 0);
    // A frame of so many particles takes long: what the window has gained is black until it is drawn, and what keeps still for less
    // than a second may be one that is not done.
    const still = async (name, size) => {
      let before;
      await poll(`${name} is drawn`, async () => {
        before = await game.picture(name);
        return isDrawn(before, size);
      }, Boolean);
      let since = Date.now();
      await poll(`${name} keeps still`, async () => {
        const last = before;
        before = await game.picture(name);
        if (difference(last, before) > 0) since = Date.now();
        return Date.now() - since;
      }, (held) => held > 1000);
      return before;
    };
    const before = await still('late-before', FULL);
    await game.resize([700, 500]);
    await fits([700, 500]);
    const small = await still('late-small', [700, 500]);
    assert.ok(difference(before, small) > 5, 'another size has the same picture');
    await game.hide();
    await game.show();
    await game.resize(FULL);
    await fits(FULL);
    const apart = async () => difference(before, await game.picture('late-after'));
    await poll('the picture is as it was', apart, (share) => share === 0);

    // What was played is on the disk, and comes to the same bits without a window.
    await game.focus();
    await game.key('ctrl+s');
    const file = join(folder, 'late.pmr');
    await poll('the recording', () => existsSync(file), Boolean);
    const { tick } = await game.stats();
    const said = execFileSync(program, ['replay', file], { encoding: 'utf8' }).trim();
    assert.match(said, new RegExp(`^same: ${tick} ticks, `), `replayed: ${said}`);
    assert.equal(await game.kill(), 'SIGTERM', 'it ended by itself');
    assert.doesNotMatch(readFileSync(join(folder, 'log'), 'utf8'), /panicked/i, 'the game panicked');
    return `${late.msPerTick.toFixed(0)} ms a tick; ${said}`;
  } finally {
    await game?.kill();
    screen.stop();
  }
}
