// A real Chromium, a server of the page, and eyes for the picture.

import { execFileSync, spawn } from 'node:child_process';
import { cpSync, existsSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { extname, join, resolve } from 'node:path';

const ARGUMENTS = [
  '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
];

// Starts Chromium (or what the variable CHROMIUM names) through playwright-core, which was installed into `modules`.
export function launch(modules, more = []) {
  const { chromium } = createRequire(join(resolve(modules), 'index.js'))('playwright-core');
  const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync)
    ?? execFileSync('which', ['chromium'], { encoding: 'utf8' }).trim();
  return chromium.launch({ executablePath, args: [...ARGUMENTS, ...more] });
}

// `cargo web --serve`: says where, and how to stop it.
export async function serve(builder) {
  const server = spawn(builder, ['--serve', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise((found, failed) => {
    server.stdout.on('data', (data) => found(String(data).trim()));
    server.on('exit', (code) => failed(new Error(`the server ended with ${code}`)));
  });
  return { url, stop: () => server.kill() };
}

const KINDS = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

// A plain static host, which sends no special headers, with the page under a sub-path. Its `dist` may be changed, and
// of the files for which `breaks` holds it loses the connection.
export async function plainHost(dist) {
  const host = { dist, breaks: () => false };
  const server = createServer((request, response) => {
    const name = decodeURI(new URL(request.url, 'http://x').pathname).replace('/some/where/', '') || 'index.html';
    const path = join(host.dist, name);
    if (host.breaks(name)) return request.socket.destroy();
    if (!existsSync(path) || name.includes('..')) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': KINDS[extname(path)] ?? 'application/octet-stream' });
    response.end(readFileSync(path));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  host.url = `http://127.0.0.1:${server.address().port}/some/where/`;
  host.stop = () => {
    server.closeAllConnections();
    return new Promise((done) => server.close(done));
  };
  return host;
}

// Makes another build of a page: the same game in files with other names.
export function rebuild(dist, folder, title) {
  cpSync(dist, folder, { recursive: true });
  const path = (name) => join(folder, name);
  const list = JSON.parse(readFileSync(path('files.json'), 'utf8'));
  const renames = Object.values(list.names).map((name) => [name, name.replace(/-[0-9a-f]{4}/, '-0000')]);
  for (const [old, name] of renames) renameSync(path(old), path(name));
  for (const file of ['files.json', 'index.html']) {
    let text = readFileSync(path(file), 'utf8').replaceAll(list.build, '0'.repeat(16));
    for (const [old, name] of renames) text = text.replaceAll(old, name);
    writeFileSync(path(file), text.replace(/<title>.*<\/title>/, `<title>${title}</title>`));
  }
}

// What a browser makes of two pictures: share of pixels that differ visibly, in percent.
export async function difference(eyes, a, b) {
  return eyes.evaluate(async (pictures) => {
    const [one, other] = await Promise.all(pictures.map(async (text) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${text}`)).blob());
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    let differ = 0;
    for (let k = 0; k < one.length; k += 4) {
      const far = Math.max(...[0, 1, 2].map((c) => Math.abs(one[k + c] - other[k + c])));
      if (far > 15) differ += 1;
    }
    return 100 * differ / (one.length / 4);
  }, [a, b].map((picture) => picture.toString('base64')));
}

// Pixels of a part of a picture that are blue, as water is.
export async function water(eyes, picture, { x, y, width, height }) {
  return eyes.evaluate(async ([text, x, y, width, height]) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${text}`)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(x, y, width, height);
    let blue = 0;
    for (let k = 0; k < data.length; k += 4) {
      if (data[k + 2] > 120 && data[k + 2] > 1.5 * data[k]) blue += 1;
    }
    return blue;
  }, [picture.toString('base64'), x, y, width, height]);
}
