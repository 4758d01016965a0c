// The game in a window of its own X server: mouse and keys by xdotool, what the game says by its hook (docs/scripts.md).

import assert from 'node:assert/strict';
import { execFile, execFileSync, spawn } from 'node:child_process';
import { mkdirSync, openSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { promisify } from 'node:util';
import { middle, near, poll, pressable } from '../poll.mjs';

const WIDTH = 1280;
const HEIGHT = 800;
const run = promisify(execFile);

// An X server of which nobody else knows.
export async function display() {
  const server = spawn('Xvfb', ['-displayfd', '3', '-screen', '0', `${WIDTH}x${HEIGHT}x24`], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe'],
  });
  const number = await new Promise((found, failed) => {
    server.stdio[3].once('data', (data) => found(String(data).trim()));
    server.once('error', failed);
    server.once('exit', (code) => failed(new Error(`Xvfb ended with ${code}`)));
  });
  return { name: `:${number}`, stop: () => server.kill() };
}

// Has the game that is opened with `folder` draw so much of the picture, however long its frames take.
export function keepLevel(folder, level) {
  const kept = join(folder, 'data', 'powder-master');
  mkdirSync(kept, { recursive: true });
  writeFileSync(join(kept, 'settings.ron'), `(picture: Some(${level[0].toUpperCase()}${level.slice(1)}))`);
}

// Opens the game with a scene, or with `[]` as a player does who names none; its files and its log go to `folder`.
export async function open(program, display, folder, scene = ['empty']) {
  // The names of what is pressed are looked for in English.
  const { WAYLAND_DISPLAY, LANGUAGE, ...rest } = process.env;
  const env = { ...rest, LC_ALL: 'C', DISPLAY: display, XDG_DATA_HOME: join(folder, 'data') };
  const log = openSync(join(folder, 'log'), 'a');
  const child = spawn(program, ['play', ...scene, '--hook'], { cwd: folder, env, stdio: ['pipe', 'pipe', log] });
  const ended = new Promise((done) => child.once('exit', (code, signal) => done(signal ?? code)));
  child.stdin.on('error', () => {});
  const answers = createInterface({ input: child.stdout })[Symbol.asyncIterator]();

  async function ask(words) {
    child.stdin.write(`${words}\n`);
    const { value, done } = await answers.next();
    assert.ok(!done, 'the game ended by itself');
    return JSON.parse(value);
  }

  const x = (...words) => run('xdotool', words.map(String), { env });
  const stats = () => ask('stats');
  const widgets = () => ask('widgets');
  const until = (what, good) => poll(what, stats, (now) => now !== null && good(now));
  const untilWidgets = (what, good) => poll(what, widgets, good);

  await until('the first frame', ({ frame }) => frame > 0);
  const window = (await x('search', '--sync', '--onlyvisible', '--name', 'Powder Master')).stdout.split('\n')[0];
  // Without a window manager nobody gives it the keyboard.
  const focus = () => x('windowfocus', '--sync', window);
  await focus();

  // Moves the pointer, and waits until the game knows.
  async function move(to) {
    await x('mousemove', ...to);
    await until(`the pointer at ${to}`, ({ pointer }) => pointer !== null && near(pointer, to));
  }

  // Waits until the game has drawn more frames.
  async function frames(count) {
    const { frame } = await stats();
    await until('the next frames', (now) => now.frame > frame + count);
  }

  // Waits a few frames: what one frame changes, the next ones make room for.
  const settle = () => frames(3);

  // Points at what has this name. What moves is followed until it keeps still.
  async function hover(name) {
    const seen = await untilWidgets(`something to press called ${name}`, (all) => pressable(all, name) !== undefined);
    for (let at = middle(pressable(seen, name)); ;) {
      await move(at);
      await settle();
      const now = pressable(await widgets(), name);
      assert.ok(now, `${name} went away under the pointer`);
      if (middle(now).join() === at.join()) break;
      at = middle(now);
    }
  }

  // Presses a button for a frame or two, as a finger does: what moves in the same frame is not pressed, and what is held for longer
  // than 0.8 s, which are few frames of a slow machine, is no click.
  async function tap(button) {
    await x('mousedown', button);
    await frames(1);
    await x('mouseup', button);
  }

  // Presses what has this name.
  async function click(name) {
    await hover(name);
    await tap(1);
  }

  // Holds a button and goes round along the points until the game says that it is enough.
  async function drag(button, points, what, good) {
    await move(points[0]);
    await x('mousedown', button);
    let turn = 0;
    await poll(what, async () => {
      turn += 1;
      await move(points[turn % points.length]);
      return stats();
    }, good);
    await x('mouseup', button);
    return stats();
  }

  return {
    click,
    tap,
    drag,
    focus,
    hover,
    move,
    stats,
    until,
    untilWidgets,
    widgets,
    key: (name) => x('key', name),
    press: (name) => x('keydown', name),
    letGo: (name) => x('keyup', name),
    // Makes the window another size; unless it shall not wait, until the X server has it so.
    async resize(size, wait = true) {
      await x('windowsize', window, ...size);
      const has = async () => (await x('getwindowgeometry', '--shell', window)).stdout;
      const wanted = ([width, height]) => new RegExp(`WIDTH=${width}\nHEIGHT=${height}\n`);
      if (wait) await poll(`a window of ${size}`, has, (now) => wanted(size).test(now));
    },
    hide: () => x('windowunmap', '--sync', window),
    show: () => x('windowmap', '--sync', window),
    tell: ask,
    // One way along the points with a button held.
    async stroke(button, points) {
      await move(points[0]);
      await x('mousedown', button);
      for (const point of points.slice(1)) await move(point);
      await x('mouseup', button);
    },
    // What the window shows.
    async picture(name) {
      const file = join(folder, `${name}.png`);
      await run('import', ['-silent', '-window', 'root', file], { env });
      return execFileSync('convert', [file, '-depth', '8', 'rgb:-'], { maxBuffer: 1 << 26 });
    },
    async kill(signal = 'SIGTERM') {
      child.kill(signal);
      return ended;
    },
  };
}

// Calls `each` with red, green and blue of each pixel of a part of a picture.
function pixels(picture, { x, y, width, height }, each) {
  for (let row = y; row < y + height; row += 1) {
    for (let k = 3 * (row * WIDTH + x), end = k + 3 * width; k < end; k += 3) each(k, picture[k], picture[k + 1], picture[k + 2]);
  }
}

// The world, without the bars.
export const WORLD = { x: 0, y: 60, width: WIDTH, height: HEIGHT - 140 };

// Whether the game has drawn the lower right corner of a window of this size: the server leaves it black.
export function isDrawn(picture, [width, height]) {
  const k = 3 * ((height - 2) * WIDTH + width - 2);
  return picture[k] + picture[k + 1] + picture[k + 2] > 0;
}

// Share of the world's pixels that differ visibly, in percent.
export function difference(one, other) {
  let differ = 0;
  pixels(one, WORLD, (k) => {
    if ([0, 1, 2].some((c) => Math.abs(one[k + c] - other[k + c]) > 15)) differ += 1;
  });
  return 100 * differ / (WORLD.width * WORLD.height);
}

function count(picture, part, isIt) {
  let found = 0;
  pixels(picture, part, (_, ...colour) => {
    if (isIt(...colour)) found += 1;
  });
  return found;
}

// Pixels of a part of a picture that are blue, as water is.
export const water = (picture, part) => count(picture, part, (red, green, blue) => blue > 120 && blue > 1.5 * red);

// Pixels of the pink that only theory is drawn in.
export const theory = (picture, part) => count(picture, part, (red, green, blue) => red > 200 && blue > 150 && green < 160);
