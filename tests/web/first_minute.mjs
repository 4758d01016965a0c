// A stranger's first minute in a real headless Chromium. Usage: node tests/web/first_minute.mjs WEB-BUILD-PROGRAM NODE-MODULES FOLDER
// The pictures in the folder are to be looked at.

import { mkdirSync } from 'node:fs';
import { firstMinute } from '../first_minute.mjs';
import { begin, click, moveTo, stats } from './player.mjs';

const [builder, modules, folder] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const player = await begin(builder, modules, folder);
try {
  const page = await player.play(player.host.url);
  console.log(await firstMinute({
    click: (name) => click(page, name),
    picture: (name) => player.shoot(page, name),
    stats: () => stats(page),
    async stroke(button, points) {
      await moveTo(page, points[0]);
      await page.mouse.down({ button });
      for (const point of points.slice(1)) await moveTo(page, point);
      await page.mouse.up({ button });
    },
  }));
} finally {
  await player.end();
}
