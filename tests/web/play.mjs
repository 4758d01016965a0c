// Plays the page in a real headless Chromium as a person would, with mouse, keys and fingers, and looks at the picture.
// Usage: node tests/web/play.mjs WEB-BUILD-PROGRAM NODE-MODULES FOLDER-FOR-SCREENSHOTS [ONE-PART]

import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { difference, launch, plainHost, serve, water } from './browser.mjs';

const [builder, modules, shots] = process.argv.slice(2);
mkdirSync(shots, { recursive: true });

const wanted = process.argv[5];
const browser = await launch(modules);
const host = await serve(builder);
const eyes = await browser.newPage();
const complaints = [];
let passed = 0;

const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

async function open(url, options = {}, before = () => {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(120_000);
  const note = (text) => complaints.push(`${url}: ${text}`);
  page.on('console', (message) => message.type() === 'error' && note(message.text()));
  page.on('pageerror', (error) => note(error));
  page.on('crash', () => note('the page crashed'));
  await before(page);
  await page.goto(url);
  return page;
}

async function play(url, options) {
  const page = await open(url, options);
  await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
  await until(page, 'frames', (stats) => stats.tick > 2);
  return page;
}

const stats = (page) => page.evaluate(() => window.powderMaster.stats());

async function until(page, what, good, seconds = 60) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const now = await stats(page);
    if (good(now)) return now;
    assert.ok(Date.now() < end, `${what}: not within ${seconds} s: ${JSON.stringify(now)}`);
    await sleep(100);
  }
}

async function shoot(page, name) {
  const picture = await page.screenshot({ timeout: 120_000 });
  writeFileSync(join(shots, `${name}.png`), picture);
  return picture;
}

// Shoots until `good` holds for the share, in %, of the picture that differs from `before`.
async function shootUntil(page, name, before, good, seconds = 30) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const share = await difference(eyes, before, await shoot(page, name));
    if (good(share)) return share;
    assert.ok(Date.now() < end, `${name}: ${share} % of the picture differs after ${seconds} s`);
  }
}

// Holds a button on the way along the given points.
async function drag(page, points, button = 'left', pause = 100) {
  await page.mouse.move(...points[0]);
  await page.mouse.down({ button });
  for (const point of points) {
    await page.mouse.move(...point, { steps: 4 });
    await sleep(pause);
  }
  await page.mouse.up({ button });
}

async function test(name, body) {
  const begun = Date.now();
  const told = await body();
  passed += 1;
  console.log(`ok: ${name}${told ? `: ${told}` : ''} (${((Date.now() - begun) / 1000).toFixed(1)} s)`);
}

async function onADesktop() {
  const page = await play(`${host.url}#scene=empty`);
  let picture;
  await test('the page loads, isolated, with a thread for each processor', async () => {
    const now = await stats(page);
    assert.equal(now.scene, 'empty');
    assert.equal(now.particles, 0);
    const [isolated, processors] = await page.evaluate(() => [crossOriginIsolated, navigator.hardwareConcurrency]);
    assert.ok(isolated);
    assert.equal(now.threads, Math.min(processors, 8));
    picture = await shoot(page, 'desktop-empty');
    const times = await page.evaluate(() => window.powderMaster.times);
    return `${now.threads} threads, ${Math.round(times.firstFrame - times.lastByte)} ms from the last byte to the first frame`;
  });

  await test('the left button pours', async () => {
    await drag(page, [[560, 420], [640, 440], [720, 420], [640, 400], [560, 420], [640, 440], [720, 420]]);
    const now = await until(page, 'pouring', ({ particles, elements }) => particles > 50 && elements.water === particles);
    const share = await shootUntil(page, 'desktop-poured', picture, (share) => share > 0.2);
    return `${now.particles} particles, ${share.toFixed(2)} % of the picture changed`;
  });

  await test('wind blows the water away', async () => {
    await page.mouse.move(640, 120);
    await sleep(8000);
    const floor = { x: 40, y: 690, width: 360, height: 40 };
    const calm = await water(eyes, await shoot(page, 'desktop-calm'), floor);
    await page.keyboard.press('KeyW');
    let windy = calm;
    for (let gust = 0; gust < 20 && 4 * windy >= 3 * calm; gust += 1) {
      await drag(page, [[50, 715], [130, 715], [210, 715], [290, 715], [370, 715], [450, 715], [530, 715]], 'left', 40);
      windy = await water(eyes, await shoot(page, 'desktop-windy'), floor);
    }
    assert.ok(calm > 500 && 4 * windy < 3 * calm, `water on ${windy} pixels of the floor, ${calm} before`);
    return `water on ${windy} pixels of the floor, ${calm} before`;
  });

  await test('the right button erases', async () => {
    const before = (await stats(page)).particles;
    const way = [60, 200, 350, 500, 650, 800, 950, 1100, 1230].map((x) => [x, 715]);
    await drag(page, way, 'right');
    const now = await until(page, 'erasing', ({ particles }) => particles < before);
    return `${now.particles} particles, ${before} before`;
  });

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

  await test('scenes by the hook and by link', async () => {
    await page.evaluate(() => window.powderMaster.scene('dam_break', { columns: 20 }));
    // 20 columns of 40.
    await until(page, 'the hook', ({ scene, elements }) => scene === 'dam_break' && elements.water === 800);
    const wrong = await page.evaluate(() => {
      try {
        window.powderMaster.scene('nowhere');
        return 'nothing';
      } catch (error) {
        return error.message;
      }
    });
    assert.match(wrong, /nowhere/);
    await page.evaluate(() => { location.hash = '#scene=communicating_vessels'; });
    await until(page, 'the link', ({ scene }) => scene === 'communicating_vessels');
    await shoot(page, 'desktop-vessels');
    await page.evaluate(() => window.powderMaster.pause());
    const { tick } = await until(page, 'the hook pauses', ({ paused }) => paused);
    await sleep(500);
    assert.equal((await stats(page)).tick, tick);
    await page.evaluate(() => window.powderMaster.pause(false));
    await until(page, 'it goes on', (now) => now.tick > tick);
  });

  await test('the canvas follows the window', async () => {
    for (const [width, height] of [[700, 500], [1500, 900], [1280, 800]]) {
      await page.setViewportSize({ width, height });
      await page.waitForFunction(([w, h]) => {
        const canvas = document.getElementById('world');
        return canvas.width === Math.round(w * devicePixelRatio) && canvas.height === Math.round(h * devicePixelRatio);
      }, [width, height]);
    }
    await page.setViewportSize({ width: 700, height: 500 });
    await sleep(2000);
    await shoot(page, 'small-window');
    await page.setViewportSize({ width: 1280, height: 800 });
  });

  await test('a hidden tab pauses and comes back without a jump', async () => {
    const hide = (hidden) => page.evaluate((hidden) => {
      Object.defineProperty(document, 'hidden', { get: () => hidden, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
    await hide(true);
    await sleep(2000);
    const { tick } = await stats(page);
    await sleep(2000);
    assert.equal((await stats(page)).tick, tick, 'it went on');
    const back = Date.now();
    await hide(false);
    const now = await until(page, 'it goes on', (now) => now.tick > tick);
    const most = 60 * (Date.now() - back) / 1000 + 10;
    assert.ok(now.tick - tick <= most, `a jump of ${now.tick - tick} ticks, at most ${most} are due`);
    return `${now.tick - tick} ticks at the return`;
  });

  await test('a saved world outlives the page', async () => {
    await page.keyboard.press('Control+KeyS');
    const count = () => page.evaluate(() => new Promise((done) => {
      const opening = indexedDB.open('powder-master');
      opening.onsuccess = () => {
        const asked = opening.result.transaction('files').objectStore('files').count();
        asked.onsuccess = () => done(asked.result);
      };
    }));
    let saved = 0;
    for (const end = Date.now() + 30_000; saved < 2; saved = await count()) {
      assert.ok(Date.now() < end, `${saved} files: one of each Ctrl+S`);
      await sleep(100);
    }
    await page.reload();
    await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
    await until(page, 'frames', (now) => now.tick > 2);
    await page.keyboard.press('Control+KeyO');
    await sleep(3000);
    await shoot(page, 'desktop-saves');
    const download = page.waitForEvent('download');
    await page.keyboard.press('F2');
    const picture = await download;
    assert.match(picture.suggestedFilename(), /^powder-.*\.png$/);
    await picture.saveAs(join(shots, 'downloaded.png'));
    return `${saved} files, and a screenshot as a download`;
  });
  await page.context().close();
}

async function onAPhone() {
  const page = await play(`${host.url}#scene=empty`, {
    viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true,
  });
  const devtools = await page.context().newCDPSession(page);
  const touch = (type, ...points) => devtools.send('Input.dispatchTouchEvent', {
    type, touchPoints: points.map(([x, y], id) => ({ x, y, id })),
  });
  await test('the canvas of a phone fills its screen', async () => {
    const size = await page.evaluate(() => ['width', 'height'].map((side) => document.getElementById('world')[side]));
    assert.deepEqual(size, [390, 844]);
    await shoot(page, 'phone-empty');
  });
  await test('one finger draws', async () => {
    await touch('touchStart', [120, 300]);
    for (let x = 120; x <= 280; x += 8) {
      await touch('touchMove', [x, 300]);
      await sleep(40);
    }
    await touch('touchEnd');
    const now = await until(page, 'drawing', ({ particles }) => particles > 30);
    await sleep(1500);
    await shoot(page, 'phone-drawn');
    return `${now.particles} particles`;
  });
  await test('two fingers zoom and draw nothing', async () => {
    const before = (await stats(page)).particles;
    const first = await shoot(page, 'phone-before-zoom');
    await touch('touchStart', [180, 300], [210, 300]);
    for (let half = 15; half <= 120; half += 7) {
      await touch('touchMove', [195 - half, 300], [195 + half, 300]);
      await sleep(40);
    }
    await touch('touchEnd');
    const share = await shootUntil(page, 'phone-zoomed', first, (share) => share > 0.5);
    assert.equal((await stats(page)).particles, before);
    return `${share.toFixed(1)} % of the picture changed`;
  });
  await test('the tool bar hides and comes back', async () => {
    const tap = async (x, y) => {
      await touch('touchStart', [x, y]);
      await sleep(150);
      await touch('touchEnd');
    };
    // Water that still settles would differ by itself.
    await page.evaluate(() => window.powderMaster.pause());
    await until(page, 'the hook pauses', ({ paused }) => paused);
    await sleep(1500);
    const before = await shoot(page, 'phone-tools');
    await tap(28, 844 - 28);
    const hidden = await shootUntil(page, 'phone-no-tools', before, (share) => share > 5);
    await tap(390 - 30, 844 - 30);
    const again = await shootUntil(page, 'phone-tools-again', before, (share) => share < 0.5);
    // Undo is the fourth button: what the finger drew goes.
    await tap(4 + 3 * 52 + 24, 844 - 28);
    await until(page, 'undo', ({ particles }) => particles === 0);
    return `${hidden.toFixed(1)} % of the picture gone, all but ${again.toFixed(1)} % back`;
  });
  await page.context().close();
}

// An emulated density changes what a page is told, not how large its pixels are: this one is the browser's own.
async function onADenseScreen() {
  const dense = await launch(modules, ['--force-device-scale-factor=2', '--window-size=700,500']);
  try {
    await test('a dense screen has all its pixels', async () => {
      const page = await (await dense.newContext({ viewport: null })).newPage();
      await page.goto(`${host.url}#scene=communicating_vessels`);
      await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
      const [ratio, ...sizes] = await page.evaluate(() => {
        const { width, height } = document.getElementById('world');
        return [devicePixelRatio, width, height, innerWidth * devicePixelRatio, innerHeight * devicePixelRatio];
      });
      assert.equal(ratio, 2);
      assert.deepEqual(sizes.slice(0, 2), sizes.slice(2));
      await sleep(2000);
      await shoot(page, 'dense-screen');
      return `${sizes[0]} × ${sizes[1]} pixels`;
    });
  } finally {
    await dense.close();
  }
}

async function onAPlainHost() {
  const plain = await plainHost('dist');
  await test('a plain host, without service workers: one thread', async () => {
    const page = await play(`${plain.url}#scene=dam_break&columns=20`, { serviceWorkers: 'block' });
    const now = await stats(page);
    assert.deepEqual([now.scene, now.threads], ['dam_break', 1]);
    assert.equal(await page.evaluate(() => crossOriginIsolated), false);
    await page.context().close();
  });
  await test('a plain host, under a sub-path: threads by the service worker, then offline', async () => {
    const page = await play(`${plain.url}#scene=empty`);
    assert.equal(await page.evaluate(() => crossOriginIsolated), true);
    const { threads } = await stats(page);
    assert.ok(threads > 1, `${threads} thread`);
    await page.waitForFunction(() => window.powderMaster.offline);
    await plain.stop();
    await page.reload();
    await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
    await until(page, 'frames without a network', (now) => now.scene === 'empty' && now.tick > 2);
    await page.context().close();
  });
}

async function whereItCanNot() {
  await test('without WebGL 2 the page says what to do', async () => {
    const page = await open(host.url, {}, (page) => page.addInitScript(() => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : get.call(this, kind, ...rest);
      };
    }));
    await page.waitForSelector('#advice li');
    assert.match(await page.textContent('#state'), /WebGL 2/);
    await shoot(page, 'no-webgl');
    await page.context().close();
  });
  await test('a bad link plays the default scene and says why', async () => {
    const page = await play(`${host.url}#scene=nowhere`);
    assert.equal((await stats(page)).scene, 'waterfall');
    await shoot(page, 'bad-link');
    await page.context().close();
  });
}

const all = { onADesktop, onAPhone, onADenseScreen, onAPlainHost, whereItCanNot };
const parts = Object.values(all).filter((part) => !wanted || part.name === wanted);
try {
  for (const part of parts) await part();
  assert.deepEqual(complaints, [], 'the console has errors');
  console.log(`${passed} passed, 0 failed; screenshots in ${shots}`);
} catch (error) {
  console.error(`FAILED after ${passed} passed: ${error.stack}\nconsole: ${complaints.join('\n')}\nscreenshots in ${shots}`);
  process.exitCode = 1;
} finally {
  await browser.close();
  host.stop();
}
