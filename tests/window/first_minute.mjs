// A stranger's first minute in a real window. Usage: node tests/window/first_minute.mjs PATH-OF-powder-master [FOLDER]
// Needs what `play.mjs` needs. The pictures in the folder are to be looked at.

import { mkdirSync, rmSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { firstMinute } from '../first_minute.mjs';
import { display, open } from './game.mjs';

const program = resolve(process.argv[2]);
const folder = resolve(process.argv[3] ?? 'target/first-minute');
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(folder, 'data'), { recursive: true });

const BUTTONS = { left: 1, right: 3 };
const screen = await display();
const game = await open(program, screen.name, folder, []);
try {
  console.log(await firstMinute({
    click: game.click,
    picture: game.picture,
    stats: game.stats,
    stroke: (button, points) => game.stroke(BUTTONS[button], points),
  }));
} finally {
  await game.kill();
  screen.stop();
}
