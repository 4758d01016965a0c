// Plays pages as a person would: opens them, looks at the picture, holds buttons, and waits for what is to come.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { difference, launch, serve } from './browser.mjs';

export const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

// A browser, a server of `dist/`, and what a test needs to play there.
export async function begin(builder, modules, shots) {
  const browser = await launch(modules);
  const host = await serve(builder);
  const eyes = await browser.newPage();
  const complaints = [];
  let passed = 0;

  // `before` gets the page before it loads. Errors in the console count against the test unless they are `expected`.
  async function open(url, options = {}, { before = () => {}, expected } = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
    return openIn(context, url, { before, expected });
  }

  async function openIn(context, url, { before = () => {}, expected } = {}) {
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);
    const note = (text) => expected?.test(text) || complaints.push(`${url}: ${text}`);
    // The game's own errors come as messages of another kind.
    const isError = (message) => message.type() === 'error' || message.text().startsWith('%cERROR');
    page.on('console', (message) => isError(message) && note(message.text()));
    page.on('pageerror', (error) => note(String(error)));
    page.on('crash', () => note('the page crashed'));
    await before(page);
    await page.goto(url);
    return page;
  }

  async function play(url, options, more) {
    const page = await open(url, options, more);
    await started(page);
    return page;
  }

  async function started(page) {
    await page.waitForFunction(() => window.powderMaster?.times.firstFrame);
    await until(page, 'frames', (now) => now.tick > 2);
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

  async function test(name, body) {
    const begun = Date.now();
    const told = await body();
    passed += 1;
    console.log(`ok: ${name}${told ? `: ${told}` : ''} (${((Date.now() - begun) / 1000).toFixed(1)} s)`);
  }

  async function end() {
    await browser.close();
    host.stop();
  }

  return {
    browser, complaints, end, eyes, host, modules, open, openIn, passed: () => passed, play, shoot, shootUntil, shots, started, test,
  };
}

export const stats = (page) => page.evaluate(() => window.powderMaster.stats());

export async function until(page, what, good, seconds = 60) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const now = await stats(page);
    if (good(now)) return now;
    assert.ok(Date.now() < end, `${what}: not within ${seconds} s: ${JSON.stringify(now)}`);
    await sleep(100);
  }
}

// Stops the world's time and waits until no message is shown any more, so that the picture keeps still.
export async function still(page) {
  await page.evaluate(() => window.powderMaster.pause());
  await until(page, 'a still picture', ({ paused, messages }) => paused && messages.length === 0);
}

// Opens what a link asks for by changing what stands behind the `#`.
export const follow = (page, link) => page.evaluate((link) => { location.hash = link; }, link);

// What the browser keeps: a list of { path, bytes }.
export const files = (page) => page.evaluate(() => new Promise((done) => {
  const opening = indexedDB.open('powder-master');
  opening.onsuccess = () => {
    const asked = opening.result.transaction('files').objectStore('files').getAll();
    asked.onsuccess = () => done(asked.result.map(({ path, bytes }) => ({ path, bytes: bytes.length })));
  };
}));

export async function untilKept(page, count) {
  for (const end = Date.now() + 30_000; ;) {
    const kept = await files(page);
    if (kept.length >= count) return kept;
    assert.ok(Date.now() < end, `the browser keeps ${kept.length} files instead of ${count}`);
    await sleep(100);
  }
}

// Holds a button on the way along the given points.
export async function drag(page, points, button = 'left', pause = 100) {
  await page.mouse.move(...points[0]);
  await page.mouse.down({ button });
  for (const point of points) {
    await page.mouse.move(...point, { steps: 4 });
    await sleep(pause);
  }
  await page.mouse.up({ button });
}
