// The page on a phone, and on a screen with small pixels.

import assert from 'node:assert/strict';
import { launch } from '../browser.mjs';
import { near } from '../../poll.mjs';
import { find, stats, still, until, untilWidgets } from '../player.mjs';

export async function onAPhone({ host, play, shoot, shootUntil, test }) {
  const page = await play(`${host.url}#scene=empty`, {
    viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true,
  });
  const devtools = await page.context().newCDPSession(page);
  const touch = (type, ...points) => devtools.send('Input.dispatchTouchEvent', {
    type, touchPoints: points.map(([x, y], id) => ({ x, y, id })),
  });
  // Moves one finger, and waits until the game knows.
  const slide = async (to) => {
    await touch('touchMove', to);
    await until(page, `the finger at ${to}`, ({ pointer }) => pointer !== null && near(pointer, to));
  };
  await test('the canvas of a phone fills its screen', async () => {
    const size = await page.evaluate(() => ['width', 'height'].map((side) => document.getElementById('world')[side]));
    assert.deepEqual(size, [390, 844]);
    await shoot(page, 'phone-empty');
  });
  await test('one finger draws', async () => {
    await touch('touchStart', [120, 300]);
    for (let x = 128; x <= 280; x += 8) await slide([x, 300]);
    await touch('touchEnd');
    const now = await until(page, 'drawing', ({ particles }) => particles > 30);
    await shoot(page, 'phone-drawn');
    return `${now.particles} particles`;
  });
  await test('two fingers zoom and draw nothing', async () => {
    // Water that still moves would differ by itself.
    await still(page);
    const before = (await stats(page)).particles;
    const first = await shoot(page, 'phone-before-zoom');
    await touch('touchStart', [180, 300], [210, 300]);
    for (let half = 15; half <= 120; half += 7) {
      await touch('touchMove', [195 - half, 300], [195 + half, 300]);
      const { frame } = await stats(page);
      await until(page, 'the fingers have moved', (now) => now.frame > frame);
    }
    await touch('touchEnd');
    const share = await shootUntil(page, 'phone-zoomed', first, (share) => share > 0.5);
    assert.equal((await stats(page)).particles, before);
    return `${share.toFixed(1)} % of the picture changed`;
  });
  const tap = async (name) => {
    await touch('touchStart', await find(page, name));
    const { frame } = await stats(page);
    await until(page, 'the finger is felt', (now) => now.frame > frame);
    await touch('touchEnd');
  };
  await test('the list of elements has them all, and what is chosen has a tile', async () => {
    await tap('All elements');
    const all = await untilWidgets(page, 'the list', (all) => all.some(({ name }) => name === 'glass'));
    await shoot(page, 'phone-elements');
    const small = all.filter(({ kind, place: [, , width, height] }) => kind === 'Button' && Math.min(width, height) < 47.5);
    assert.deepEqual(small, [], 'too small for a finger');
    await tap('glass');
    await until(page, 'glass is chosen', ({ tool }) => tool === 'glass');
    await untilWidgets(page, 'the bar shows it, and the list is closed', (all) => (
      all.some(({ name }) => name === 'glass') && !all.some(({ name }) => name === 'brine')));
    await tap('water');
    await until(page, 'water is chosen', ({ tool }) => tool === 'water');
  });
  await test('the tool bar hides and comes back', async () => {
    await still(page);
    const before = await shoot(page, 'phone-tools');
    await tap('Hide the tools');
    const hidden = await shootUntil(page, 'phone-no-tools', before, (share) => share > 5);
    await tap('Show the tools');
    const again = await shootUntil(page, 'phone-tools-again', before, (share) => share < 0.5);
    // What the finger drew goes.
    await tap('Undo');
    await until(page, 'undo', ({ particles }) => particles === 0);
    return `${hidden.toFixed(1)} % of the picture gone, all but ${again.toFixed(1)} % back`;
  });
  await page.context().close();
}

// An emulated density changes what a page is told, not how large its pixels are: this one is the browser's own.
export async function onADenseScreen({ host, modules, shoot, test }) {
  const dense = await launch(modules, ['--force-device-scale-factor=2', '--window-size=700,500']);
  try {
    await test('a dense screen has all its pixels', async () => {
      const page = await (await dense.newContext({ viewport: null })).newPage();
      await page.goto(`${host.url}#scene=communicating_vessels`);
      await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
      assert.equal(await page.evaluate(() => devicePixelRatio), 2);
      const size = await page.waitForFunction(() => {
        const { width, height } = document.getElementById('world');
        const all = width === innerWidth * devicePixelRatio && height === innerHeight * devicePixelRatio;
        return all && [width, height];
      });
      await shoot(page, 'dense-screen');
      return `${(await size.jsonValue()).join(' × ')} pixels`;
    });
  } finally {
    await dense.close();
  }
}
