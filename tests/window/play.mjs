// Plays the game in a real window as a person would, with mouse and keys, and looks at what the window shows and what the
// game says. Usage: node tests/window/play.mjs PATH-OF-powder-master [FOLDER-FOR-SCREENSHOTS]
// Needs Xvfb, xdotool, import and convert (ImageMagick) and a Vulkan or OpenGL driver (Mesa's software one will do).

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { isOpen, near, poll } from '../poll.mjs';
import { difference, display, open, theory, water, WORLD } from './game.mjs';
import { resizeWhileLate } from './late.mjs';

const program = resolve(process.argv[2]);
const folder = resolve(process.argv[3] ?? 'target/window-test');
// What the game writes goes there, too, and what an earlier test has left is no business of this one.
rmSync(folder, { recursive: true, force: true });
// A hint that comes up would be part of the pictures.
mkdirSync(join(folder, 'data', 'powder-master'), { recursive: true });
writeFileSync(join(folder, 'data', 'powder-master', 'hints.ron'), '(on: false, seen: [])');

const FLOOR = { x: 40, y: 690, width: 360, height: 40 };
const HIGH = [[560, 420], [600, 430], [640, 440], [680, 430], [720, 420], [680, 410], [640, 420], [600, 410]];
const LOW = [200, 350, 500, 650, 800, 950, 1100, 1230].map((x) => [x, 715]);
const GUST = [50, 130, 210, 290, 370, 450, 530].map((x) => [x, 715]);

const screen = await display();
let game;
let passed = 0;

async function test(name, body) {
  const begun = Date.now();
  let told;
  try {
    told = await body();
  } catch (error) {
    throw new Error(`${name}: ${error.message}`, { cause: error });
  }
  passed += 1;
  console.log(`ok: ${name}${told ? `: ${told}` : ''} (${((Date.now() - begun) / 1000).toFixed(1)} s)`);
}

const begin = async (scene) => { game = await open(program, screen.name, folder, scene); };
const quiet = () => game.until('no message is shown', ({ messages }) => messages.length === 0);
const pour = (least) => game.drag(1, HIGH, `${least} particles of water`, ({ particles }) => particles >= least);

async function play() {
  let empty;
  await test('an empty scene is empty', async () => {
    await begin();
    const { particles, scene } = await quiet();
    assert.deepEqual([scene, particles], ['empty', 0]);
    empty = await game.picture('empty');
    // The ring of the brush is of the element's colour: 40 pixels across and at most 2 wide, so at most 252 of them.
    const blue = water(empty, WORLD);
    assert.ok(blue <= 252, `${blue} pixels of an empty world are of water`);
  });

  await test('the left button pours', async () => {
    const { particles } = await pour(400);
    const picture = await game.picture('poured');
    assert.ok(water(picture, WORLD) > 500, `${particles} particles are ${water(picture, WORLD)} pixels of water`);
    return `${particles} particles, ${water(picture, WORLD)} pixels of water`;
  });

  await test('wind drives the water away', async () => {
    await game.move([640, 120]);
    let before = 0;
    // Until what falls lies on the floor: it is looked at once in a second of the world's time. Small waves go on for
    // long; a tenth is less than half of what the wind has to take, so that they can't be taken for its doing.
    const calm = await poll('water lies on the floor', async () => {
      const { tick } = await game.stats();
      await game.until('a second of the world', (now) => now.tick >= tick + 60);
      const lies = water(await game.picture('calm'), FLOOR);
      const seen = { lies, settled: lies > 500 && Math.abs(lies - before) < 0.1 * lies };
      before = lies;
      return seen;
    }, ({ settled }) => settled);
    await game.key('w');
    await game.until('the tool is wind', ({ tool }) => tool === 'wind');
    let gusts = 0;
    const windy = await poll('a quarter of the water has gone from the left of the floor', async () => {
      gusts += 1;
      await game.stroke(1, GUST);
      return water(await game.picture('windy'), FLOOR);
    }, (lies) => 4 * lies < 3 * calm.lies);
    return `water on ${windy} pixels of the floor after ${gusts} gusts, ${calm.lies} before`;
  });

  await test('less of the picture is drawn when one wants', async () => {
    const frames = async (level) => {
      await game.click(level);
      await game.until(`the picture is ${level}`, ({ picture }) => picture === level);
      const { tick } = await game.stats();
      const now = await game.until('two seconds of it', (now) => now.tick >= tick + 120);
      return `${level} ${now.framesPerSecond.toFixed(0)} frames a second`;
    };
    await game.key('F4');
    await game.untilWidgets('the settings', (all) => isOpen(all, 'Settings'));
    const told = [await frames('full'), await frames('plain')];
    const picture = await game.picture('plain');
    assert.ok(water(picture, WORLD) > 500, 'there is no water in it');
    await game.key('F4');
    return told.join(', ');
  });

  await test('the right button erases', async () => {
    const { particles } = await game.stats();
    const now = await game.drag(3, LOW, `fewer than ${particles} particles`, (now) => now.particles < particles);
    await game.picture('erased');
    return `${now.particles} particles, ${particles} before`;
  });

  await test('the accuracy panel measures a curve by itself and when asked, and a click on it chooses a quality', async () => {
    await game.key('2');
    await game.until('the tool is water', ({ tool }) => tool === 'water');
    // Single drops have no density.
    await pour((await game.stats()).particles + 800);
    await game.key('a');
    await game.untilWidgets('the panel is open', (all) => isOpen(all, 'Accuracy'));
    const others = (all) => all.filter(({ name, chosen }) => name.endsWith(' on the curve') && chosen === false);
    const measured = (all) => others(all).length >= 3 && all.some(({ name }) => name === 'Measure here');
    await game.untilWidgets('a curve that nobody asked for', measured);
    await game.click('Measure here');
    await game.untilWidgets('a survey', (all) => all.some(({ name }) => name === 'cancel'));
    await game.untilWidgets('a curve of the survey', measured);
    // While time stands, the point of the world keeps still, and with it the curve.
    await game.key('space');
    await game.until('it stands', ({ paused }) => paused);
    const [{ name }] = others(await game.widgets()).filter(({ place }, _, all) => all.every((other) => other.place === place || apart(place, other.place)));
    await game.click(name);
    const quality = name.split(' ')[0];
    await game.until(`a click on ${name} chooses ${quality}`, (now) => now.quality === quality);
    await game.picture('accuracy');
    await game.key('space');
    await game.until('it goes on', ({ paused }) => !paused);
    return `${quality} is chosen`;
  });

  await test('two qualities side by side', async () => {
    await game.key('a');
    await game.untilWidgets('the panel is closed', (all) => !isOpen(all, 'Accuracy'));
    const before = await game.picture('before-split');
    await game.key('b');
    const corners = ['quality of A', 'quality of B'];
    const all = await game.untilWidgets('there is a split', (now) => corners.every((name) => now.some((widget) => widget.name === name)));
    const sides = corners.map((name) => {
      const [x, y] = all.find((widget) => widget.name === name).place.map(Math.round);
      return { x, y: y + 30, width: 550, height: 308 };
    });
    // One world alone could have water in both places, but looks as it did before.
    const { pixels } = await poll('water in both worlds', async () => {
      const picture = await game.picture('split');
      return { changed: difference(before, picture), pixels: sides.map((side) => water(picture, side)) };
    }, (seen) => seen.changed > 20 && seen.pixels.every((count) => count > 100));
    await game.key('b');
    await game.untilWidgets('the split is gone', (now) => !corners.some((name) => now.some((widget) => widget.name === name)));
    return `${pixels.join(' and ')} pixels of water`;
  });

  await test('R begins the scene again', async () => {
    await game.key('r');
    await game.until('an empty scene', ({ particles }) => particles === 0);
  });

  await test('a temperature that is set boils water, and a match lights oil', async () => {
    await pour(200);
    await game.key('c');
    await game.untilWidgets('its temperature can be chosen', (all) => all.some(({ name }) => name === 'temperature to set'));
    await game.drag(1, HIGH.concat(LOW), 'water boils', ({ elements }) => elements.steam > 20);
    await game.key('r');
    await game.until('an empty scene', ({ particles }) => particles === 0);
    await game.key('4');
    await game.untilWidgets('oil has no temperature to choose', (all) => !all.some(({ name }) => name === 'temperature to set'));
    await game.drag(1, HIGH, 'oil', ({ elements }) => elements.oil >= 200);
    await game.key('shift+8');
    await poll('cold oil is blue in the view', async () => water(await game.picture('fuel'), WORLD), (blue) => blue > 300);
    await game.key('i');
    await game.drag(1, HIGH.concat(LOW), 'oil burns', ({ elements }) => elements.fire > 20);
    await game.picture('burning');
    await game.key('shift+1');
    await game.key('r');
    await game.until('an empty scene again', ({ particles }) => particles === 0);
    await game.key('2');
    await game.until('the tool is water', ({ tool }) => tool === 'water');
  });

  await test('tiles and buttons do what they are called', async () => {
    await game.click('rock');
    await game.until('the tile chooses rock', ({ tool }) => tool === 'rock');
    await game.stroke(1, [[300, 300], [400, 300], [500, 300]]);
    const { elements } = await game.until('rock is drawn', (now) => now.elements.rock > 0);
    assert.equal(elements.water, 0, 'rock was drawn, and there is water');
    await game.click('undo');
    await game.until('the button undoes', (now) => now.elements.rock === 0);
    await game.click('redo');
    await game.until('the button makes it again', (now) => now.elements.rock === elements.rock);
    await game.click('pause');
    const { tick } = await game.until('the button stops time', ({ paused }) => paused);
    await game.click('one tick');
    await game.until('the button runs one tick', (now) => now.tick === tick + 1);
    await game.click('faster');
    await game.until('the button doubles the speed', ({ speed }) => speed === 2);
    await game.click('slower');
    await game.until('the button halves the speed', ({ speed }) => speed === 1);
    await game.click('pause');
    await game.until('the button lets time go on', (now) => !now.paused && now.tick > tick + 1);
  });

  await test('a piece of the world is copied, turned, pasted and cut', async () => {
    await game.click('pause');
    await game.until('time stands', ({ paused }) => paused);
    const before = (await game.stats()).elements.rock;
    await game.key('ctrl+c');
    await game.untilWidgets('a frame is in hand', (all) => all.some(({ name }) => name === 'Drag a frame to copy'));
    await game.stroke(1, [[270, 270], [400, 300], [530, 330]]);
    await game.untilWidgets('a stamp is in hand', (all) => all.some(({ name }) => name === 'Click to paste'));
    await game.move([700, 300]);
    await game.picture('stamp');
    await game.stroke(1, [[700, 300], [701, 300]]);
    await game.until('it is pasted', ({ elements }) => elements.rock === 2 * before);
    await game.key('shift+r');
    await game.stroke(1, [[1000, 320], [1001, 320]]);
    await game.until('it is pasted upright', ({ elements }) => elements.rock === 3 * before);
    await game.click('lay it down');
    await game.untilWidgets('nothing is in hand', (all) => !all.some(({ name }) => name === 'Click to paste'));
    await game.key('ctrl+x');
    await game.stroke(1, [[940, 180], [1000, 320], [1060, 480]]);
    await game.until('it is cut out', ({ elements }) => elements.rock === 2 * before);
    await game.key('Escape');
    await game.key('k');
    await game.untilWidgets('both are on the shelf', (all) => isOpen(all, 'Stamps') && all.filter(({ name }) => /^stamp \d+$/.test(name)).length === 2);
    await game.picture('shelf');
    await game.key('Escape');
    for (const rock of [3, 2, 1]) {
      await game.key('ctrl+z');
      await game.until('undo takes one back', ({ elements }) => elements.rock === rock * before);
    }
    await game.key('Insert');
    await game.until('the brush replaces', ({ mode }) => mode === 'replace');
    await game.key('2');
    await game.stroke(1, [[300, 300], [400, 300], [500, 300]]);
    await game.until('rock is water now, and nothing else is', ({ elements, particles }) => elements.water > 0 && particles <= before);
    await game.key('Insert');
    await game.until('the brush draws', ({ mode }) => mode === 'draw');
    await game.click('pause');
    await game.until('time goes on', ({ paused }) => !paused);
    await game.key('r');
    await game.until('an empty scene', ({ particles }) => particles === 0);
    return `${before} cells of rock`;
  });

  await test('elements are found by name, and a digit at a tile keeps one there', async () => {
    const hasTile = (all, wanted) => all.some(({ kind, name }) => kind === 'Button' && name === wanted);
    await game.key('e');
    await game.untilWidgets('the panel is open', (all) => isOpen(all, 'Elements') && hasTile(all, 'glass'));
    for (const letter of 'coa') await game.key(letter);
    await game.untilWidgets('only what is searched is there', (all) => hasTile(all, 'coal') && !hasTile(all, 'glass'));
    await game.key('Return');
    await game.until('Enter takes the first', ({ tool }) => tool === 'coal');
    await game.untilWidgets('the bar shows what is chosen', (all) => !isOpen(all, 'Elements') && hasTile(all, 'coal'));
    await game.click('all elements and tools, and search');
    await game.hover('brine');
    await game.key('3');
    await game.until('it is told', ({ messages }) => messages.includes('brine is on 3 now'));
    await game.picture('elements');
    await game.untilWidgets('the digit is no text', (all) => isOpen(all, 'Elements') && hasTile(all, 'glass'));
    await game.key('Escape');
    await game.untilWidgets('Esc closes the panel', (all) => !isOpen(all, 'Elements') && hasTile(all, 'brine') && !hasTile(all, 'sand'));
    await game.key('3');
    await game.until('the digit chooses it', ({ tool }) => tool === 'brine');
  });

  await test('keys move the pointer, draw, and press what is on the screen', async () => {
    await game.move([640, 300]);
    await game.key('F8');
    await game.press('Right');
    await game.until('the pointer goes right', ({ pointer }) => pointer[0] > 700 && pointer[1] === 300);
    await game.letGo('Right');
    const { particles } = await game.stats();
    await game.press('Return');
    await game.until('Enter pours', (now) => now.particles > particles + 20);
    await game.letGo('Return');
    await game.hover('water');
    await game.key('Return');
    await game.until('Enter presses a tile', ({ tool }) => tool === 'water');
    await game.key('e');
    await game.untilWidgets('the elements are shown', (all) => isOpen(all, 'Elements'));
    const { pointer: tile } = await game.stats();
    await game.press('Up');
    await game.until('the pointer goes on, past the field to search in', ({ pointer }) => pointer[1] < tile[1] - 40);
    await game.letGo('Up');
    await game.key('Escape');
    await game.untilWidgets('they are closed', (all) => !isOpen(all, 'Elements'));
    for (const turn of ['once', 'twice']) {
      const { pointer: before } = await game.stats();
      await game.key('Tab');
      const { pointer } = await game.until(`Tab takes the pointer along ${turn}`, (now) => !near(now.pointer, before));
      const under = ({ place: [x, y, width, height] }) => pointer[0] > x && pointer[0] < x + width && pointer[1] > y && pointer[1] < y + height;
      assert.ok((await game.widgets()).some((widget) => widget.kind === 'Button' && under(widget)), `no button at ${pointer}`);
    }
    await game.key('F8');
    await game.press('Right');
    const { pointer } = await quiet();
    assert.deepEqual((await game.stats()).pointer, pointer, 'the pointer is the mouse\'s again');
    await game.letGo('Right');
    await game.key('r');
    await game.until('an empty scene', (now) => now.particles === 0);
    await game.key('3');
    await game.until('the tool is brine again', ({ tool }) => tool === 'brine');
  });

  await test('an element of one\'s own is mixed, pours, and is undone', async () => {
    await game.key('shift+e');
    await game.untilWidgets('the mixer is open', (all) => isOpen(all, 'Mixer') && all.some(({ name }) => name === 'Make it'));
    const empty = await game.picture('mixer-opens');
    await poll('the swatch moves', async () => difference(empty, await game.picture('mixer')), (share) => share > 1);
    await game.click('Make it');
    await game.until('it is in the hand', ({ tool }) => tool === 'my_brine');
    await game.drag(1, HIGH, 'it pours', ({ elements }) => elements.my_brine > 50);
    await game.untilWidgets('it can be changed, and is kept', (all) => ['Change it', 'forget my brine'].every((name) => all.some((widget) => widget.name === name)));
    await game.picture('mixed');
    await game.key('ctrl+z');
    await game.key('ctrl+z');
    await game.until('undo takes it out of the world', ({ tool, elements }) => tool !== 'my_brine' && elements.my_brine === undefined);
    await game.click('forget my brine');
    await game.untilWidgets('it is forgotten', (all) => !all.some(({ name }) => name === 'forget my brine'));
    await game.key('shift+e');
    await game.untilWidgets('the mixer is closed', (all) => !isOpen(all, 'Mixer'));
    await game.key('3');
    await game.until('the tool is brine again', ({ tool }) => tool === 'brine');
  });

  await test('sliders and settings have an effect', async () => {
    const { brush } = await game.stats();
    const [x, y, width, height] = (await game.widgets()).find(({ name }) => name === 'size of the brush').place;
    await game.stroke(1, [[x + width / 2, y + height / 2], [x + 0.9 * width, y + height / 2]].map((at) => at.map(Math.round)));
    await game.until('the slider makes the brush larger', (now) => now.brush > 2 * brush);
    // The count of particles has the element's name, too.
    const widthOf = (all, wanted) => all.find(({ kind, name }) => kind === 'Button' && name === wanted)?.place[2] ?? 0;
    const before = widthOf(await game.widgets(), 'rock');
    await game.click('settings');
    await game.click('130 %');
    await game.untilWidgets('the HUD is larger', (all) => widthOf(all, 'rock') > 1.2 * before);
    await game.click('100 %');
    await game.untilWidgets('the HUD is as it was', (all) => widthOf(all, 'rock') === before);
    return `a tile of ${before} pixels`;
  });

  await test('what is closed or hidden goes', async () => {
    await game.key('Escape');
    await game.untilWidgets('Esc closes the settings', (all) => !isOpen(all, 'Settings'));
    await game.key('F3');
    await game.untilWidgets('the details are open', (all) => isOpen(all, 'Details'));
    await game.click('Close');
    await game.untilWidgets('the cross closes the details', (all) => !isOpen(all, 'Details'));
    await game.key('a');
    await game.untilWidgets('the panel is open', (all) => isOpen(all, 'Accuracy'));
    await game.key('h');
    await game.untilWidgets('H hides panels and bars', (all) => !isOpen(all, 'Accuracy') && !all.some(({ name }) => name === 'rock'));
    await game.key('h');
    await game.untilWidgets('H brings them back', (all) => isOpen(all, 'Accuracy') && all.some(({ name }) => name === 'rock'));
    await game.click('accuracy: what it costs, and the autopilot');
    await game.untilWidgets('the button of the bar closes the panel', (all) => !isOpen(all, 'Accuracy'));
    await game.key('r');
    await game.until('an empty scene again', ({ elements }) => elements.rock === 0);
    await game.key('2');
    await game.until('the tool is water again', ({ tool }) => tool === 'water');
  });

  await test('the gallery finds a scene by an element, shows it, and plays it', async () => {
    const hasTile = (all, wanted) => all.some(({ kind, name }) => kind === 'Button' && name === wanted);
    await pour(100);
    await game.key('m');
    await game.untilWidgets('the gallery is open', (all) => isOpen(all, 'Scenes') && hasTile(all, 'Waterfall'));
    const bare = await game.picture('gallery-opens');
    await poll('pictures', async () => difference(bare, await game.picture('gallery')), (share) => share > 5);
    for (const letter of 'mercury') await game.key(letter);
    await game.untilWidgets('only what is searched is there', (all) => hasTile(all, 'Layers') && !hasTile(all, 'Hourglass'));
    await game.hover('Layers');
    await game.click('settings of Layers');
    await game.untilWidgets('the page of a scene', (all) => hasTile(all, 'Play') && !hasTile(all, 'Mercury maze'));
    await game.key('Escape');
    await game.untilWidgets('Esc goes back', (all) => hasTile(all, 'Mercury maze'));
    await game.key('Right');
    await game.key('Return');
    const { scene } = await game.until('Enter plays it', (now) => now.scene !== 'empty');
    await game.untilWidgets('the gallery is closed', (all) => !isOpen(all, 'Scenes'));
    await game.key('ctrl+z');
    await game.until('undo brings the world back', (now) => now.scene === 'empty' && now.particles >= 100);
    await game.key('r');
    await game.until('an empty scene again', ({ particles }) => particles === 0);
    await game.key('2');
    await game.until('the tool is water again', ({ tool }) => tool === 'water');
    return `${scene} was played`;
  });

  await test('what is thrown at the world is judged, and undo brings the world back', async () => {
    await pour(200);
    await game.key('shift+F7');
    await game.untilWidgets('the panel is open', (all) => isOpen(all, 'Try to break it'));
    const { tick } = await game.stats();
    await game.click('A blast');
    const verdict = /^A blast: (held|as known|broken)$/;
    const widgets = await game.untilWidgets('a verdict', (all) => all.some(({ name }) => verdict.test(name)));
    await game.picture('thrown');
    const { name } = widgets.find((widget) => verdict.test(widget.name));
    if (!name.endsWith('held')) throw new Error(name);
    const later = (await game.until('the world goes on', (now) => now.tick > tick + 60)).tick;
    await game.key('ctrl+z');
    await game.until('undo brings the world back', (now) => now.tick < later && now.particles >= 200);
    await game.key('shift+F7');
    await game.untilWidgets('the panel is closed', (all) => !isOpen(all, 'Try to break it'));
    await game.key('r');
    await game.until('an empty scene again', ({ particles }) => particles === 0);
    return name;
  });

  await test('the museum draws theory over the world, and undo leads back', async () => {
    await game.key('shift+F6');
    await game.untilWidgets('the museum is open', (all) => isOpen(all, 'Museum of known answers'));
    const left = { x: 40, y: 120, width: 860, height: 560 };
    assert.equal(theory(await game.picture('museum-opens'), left), 0, 'theory over a world of which nothing is known');
    for (const [title, scene] of [['Dam break on a wet bed', 'wet_bed'], ['Free fall', 'free_fall'], ['Sloshing', 'sloshing']]) {
      if ((await game.widgets()).some(({ name }) => name === 'other answers')) {
        await game.click('other answers');
        await game.untilWidgets('the answers are listed', (all) => all.some(({ name }) => name === title));
      }
      await game.click(title);
      await game.until(`${title} is shown`, (now) => now.scene === scene && now.tick > 10);
      await poll('theory is drawn', async () => theory(await game.picture(`museum-${scene}`), left), (pink) => pink > 100);
    }
    for (const scene of ['free_fall', 'wet_bed', 'empty']) {
      await game.key('ctrl+z');
      await game.until('undo leads back', (now) => now.scene === scene);
    }
    const { speed } = await game.stats();
    assert.equal(speed, 1, 'the museum leaves its speed behind');
    await game.key('shift+F6');
    await game.untilWidgets('the museum is closed', (all) => !isOpen(all, 'Museum of known answers'));
  });

  await test('a spring flows on by itself, a drain takes, and a press on each takes it away', async () => {
    await game.key('r');
    await game.until('an empty scene again', ({ particles }) => particles === 0);
    await game.key('2');
    await game.key('u');
    await quiet();
    await game.move([400, 250]);
    await game.tap(1);
    await game.until('what flows by itself', ({ particles }) => particles > 300);
    await game.picture('spring');
    await game.tap(1);
    const { particles } = await game.stats();
    await game.move([400, 700]);
    await game.tap(3);
    await game.until('less than flowed', (now) => now.particles < particles - 50);
    await game.tap(3);
    await game.key('u');
    await game.key('r');
    await game.until('an empty scene again', ({ particles: now }) => now === 0);
    return `${particles} particles`;
  });

  await test('the game speaks German, and English again', async () => {
    await game.key('F4');
    await game.untilWidgets('the settings', (all) => isOpen(all, 'Settings'));
    await game.click('Deutsch');
    await game.untilWidgets('the settings in German', (all) => isOpen(all, 'Einstellungen'));
    await game.key('F4');
    await game.key('F1');
    await game.untilWidgets('the keys in German', (all) => isOpen(all, 'Tasten und Maus'));
    await game.picture('german');
    await game.key('F1');
    await game.key('e');
    const all = await game.untilWidgets('elements in German', (now) => isOpen(now, 'Elemente'));
    const names = ['Quecksilber', 'mercury'].map((wanted) => all.some(({ name }) => name === wanted));
    assert.deepEqual(names, [true, false], 'mercury in German, and not in English');
    await game.key('Escape');
    await game.untilWidgets('no elements', (now) => !isOpen(now, 'Elemente'));
    await game.key('F4');
    await game.untilWidgets('the settings in German', (now) => isOpen(now, 'Einstellungen'));
    await game.click('English');
    await game.untilWidgets('the settings', (now) => isOpen(now, 'Settings'));
    await game.key('F4');
  });

  await test('a recording and the last minute can be replayed', async () => {
    await game.key('F9');
    await game.until('it records', ({ recording }) => recording !== null);
    const { particles } = await game.stats();
    await pour(particles + 100);
    await game.key('F9');
    await game.until('the recording has ended', ({ recording }) => recording === null);
    const recordings = () => {
      const place = join(folder, 'recordings');
      return existsSync(place) ? readdirSync(place).filter((name) => name.endsWith('.pmr')) : [];
    };
    await poll('a recording', recordings, ({ length }) => length === 1);
    await game.key('shift+F9');
    const files = await poll('the last minute', recordings, ({ length }) => length === 2);
    const replay = (name) => execFileSync(program, ['replay', join(folder, 'recordings', name)], { encoding: 'utf8' }).trim();
    return files.map(replay).join('; ');
  });

  await test('Backspace runs the world back, and letting it go goes on from there', async () => {
    const { tick } = await game.stats();
    await game.until('a second and a half of the world', (now) => now.tick > tick + 90);
    const { particles } = await pour((await game.stats()).particles + 100);
    await game.press('BackSpace');
    const back = await game.until('less water than was poured', (now) => now.rewinds && now.particles < particles - 50);
    await game.picture('rewind');
    await game.letGo('BackSpace');
    const now = await game.until('it goes on', (now) => !now.rewinds && now.tick > back.tick);
    await game.key('ctrl+z');
    await game.until('undo goes forward again', (now) => now.particles >= particles);
    return `${particles} particles, ${now.particles} after`;
  });

  await test('a screenshot opens as a world', async () => {
    const pictures = () => readdirSync(folder).filter((name) => /^powder-.*\.png$/.test(name));
    await game.key('space');
    const { particles } = await game.until('it stands', ({ paused }) => paused);
    await game.key('F2');
    const [name] = await poll('a picture', pictures, ({ length }) => length === 1);
    const told = execFileSync(program, ['run', join(folder, name), '--ticks', '1', '--metrics', '-'], { encoding: 'utf8' });
    await game.key('space');
    await game.until('it goes on', ({ paused }) => !paused);
    assert.ok(particles > 0 && told.includes('"particles"'), told);
    return `${name}, ${statSync(join(folder, name)).size} bytes`;
  });

  await test('a game that is killed offers its world at the next start', async () => {
    const journals = join(folder, 'data');
    const size = () => readdirSync(journals, { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile() && entry.name.startsWith('running-'))
      .reduce((sum, { parentPath, name }) => sum + statSync(join(parentPath, name)).size, 0);
    const before = size();
    await pour((await game.stats()).particles + 100);
    await poll('what was played is in the journal', size, (now) => now > before);
    assert.equal(await game.kill('SIGKILL'), 'SIGKILL');
    await begin([]);
    await game.untilWidgets('the offer', (all) => isOpen(all, 'The game ended unexpectedly'));
    await poll('the offer is drawn', () => game.picture('offer'), (pixels) => pixels.some((value) => value > 40));
    const { scene, particles: restored } = await game.stats();
    assert.deepEqual([scene, restored], ['empty', 0], 'not the scene of last time, or something was restored unasked');
    await game.click('Restore');
    const { particles } = await game.until('the world is back', (now) => now.particles > 0);
    // A favourite and the settings outlive the game, too.
    await game.key('3');
    await game.until('brine is still on 3', ({ tool }) => tool === 'brine');
    assert.equal((await game.stats()).picture, 'plain');
    return `${particles} particles`;
  });

  await test('F1 shows the keys', async () => {
    // Time stands since the world was restored; what was said of it goes.
    await quiet();
    let before;
    await poll('the picture keeps still', async () => {
      const last = before;
      before = await game.picture('before-help');
      return last === undefined ? 100 : difference(last, before);
    }, (share) => share === 0);
    await game.key('F1');
    await game.untilWidgets('the keys', (all) => isOpen(all, 'Keys and mouse'));
    const share = await poll('the picture of it', async () => difference(before, await game.picture('help')), (share) => share > 5);
    return `${share.toFixed(1)} % of the picture changed`;
  });

  await test('settings that can not be read are told and kept', async () => {
    await game.kill();
    const kept = join(folder, 'data', 'powder-master');
    const bad = '(hud: 9.0, picture: Some(Best))';
    writeFileSync(join(kept, 'settings.ron'), bad);
    await begin();
    await poll('a line of the log', () => readFileSync(join(folder, 'log'), 'utf8'), (log) => /settings\.ron: not read, .*; kept as /.test(log));
    assert.equal(readFileSync(join(kept, 'settings.unread.ron'), 'utf8'), bad);
  });

  const log = readFileSync(join(folder, 'log'), 'utf8');
  assert.doesNotMatch(log, /panicked/i, 'the game panicked');

  await test('a window that changes size and goes away while ticks are late', () => resizeWhileLate(program, join(folder, 'late')));
}

const apart = ([x, y, width, height], [u, v, wide, high]) => x + width <= u || u + wide <= x || y + height <= v || v + high <= y;

try {
  await play();
  console.log(`${passed} passed, 0 failed; screenshots in ${folder}`);
} catch (error) {
  await game?.picture('failed').catch(() => {});
  const log = existsSync(join(folder, 'log')) ? readFileSync(join(folder, 'log'), 'utf8') : '';
  console.error(`FAILED after ${passed} passed: ${error.message}\nlog: ${log}\nscreenshots in ${folder}`);
  process.exitCode = 1;
} finally {
  await game?.kill();
  screen.stop();
}
