// Loads the game, shows how far it is, and stands between it and the browser.

const build = JSON.parse(document.getElementById('build').textContent);
const canvas = document.getElementById('world');
const cover = document.getElementById('cover');
const state = document.getElementById('state');
const bar = document.getElementById('progress');

const CAN_T_ISOLATE = 'powder-master can not isolate this page';
const MOST_THREADS = 8;

function fail(message, advice = []) {
  cover.hidden = false;
  cover.classList.add('failed');
  bar.hidden = true;
  state.textContent = message;
  const list = document.getElementById('advice');
  list.replaceChildren(...advice.map((text) => Object.assign(document.createElement('li'), { textContent: text })));
  list.hidden = advice.length === 0;
}

// What is missing for the game to run at all, with what to do.
function missing() {
  // One instruction of the vector kind: (func (result v128) i32.const 0 i8x16.splat).
  const simd = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11]);
  if (typeof WebAssembly !== 'object' || !WebAssembly.validate(simd)) {
    return ['This browser is too old: it has no WebAssembly with vectors.',
      ['Use Chrome or Edge from version 91, Firefox from 89, or Safari from 16.4.']];
  }
  if (!document.createElement('canvas').getContext('webgl2')) {
    return ['This browser shows no WebGL 2, which the game draws with.',
      ['Switch on hardware acceleration (graphics acceleration) in the browser’s settings, and start it again.',
        'Update the browser and the graphics driver.',
        'Or use another browser: Chrome, Edge, Firefox, or Safari from version 15.',
        'The desktop version needs none of this: cargo run --release.']];
  }
  return null;
}

// On a host that does not send the headers under which memory may be shared, the service worker does: from the next
// load on. Without it the game runs on one thread.
async function isolate() {
  if (crossOriginIsolated) {
    sessionStorage.removeItem(CAN_T_ISOLATE);
    return;
  }
  if (!navigator.serviceWorker || sessionStorage.getItem(CAN_T_ISOLATE)) return;
  sessionStorage.setItem(CAN_T_ISOLATE, 'yes');
  const patience = new Promise((resolve) => setTimeout(resolve, 5000, false));
  const taken = new Promise((resolve) => {
    if (navigator.serviceWorker.controller) resolve(true);
    navigator.serviceWorker.addEventListener('controllerchange', () => resolve(true), { once: true });
  });
  await navigator.serviceWorker.register('service.js');
  if (await Promise.race([taken, patience])) {
    location.reload();
    await new Promise(() => {});
  }
}

const times = {};

async function download() {
  const response = await fetch(build.wasm, { credentials: 'same-origin' });
  if (!response.ok) throw new Error(`${build.wasm}: ${response.status} ${response.statusText}`);
  const counted = (async () => {
    const reader = response.clone().body.getReader();
    let bytes = 0;
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      bytes += value.length;
      bar.value = Math.min(bytes / build.bytes, 1);
      state.textContent = `Loading: ${(bytes / 1e6).toFixed(1)} of ${(build.bytes / 1e6).toFixed(1)} MB`;
    }
    times.lastByte = performance.now();
    state.textContent = 'Starting';
    bar.removeAttribute('value');
  })();
  const streams = response.headers.get('Content-Type') === 'application/wasm';
  const module = streams
    ? await WebAssembly.compileStreaming(response)
    : await WebAssembly.compile(await response.arrayBuffer());
  await counted;
  return module;
}

// One worker for each thread beside the page's own.
async function startThreads(game, module) {
  const wanted = Number(new URLSearchParams(location.search).get('threads')) || navigator.hardwareConcurrency || 1;
  const workers = crossOriginIsolated ? Math.min(wanted, MOST_THREADS) - 1 : 0;
  if (workers < 1) return;
  const script = new URL(build.script, document.baseURI).href;
  const ready = Array.from({ length: workers }, () => new Promise((resolve, reject) => {
    const worker = new Worker(build.worker, { type: 'module', name: 'kernel' });
    worker.onmessage = () => resolve(worker);
    worker.onerror = (event) => reject(new Error(`a thread can't start: ${event.message}`));
    worker.postMessage({ script, module, memory: game.sharedMemory() });
  }));
  // Held for as long as the page lives: some browsers collect a worker that nobody holds.
  globalThis.powderWorkers = await Promise.all(ready);
  game.buildPool(workers);
}

const pairs = (link) => JSON.stringify([...new URLSearchParams(link)]);
const link = () => pairs(location.hash.slice(1));

function listen(game) {
  addEventListener('hashchange', () => {
    try {
      game.scene(link());
    } catch (error) {
      console.warn(String(error.message ?? error));
    }
  });
  document.addEventListener('visibilitychange', () => game.hidden(document.hidden));

  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => event.preventDefault(), { passive: false });
  // The middle button would scroll; but a press must still give the canvas the keyboard.
  canvas.addEventListener('mousedown', (event) => {
    event.preventDefault();
    canvas.focus({ preventScroll: true });
  });
  for (const kind of ['touchstart', 'touchmove', 'touchend', 'gesturestart']) {
    canvas.addEventListener(kind, (event) => event.preventDefault(), { passive: false });
  }
  // The game has the keys that it uses; reload, tabs and the like stay the browser's.
  const withControl = new Set(['KeyS', 'KeyO', 'KeyZ', 'KeyY']);
  const browsers = new Set(['F5', 'F6', 'F7', 'F12']);
  addEventListener('keydown', (event) => {
    if (document.activeElement !== canvas) canvas.focus({ preventScroll: true });
    const control = event.ctrlKey || event.metaKey;
    if (control ? withControl.has(event.code) : !browsers.has(event.code) && !event.altKey) event.preventDefault();
  }, { capture: true });
  addEventListener('focus', () => canvas.focus({ preventScroll: true }));
}

// The hook for scripts and tests: docs/web.md says what it does.
function hook(game, ready) {
  return {
    ready,
    stats: () => JSON.parse(game.stats()),
    scene: (name, settings = {}) => game.scene(JSON.stringify(
      [['scene', name], ...Object.entries(settings).map(([key, value]) => [key, String(value)])])),
    pause: (paused = true) => game.pause(paused),
    measure: (link, ticks, warmup = 0) => JSON.parse(game.measure(pairs(link), ticks, warmup)),
    times,
    offline: false,
  };
}

// Keeps what is needed to play without a network, and nothing of former versions.
async function keepOffline() {
  if (!navigator.serviceWorker) return;
  const { scope } = await navigator.serviceWorker.register('service.js');
  const cache = await caches.open(`powder-master ${scope}`);
  const list = await (await fetch('files.json')).json();
  const wanted = ['./', 'files.json', ...Object.keys(list.bytes)].map((name) => new URL(name, document.baseURI).href);
  for (const request of await cache.keys()) {
    if (!wanted.includes(request.url.split(/[?#]/)[0])) await cache.delete(request);
  }
  for (const url of wanted) {
    if (!await cache.match(url, { ignoreVary: true })) await cache.add(url);
  }
  globalThis.powderMaster.offline = true;
}

async function main() {
  const lack = missing();
  if (lack) return fail(...lack);
  await isolate().catch((error) => console.warn(`no service worker: ${error}`));

  const storage = await import(new URL(build.storage, document.baseURI).href);
  let isReady;
  const ready = new Promise((resolve) => { isReady = resolve; });
  globalThis.powderHost = {
    failed(message) {
      console.error(message);
      fail(`The game ended: ${message}`, ['Load the page again.']);
    },
    painted() {
      times.firstFrame = performance.now();
      cover.hidden = true;
      isReady();
    },
    // What comes from the game is a view of its memory, which others can't share.
    keep: (path, bytes, written) => storage.keep(path, bytes.slice(), written)
      .catch((error) => console.warn(`${path} is kept for this visit only: ${error}`)),
    download(name, bytes) {
      const url = URL.createObjectURL(new Blob([bytes.slice()]));
      Object.assign(document.createElement('a'), { href: url, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(url), 60_000);
    },
  };

  const [module, game, files] = await Promise.all([
    download(), import(new URL(build.script, document.baseURI).href), storage.all(),
  ]);
  await game.default({ module_or_path: module });
  await startThreads(game, module);
  for (const file of files) game.restore(file.path, file.bytes, file.written);
  globalThis.powderMaster = hook(game, ready);
  listen(game);
  game.start(link(), matchMedia('(pointer: coarse)').matches);
  canvas.focus({ preventScroll: true });
  await ready;
  await keepOffline().catch((error) => console.warn(`not kept for playing offline: ${error}`));
}

main().catch((error) => {
  console.error(error);
  fail(`The game can't start: ${error.message ?? error}`, ['Load the page again, with a network.']);
});
