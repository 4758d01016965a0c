// What the page does where it can't run, and where something breaks while it does.

import assert from 'node:assert/strict';
import { click, files, stats, still, until, untilKept } from '../player.mjs';

export async function whereItCanNot({ host, open, play, shoot, test }) {
  const refused = async (before, why) => {
    const page = await open(host.url, {}, { before: (page) => page.addInitScript(before), expected: why });
    await page.waitForSelector('#advice li');
    assert.match(await page.textContent('#state'), why);
    return page;
  };
  await test('without WebGL 2 the page says what to do', async () => {
    const page = await refused(() => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : get.call(this, kind, ...rest);
      };
    }, /WebGL 2/);
    await shoot(page, 'no-webgl');
    await page.context().close();
  });
  await test('without memory the page says what to do', async () => {
    const page = await refused(() => {
      WebAssembly.Memory = function () { throw new RangeError('could not allocate memory'); };
    }, /no memory \(could not allocate/);
    await shoot(page, 'no-memory');
    await page.context().close();
  });
  await test('where there is little memory, it does with less', async () => {
    const page = await play(`${host.url}#scene=empty`, {}, {
      before: (page) => page.addInitScript(() => {
        const { Memory } = WebAssembly;
        WebAssembly.Memory = function (size) {
          if (size.maximum > 8192) throw new RangeError('could not allocate memory');
          return new Memory(size);
        };
      }),
    });
    await page.context().close();
  });
  await test('a bad link plays the default scene and says why', async () => {
    const page = await play(`${host.url}#scene=nowhere`);
    const { scene, messages } = await stats(page);
    assert.equal(scene, 'waterfall');
    assert.ok(messages.some((text) => text.includes('nowhere')), JSON.stringify(messages));
    await shoot(page, 'bad-link');
    await page.context().close();
  });
}

export async function whereItGoesWrong(player) {
  await withThreads(player);
  await withGraphics(player);
  await withStorage(player);
}

// Plays with workers whose script is changed.
function withWorkers({ host, open }, change, expected) {
  return open(`${host.url}?threads=2#scene=dam_break`, { serviceWorkers: 'block' }, {
    expected,
    before: (page) => page.route('**/worker-*.js', async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: change(await response.text()) });
    }),
  });
}

async function withThreads(player) {
  const { shoot, started, test } = player;
  for (const [what, change] of [
    ['has no sound script', () => 'nonsense('],
    ['can not load the game', (text) => text.replace('import(script)', "import('data:text/javascript,throw 1')")],
    ['never says that it is ready', (text) => text.replace("self.postMessage('ready');", 'return;')],
  ]) {
    await test(`a thread that ${what}: the game goes on with one`, async () => {
      const page = await withWorkers(player, change, /nonsense|SyntaxError/);
      await started(page);
      assert.equal((await stats(page)).threads, 1);
      await page.context().close();
    });
  }
  await test('a thread that ends while the game runs: the page says so', async () => {
    const page = await player.play(`${player.host.url}?threads=2#scene=empty`, {}, { expected: /it broke/ });
    await page.evaluate(() => window.powderWorkers[0].onmessage({ data: { failed: 'it broke' } }));
    await page.waitForSelector('#cover:not([hidden])');
    assert.equal(await page.textContent('#state'), 'The game ended: it broke');
    await shoot(page, 'broken-thread');
    await page.context().close();
  });
}

async function withGraphics({ host, play, shoot, started, test }) {
  await test('lost graphics: the page says so, and the world is saved', async () => {
    const page = await play(`${host.url}#scene=dam_break&columns=20`, {}, { expected: /WebGL|CONTEXT_LOST|context/i });
    const { particles } = await stats(page);
    await page.evaluate(() => document.getElementById('world').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext());
    await page.waitForFunction(() => document.querySelector('#advice li')?.textContent.includes('is saved'));
    assert.match(await page.textContent('#state'), /graphics/);
    await shoot(page, 'lost-graphics');
    const [{ path }] = await files(page);
    assert.match(path, /powder-dam_break-\d+\.pms$/);
    await until(page, 'it stands', ({ paused }) => paused);
    await page.goto(`${host.url}?#scene=empty`);
    await started(page);
    await page.keyboard.press('Control+KeyO');
    await click(page, /^powder-dam_break-/);
    await until(page, 'the world is back', (now) => now.particles === particles);
    await page.context().close();
  });
}

async function withStorage({ browser, host, openIn, play, shoot, started, test }) {
  await test('a browser that keeps nothing: the player is told', async () => {
    const page = await play(`${host.url}#scene=empty`, {}, {
      before: (page) => page.addInitScript(() => {
        IDBObjectStore.prototype.put = () => { throw new DOMException('it is full', 'QuotaExceededError'); };
      }),
    });
    await page.keyboard.press('Control+KeyS');
    // Settings may be refused before it.
    const refused = /^Not kept.*QuotaExceeded.*\.pms/;
    const { messages } = await until(page, 'a warning', ({ messages }) => messages.some((text) => refused.test(text)));
    assert.ok(!messages.some((text) => text.startsWith('Saved')), JSON.stringify(messages));
    await shoot(page, 'full-storage');
    await page.context().close();
  });

  await test('two pages that save at once keep two worlds', async () => {
    const context = await browser.newContext({ viewport: { width: 700, height: 500 } });
    const pages = [];
    for (const _ of [1, 2]) {
      const page = await openIn(context, `${host.url}?threads=1#scene=empty`);
      await started(page);
      await still(page);
      await page.keyboard.press('KeyR');
      await until(page, 'the start', ({ tick }) => tick === 0);
      pages.push(page);
    }
    for (const page of pages) {
      await page.bringToFront();
      await page.keyboard.press('Control+KeyS');
      await until(page, 'it is saved', ({ messages }) => messages.some((text) => text.startsWith('Saved')));
    }
    const paths = (await untilKept(pages[0], 2)).map(({ path }) => path);
    assert.deepEqual(paths, ['saved worlds/powder-empty-0-2.pms', 'saved worlds/powder-empty-0.pms']);
    await until(pages[1], 'the other name', ({ messages }) => messages.includes(`Saved: ${paths[0]}`));
    await context.close();
  });
}
