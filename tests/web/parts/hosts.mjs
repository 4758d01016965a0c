// The page on a plain host: threads by the service worker, without a network, and over a change of the build.

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { plainHost, rebuild } from '../browser.mjs';
import { stats, until } from '../player.mjs';

const isKept = (page) => page.waitForFunction(() => window.powderMaster?.offline);

export async function onAPlainHost({ play, started, test }) {
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
    const [isolated, processors] = await page.evaluate(() => [crossOriginIsolated, navigator.hardwareConcurrency]);
    assert.equal(isolated, true);
    const { threads } = await stats(page);
    assert.equal(threads, Math.min(processors, 8));
    await isKept(page);
    await plain.stop();
    await page.reload();
    await started(page);
    assert.equal((await stats(page)).scene, 'empty');
    await isKept(page);
    await page.context().close();
  });
}

// What is played without a network is always a whole build: the newest of which all has come.
export async function overAnUpdate({ play, started, test }) {
  const [first, second] = ['Powder Master', 'the second build'];
  const folder = mkdtempSync(join(tmpdir(), 'powder-master-'));
  rebuild('dist', folder, second);
  // Plays the first build until it is kept, then `update`s, and plays without a network.
  const afterwards = async (url, update, title) => {
    const host = await plainHost('dist');
    const page = await play(`${host.url}${url}#scene=empty`, {}, { expected: /ERR_|can't start|Failed to/ });
    await isKept(page);
    const change = () => { host.dist = folder; };
    await update(page, host, change);
    await host.stop();
    await page.goto('about:blank');
    await page.goto(`${host.url}#scene=empty`);
    await started(page);
    assert.equal(await page.title(), title);
    await isKept(page);
    await page.context().close();
  };
  const seeNew = async (page) => {
    await started(page);
    assert.equal(await page.title(), second);
    await isKept(page);
  };
  try {
    await test('an update seen under another link: the new build without a network', () => afterwards('?threads=2', async (page, host, change) => {
      await page.reload();
      await started(page);
      change();
      await page.goto(`${host.url}#scene=empty`);
      await seeNew(page);
    }, second));
    await test('an update seen past the service worker: the new build without a network', () => afterwards('', async (page, host, change) => {
      change();
      const devtools = await page.context().newCDPSession(page);
      const loaded = page.waitForEvent('load');
      await devtools.send('Page.reload', { ignoreCache: true });
      await loaded;
      await seeNew(page);
    }, second));
    await test('an update that breaks off: the old build without a network', () => afterwards('', async (page, host, change) => {
      change();
      host.breaks = (name) => name.endsWith('.wasm');
      await page.reload();
      await page.waitForSelector('#advice li');
      assert.match(await page.textContent('#state'), /can't start/);
    }, first));
    await test('an update of which a part is missing when the game already runs: the old build', () => afterwards('', async (page, host, change) => {
      host.breaks = (name) => name.startsWith('style');
      change();
      const failed = page.waitForEvent('console', (message) => message.text().includes('not kept for playing offline'));
      await page.reload();
      await failed;
      await until(page, 'frames', ({ tick }) => tick > 2);
      assert.equal(await page.title(), second);
    }, first));
  } finally {
    rmSync(folder, { recursive: true });
  }
}
