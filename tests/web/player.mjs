// Plays pages as a person would: opens them, looks at the picture, holds buttons, and waits for what is to come.

import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { middle, near, poll, pressable, sleep } from '../poll.mjs';
import { difference, launch, serve, water } from './browser.mjs';

// A browser, a server of `dist/`, and what a test needs to play there.
export async function begin(builder, modules, shots) {
  const browser = await launch(modules);
  const host = await serve(builder);
  const eyes = await browser.newPage();
  const complaints = [];
  let passed = 0;

  // `before` gets the page before it loads. Errors in the console count against the test unless they are `expected`.
  async function open(url, options = {}, { before = () => {}, expected } = {}) {
    // The names of what is pressed are looked for in English.
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, locale: 'en-GB', ...options });
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

  // A browser on a machine with much else to do refuses a picture now and then, and gives the next.
  async function capture(page, tries = 5) {
    try {
      return await page.screenshot({ timeout: 120_000 });
    } catch (error) {
      if (tries <= 1 || !error.message.includes('Unable to capture screenshot')) throw error;
      await sleep(1000);
      return capture(page, tries - 1);
    }
  }

  async function shoot(page, name) {
    const picture = await capture(page);
    writeFileSync(join(shots, `${name}.png`), picture);
    return picture;
  }

  // Shoots until `good` holds for the share, in %, of the picture that differs from `before`.
  const shootUntil = (page, name, before, good) => poll(
    `${name}: % of the picture that differs`, async () => difference(eyes, before, await shoot(page, name)), good);

  // Shoots until `good` holds for the pixels of water in a part of the picture.
  const waterUntil = (page, name, part, good) => poll(
    `${name}: pixels of water`, async () => water(eyes, await shoot(page, name), part), good);

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
    waterUntil,
  };
}

export const stats = (page) => page.evaluate(() => window.powderMaster.stats());

export const until = (page, what, good) => poll(what, () => stats(page), (now) => now !== null && good(now));

export const untilWidgets = (page, what, good) => poll(what, () => page.evaluate(() => window.powderMaster.widgets()), good);

// Where something is that can be pressed, when it has come to keep still.
export async function find(page, name) {
  for (let before = ''; ;) {
    const seen = await untilWidgets(page, `something to press called ${name}`, (all) => pressable(all, name) !== undefined);
    const at = middle(pressable(seen, name));
    if (at.join() === before) return at;
    before = at.join();
    const { frame } = await stats(page);
    await until(page, 'the next frame', (now) => now.frame > frame || now.rests);
  }
}

export async function click(page, name) {
  const at = await find(page, name);
  await moveTo(page, at);
  await page.mouse.down();
  await page.mouse.up();
}

// Moves the pointer, and waits until the game knows.
export async function moveTo(page, to) {
  await page.mouse.move(...to, { steps: 4 });
  await until(page, `the pointer at ${to}`, ({ pointer }) => pointer !== null && near(pointer, to));
}

// Stops the world's time and waits until nothing changes any more, so that the picture keeps still.
export async function still(page) {
  await page.evaluate(() => window.powderMaster.pause());
  await until(page, 'a still picture', ({ paused, rests }) => paused && rests);
}

// Opens what a link asks for by changing what stands behind the `#`.
export const follow = (page, link) => page.evaluate((link) => { location.hash = link; }, link);

// What the browser keeps: a list of { path, bytes }.
// The files that the browser keeps whose names end so: saved worlds, unless it is said otherwise.
export const files = (page, ending = '.pms') => page.evaluate((ending) => new Promise((done) => {
  const opening = indexedDB.open('powder-master');
  opening.onsuccess = () => {
    const asked = opening.result.transaction('files').objectStore('files').getAll();
    const named = () => asked.result.filter(({ path }) => path.endsWith(ending));
    asked.onsuccess = () => done(named().map(({ path, bytes }) => ({ path, bytes: bytes.length })));
  };
}), ending);

export const untilKept = (page, count, ending) => poll(
  `${count} files that the browser keeps`, () => files(page, ending), ({ length }) => length >= count);

// Holds the left button on a way that takes a moment, as a hand does it, however slow the frames are: the speed counts.
export async function flick(page, from, to) {
  await moveTo(page, from);
  await page.mouse.down();
  await moveTo(page, to);
  await page.mouse.up();
}

// Holds a button and goes round along the points until the game says that it is enough.
export async function dragUntil(page, points, what, good, button = 'left') {
  await moveTo(page, points[0]);
  await page.mouse.down({ button });
  let turn = 0;
  await poll(what, async () => {
    turn += 1;
    await moveTo(page, points[turn % points.length]);
    return stats(page);
  }, good);
  await page.mouse.up({ button });
  return stats(page);
}
