// The page on a desktop: mouse, keys, the hook, links and saved worlds.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { near, poll, sleep } from '../../poll.mjs';
import { water } from '../browser.mjs';
import { click, dragUntil, find, flick, follow, moveTo, stats, still, until, untilKept } from '../player.mjs';

const WORLD = { x: 0, y: 60, width: 1280, height: 660 };
const FLOOR = { x: 40, y: 690, width: 360, height: 40 };
const HIGH = [[560, 420], [640, 440], [720, 420], [640, 400]];

export async function onADesktop(player) {
  const page = await player.play(`${player.host.url}#scene=empty`);
  await atTheStart(player, page);
  await withTheMouse(player, page);
  await withSound(player, page);
  await withKeys(player, page);
  await byTheHook(player, page);
  await asAWindow(player, page);
  await withSaves(player, page);
  await page.context().close();
  await asleep(player);
  await inGerman(player);
}

async function atTheStart({ shoot, test }, page) {
  await test('the page loads, isolated, with a thread for each processor', async () => {
    const now = await stats(page);
    assert.equal(now.scene, 'empty');
    assert.equal(now.particles, 0);
    const [isolated, processors] = await page.evaluate(() => [crossOriginIsolated, navigator.hardwareConcurrency]);
    assert.ok(isolated);
    assert.equal(now.threads, Math.min(processors, 8));
    await shoot(page, 'desktop-empty');
    const times = await page.evaluate(() => window.powderMaster.times);
    return `${now.threads} threads, ${Math.round(times.firstFrame - times.lastByte)} ms from the last byte to the first frame`;
  });
}

async function withTheMouse({ eyes, shoot, test, waterUntil }, page) {
  await test('the left button pours', async () => {
    await until(page, 'the greeting goes', ({ messages }) => messages.length === 0);
    assert.equal(await water(eyes, await shoot(page, 'desktop-empty'), WORLD), 0, 'there is water in the picture');
    const { particles, elements } = await dragUntil(page, HIGH, '200 particles', (now) => now.particles >= 200);
    assert.equal(elements.water, particles);
    const pixels = await waterUntil(page, 'desktop-poured', WORLD, (pixels) => pixels > 300);
    return `${particles} particles, ${pixels} pixels of water`;
  });

  await test('wind blows the water away', async () => {
    await moveTo(page, [640, 120]);
    let before = 0;
    // Until what falls lies on the floor: it is looked at once in a second of the world's time. Small waves go on for
    // long; a tenth is less than half of what the wind has to take, so that they can't be taken for its doing.
    const calm = await poll('water lies on the floor', async () => {
      const { tick } = await stats(page);
      await until(page, 'a second of the world', (now) => now.tick >= tick + 60);
      const lies = await water(eyes, await shoot(page, 'desktop-calm'), FLOOR);
      const seen = { lies, settled: lies > 500 && Math.abs(lies - before) < 0.1 * lies };
      before = lies;
      return seen;
    }, ({ settled }) => settled);
    await page.keyboard.press('KeyW');
    await until(page, 'the tool is wind', ({ tool }) => tool === 'wind');
    let gusts = 0;
    const windy = await poll('a quarter of the water has gone from the left of the floor', async () => {
      gusts += 1;
      await flick(page, [50, 715], [530, 715]);
      return water(eyes, await shoot(page, 'desktop-windy'), FLOOR);
    }, (lies) => 4 * lies < 3 * calm.lies);
    return `water on ${windy} pixels of the floor after ${gusts} gusts, ${calm.lies} before`;
  });

  await test('the right button erases', async () => {
    const before = (await stats(page)).particles;
    const way = [200, 350, 500, 650, 800, 950, 1100, 1230].map((x) => [x, 715]);
    const now = await dragUntil(page, way, 'erasing', ({ particles }) => particles < before, 'right');
    return `${now.particles} particles, ${before} before`;
  });
}

// The first press was the gesture that a page needs before it may play.
async function withSound({ test }, page) {
  await test('falling water is heard, and what is muted costs nothing', async () => {
    const { sound } = await dragUntil(page, HIGH, 'water that runs', (now) => now.sound.stream > 0);
    await page.keyboard.press('Shift+KeyM');
    const heard = async () => (await stats(page)).sound.calls;
    let before = await heard();
    await poll('calls while it is muted', async () => {
      const { tick } = await stats(page);
      before = await heard();
      await until(page, 'ten ticks', (now) => now.tick >= tick + 10);
      return await heard() - before;
    }, (calls) => calls === 0);
    await page.keyboard.press('Shift+KeyM');
    await until(page, 'it is heard again', (now) => now.sound.calls > before);
    const { framesPerSecond, msPerTick, picture } = await stats(page);
    return `stream ${sound.stream.toFixed(2)} after ${sound.calls} calls; ${framesPerSecond.toFixed(0)} frames a second (${picture}), ${msPerTick.toFixed(1)} ms a tick`;
  });
}

async function withKeys({ test }, page) {
  await test('keys are the game’s, and the browser’s own stay away', async () => {
    await page.evaluate(() => {
      window.kept = [];
      addEventListener('keydown', (event) => window.kept.push([event.code, event.defaultPrevented]));
    });
    for (const key of ['Tab', 'Tab', 'Control+KeyS', 'Control+KeyZ', 'F1', 'Escape', 'Slash']) await page.keyboard.press(key);
    await page.keyboard.press('Space');
    await until(page, 'Space pauses', ({ paused }) => paused);
    await page.keyboard.press('Space');
    await until(page, 'Space goes on', ({ paused }) => !paused);
    const kept = await page.evaluate(() => window.kept.filter(([code]) => !code.startsWith('Control')));
    assert.ok(kept.length >= 9 && kept.every(([, prevented]) => prevented), JSON.stringify(kept));
    assert.equal(await page.evaluate(() => document.activeElement.id), 'world');
    assert.ok(!await page.evaluate(() => document.getElementById('world')
      .dispatchEvent(new MouseEvent('contextmenu', { cancelable: true }))), 'the context menu opens');
    const reload = await page.evaluate(() => document.body
      .dispatchEvent(new KeyboardEvent('keydown', { code: 'F5', cancelable: true, bubbles: true })));
    assert.ok(reload, 'F5 must stay the browser’s');
  });
}

async function byTheHook({ shoot, test }, page) {
  const refusal = (what) => page.evaluate((what) => {
    try {
      window.powderMaster[what[0]](...what.slice(1));
      return 'nothing';
    } catch (error) {
      return error.message;
    }
  }, what);

  await test('scenes by the hook and by link', async () => {
    await page.evaluate(() => window.powderMaster.scene('dam_break', { columns: 20 }));
    // 20 columns of 40.
    await until(page, 'the hook', ({ scene, elements }) => scene === 'dam_break' && elements.water === 800);
    assert.match(await refusal(['scene', 'nowhere']), /nowhere/);
    await follow(page, '#scene=communicating_vessels');
    await until(page, 'the link', ({ scene }) => scene === 'communicating_vessels');
    await shoot(page, 'desktop-vessels');
    await page.evaluate(() => window.powderMaster.pause());
    const { tick } = await until(page, 'the hook pauses', ({ paused }) => paused);
    await sleep(500);
    assert.equal((await stats(page)).tick, tick);
    await page.evaluate(() => window.powderMaster.pause(false));
    await until(page, 'it goes on', (now) => now.tick > tick);
  });

  await test('a link means the same at the start and later', async () => {
    const own = (await stats(page)).quality;
    assert.notEqual(own, 'fine');
    await follow(page, '#scene=dam_break&columns=20&quality=fine');
    await until(page, 'the quality of the link', ({ scene, quality }) => scene === 'dam_break' && quality === 'fine');
    await follow(page, '#scene=communicating_vessels');
    await until(page, 'the scene’s own quality', ({ scene, quality }) => scene === 'communicating_vessels' && quality === own);
  });

  await test('a bad link changes nothing and says why', async () => {
    await follow(page, '#scene=nowhere');
    const { messages, scene } = await until(page, 'a message', ({ messages }) => messages.some((text) => text.includes('nowhere')));
    assert.equal(scene, 'communicating_vessels');
    assert.ok(!messages.some((text) => text.includes('.ron')), 'a page has no files');
    await shoot(page, 'desktop-bad-link');
    await follow(page, '#scene=communicating_vessels');
  });

  await test('what can not be measured is refused', async () => {
    for (const ticks of [-1, 0.5, NaN, 1e12]) assert.match(await refusal(['measure', 'scene=empty', ticks]), /^ticks `.*: not a whole number/);
    assert.match(await refusal(['measure', 'scene=empty', 1, -1]), /^warmup/);
    assert.match(await refusal(['measure', 'scene=nowhere', 1]), /nowhere/);
    assert.equal(await refusal(['measure', 'scene=empty', 1]), 'nothing');
  });
}

async function asAWindow({ shoot, test }, page) {
  await test('the canvas follows the window', async () => {
    for (const [width, height] of [[700, 500], [1500, 900], [1280, 800]]) {
      await page.setViewportSize({ width, height });
      await page.waitForFunction(([w, h]) => {
        const canvas = document.getElementById('world');
        return canvas.width === Math.round(w * devicePixelRatio) && canvas.height === Math.round(h * devicePixelRatio);
      }, [width, height]);
    }
    await page.setViewportSize({ width: 700, height: 500 });
    const { frame } = await stats(page);
    await until(page, 'it is drawn', (now) => now.frame > frame + 2);
    await shoot(page, 'small-window');
    await page.setViewportSize({ width: 1280, height: 800 });
  });

  await test('a hidden tab pauses and comes back without a jump', async () => {
    const hide = (hidden) => page.evaluate((hidden) => {
      Object.defineProperty(document, 'hidden', { get: () => hidden, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
    await hide(true);
    const { tick } = await until(page, 'it stands', ({ rests }) => rests);
    await sleep(2000);
    assert.equal((await stats(page)).tick, tick, 'it went on');
    const back = Date.now();
    await hide(false);
    const now = await until(page, 'it goes on', (now) => now.tick > tick);
    const most = 60 * (Date.now() - back) / 1000 + 10;
    assert.ok(now.tick - tick <= most, `a jump of ${now.tick - tick} ticks, at most ${most} are due`);
    return `${now.tick - tick} ticks at the return`;
  });
}

async function withSaves({ openIn, shoot, shots, started, test }, page) {
  await test('a saved world outlives the page', async () => {
    await page.evaluate(() => window.powderMaster.scene('dam_break', { columns: 12 }));
    const { elements } = await until(page, 'a world to save', ({ scene }) => scene === 'dam_break');
    await page.keyboard.press('Control+KeyS');
    // One of each Ctrl+S of these tests.
    const kept = await untilKept(page, 2);
    await page.reload();
    await started(page);
    assert.equal((await stats(page)).scene, 'communicating_vessels', 'that of the link');
    await page.keyboard.press('Control+KeyO');
    await click(page, /^powder-dam_break-/);
    const now = await until(page, 'the saved world', ({ scene }) => scene === 'dam_break');
    assert.deepEqual(now.elements, elements);
    await shoot(page, 'desktop-loaded');
    return `${kept.length} files, ${now.particles} particles`;
  });

  await test('favourites outlive the page, in one file', async () => {
    const put = async (name, digit, told) => {
      await moveTo(page, await find(page, name));
      await page.keyboard.press(`Digit${digit}`);
      await until(page, told, ({ messages }) => messages.includes(told));
    };
    await page.keyboard.press('KeyE');
    await put('brine', 3, 'brine is on 3 now');
    await put('tar', 4, 'tar is on 4 now');
    await shoot(page, 'desktop-elements');
    const kept = await untilKept(page, 1, 'favourites.ron');
    assert.equal(kept.length, 1, 'the second file took the place of the first');
    await page.reload();
    await started(page);
    for (const [digit, element] of [[3, 'brine'], [4, 'tar']]) {
      await page.keyboard.press(`Digit${digit}`);
      await until(page, `${element} is on ${digit}`, ({ tool }) => tool === element);
    }
  });

  await test('a screenshot is a download', async () => {
    const download = page.waitForEvent('download');
    await page.keyboard.press('F2');
    const picture = await download;
    assert.match(picture.suggestedFilename(), /^powder-.*\.png$/);
    await picture.saveAs(join(shots, 'downloaded.png'));
  });

  await test('a screenshot that is dropped on the page brings its world, and a letter changes nothing', async () => {
    const { scene, particles } = await stats(page);
    await page.evaluate(() => window.powderMaster.scene('empty'));
    await until(page, 'another scene', (now) => now.scene === 'empty' && now.particles === 0);
    const drop = (name, bytes) => page.evaluate(([name, bytes]) => {
      const files = new DataTransfer();
      files.items.add(new File([new Uint8Array(bytes)], name));
      for (const kind of ['dragover', 'drop']) {
        dispatchEvent(new DragEvent(kind, { dataTransfer: files, bubbles: true, cancelable: true }));
        if (kind === 'dragover' && document.getElementById('drop').hidden) throw new Error('there is no hint');
      }
    }, [name, bytes]);
    await drop('letter.txt', [...Buffer.from('Dear Sir')]);
    await until(page, 'a line', ({ messages }) => messages.some((text) => text.startsWith('letter.txt: not a save file')));
    await drop('world.png', [...readFileSync(join(shots, 'downloaded.png'))]);
    const now = await until(page, 'the world of the picture', (now) => now.scene === scene);
    await page.keyboard.press('Control+KeyZ');
    await until(page, 'undo', (now) => now.scene === 'empty');
    return `${now.particles} particles, ${particles} when it was taken`;
  });

  await test('a link carries a small world, and a large one is told to be too large', async () => {
    await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    await page.evaluate(() => window.powderMaster.scene('dam_break', { columns: 12 }));
    await until(page, 'a small world', ({ scene, tick }) => scene === 'dam_break' && tick > 5);
    await still(page);
    await page.keyboard.press('Shift+F2');
    await until(page, 'it is copied', ({ messages }) => messages.some((text) => text.startsWith('Link copied')));
    const before = await stats(page);
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    assert.equal(copied, page.url());
    const other = await openIn(page.context(), copied);
    await started(other);
    const { elements, scene } = await stats(other);
    assert.deepEqual([elements, scene], [before.elements, before.scene]);
    await follow(other, '#world=AAAA');
    await until(other, 'a damaged link', ({ messages }) => messages.some((text) => text.startsWith('the link is damaged')));
    await other.close();
    await page.evaluate(() => window.powderMaster.scene('waterfall'));
    await until(page, 'a large world', ({ scene }) => scene === 'waterfall');
    await page.keyboard.press('Shift+F2');
    await until(page, 'it is refused', ({ messages }) => messages.some((text) => text.startsWith('Too large for a link')));
    await page.evaluate(() => window.powderMaster.pause(false));
    return `${copied.length} characters for ${before.particles} particles`;
  });

  await test('a screen reader hears messages, and the controls that keys go through', async () => {
    const heard = (text) => poll(`“${text}” is said`, () => page.evaluate(() => document.getElementById('spoken').innerText),
      (spoken) => spoken.includes(text));
    await page.keyboard.press('F8');
    await heard('the arrows move the pointer');
    await page.keyboard.press('Tab');
    const first = (await stats(page)).pointer;
    await poll('a control is said', () => page.evaluate(() => document.getElementById('spoken').lastElementChild.innerText),
      (text) => /button/i.test(text));
    await page.keyboard.press('Tab');
    await until(page, 'the pointer goes along', ({ pointer }) => pointer !== null && !near(pointer, first ?? [-1, -1]));
    await page.keyboard.press('F8');
    await heard('The arrows move the picture again');
  });

  await test('a key that is held runs the world back', async () => {
    await page.evaluate(() => window.powderMaster.scene('dam_break', { columns: 12 }));
    await until(page, 'half a second', ({ scene, tick }) => scene === 'dam_break' && tick > 30);
    await page.keyboard.down('Backspace');
    const back = await until(page, 'the way back', ({ rewinds, tick }) => rewinds && tick < 20);
    await page.keyboard.up('Backspace');
    await until(page, 'it goes on', ({ rewinds, tick }) => !rewinds && tick > back.tick);
  });
}

// Counts what the page asks WebGL to draw.
const countDraws = (page) => page.addInitScript(() => {
  window.draws = 0;
  for (const name of ['drawArrays', 'drawElements', 'drawArraysInstanced', 'drawElementsInstanced']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...rest) {
      window.draws += 1;
      return draw.apply(this, rest);
    };
  }
});

async function asleep({ host, play, test }) {
  await test('a paused page draws nothing, and hears the hook at once', async () => {
    const page = await play(`${host.url}#scene=waterfall`, {}, { before: countDraws });
    await still(page);
    const draws = () => page.evaluate(() => window.draws);
    // It looks after itself each ten seconds.
    let drawn = Infinity;
    for (let look = 0; look < 3 && drawn > 0; look += 1) {
      const before = await draws();
      assert.ok(before > 0);
      await sleep(5000);
      drawn = await draws() - before;
    }
    assert.equal(drawn, 0, 'calls to draw in five seconds');
    await page.evaluate(() => window.powderMaster.scene('dam_break'));
    await until(page, 'the hook', ({ scene }) => scene === 'dam_break', 4);
    assert.ok((await stats(page)).paused);
    await page.context().close();
  });
}

async function inGerman({ host, play, shoot, test }) {
  await test('a browser that asks for German gets it, and the page with it', async () => {
    const page = await play(`${host.url}#scene=empty`, { locale: 'de-AT' });
    const { messages } = await stats(page);
    assert.ok(messages.some((text) => text.startsWith('Linke Maustaste gießt')), `it says ${messages}`);
    const said = await page.evaluate(() => [document.documentElement.lang, document.getElementById('keys').textContent, document.getElementById('world').ariaLabel]);
    assert.deepEqual([said[0], said[2]], ['de', 'Die Welt von Powder Master']);
    assert.match(said[1], /Pfeiltasten/);
    await shoot(page, 'desktop-german');
    await page.context().close();
  });
}
