// Loads the game, shows how far it is, and stands between it and the browser.

const build = JSON.parse(document.getElementById('build').textContent);
const canvas = document.getElementById('world');
const cover = document.getElementById('cover');
const state = document.getElementById('state');
const bar = document.getElementById('progress');

const CAN_T_ISOLATE = 'powder-master can not isolate this page';
const MOST_THREADS = 8;
// Time that threads may take to start, ms.
const PATIENCE = 10_000;
// Most memory of the game, pages of 64 KiB, and what is the least that it may be offered.
const MOST_PAGES = 32768;
const FEWEST_PAGES = 4096;

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

// The game's memory. What threads can share is set aside as a whole, which a small device may refuse: then less of it.
function setAside() {
  for (let maximum = MOST_PAGES; ; maximum /= 2) {
    try {
      return new WebAssembly.Memory({ initial: build.pages, maximum, shared: true });
    } catch (error) {
      if (maximum <= FEWEST_PAGES) {
        throw Object.assign(new Error(`the browser gives it no memory (${error.message})`), {
          advice: ['Close other pages and programs, and load the page again.', 'Or use another browser.'],
        });
      }
    }
  }
}

// One worker for each thread beside the page's own; none if one of them can't start.
async function startThreads(game, module, memory) {
  const wanted = Number(new URLSearchParams(location.search).get('threads')) || navigator.hardwareConcurrency || 1;
  const count = crossOriginIsolated ? Math.min(wanted, MOST_THREADS) - 1 : 0;
  if (count < 1) return;
  const script = new URL(build.script, document.baseURI).href;
  const workers = [];
  let failed;
  const failure = new Promise((_, reject) => { failed = (why) => reject(new Error(why)); });
  const start = () => new Promise((resolve) => {
    const worker = new Worker(build.worker, { type: 'module', name: 'kernel' });
    workers.push(worker);
    worker.onmessage = ({ data }) => (data === 'ready' ? resolve() : failed(data.failed));
    worker.onerror = (event) => failed(event.message ?? 'its script can not be loaded');
    worker.postMessage({ script, module, memory });
  });
  const timer = setTimeout(failed, PATIENCE, 'it takes too long');
  try {
    await Promise.race([Promise.all(Array.from({ length: count }, start)), failure]);
  } catch (error) {
    console.warn(`a thread can't start, so there is one only: ${error.message}`);
    for (const worker of workers) worker.terminate();
    return;
  } finally {
    clearTimeout(timer);
  }
  failed = globalThis.powderHost.failed;
  // Held for as long as the page lives: some browsers collect a worker that nobody holds.
  globalThis.powderWorkers = workers;
  game.buildPool(count);
}

// Has a screen reader say it, even if it is what was said before.
const SPOKEN = 8;
function say(text) {
  const spoken = document.getElementById('spoken');
  spoken.append(Object.assign(document.createElement('p'), { textContent: text }));
  while (spoken.childElementCount > SPOKEN) spoken.firstElementChild.remove();
}

// Says the page's own texts in the language of the game.
function speak(game, tag) {
  document.documentElement.lang = tag;
  for (const part of document.querySelectorAll('[data-spoken]')) {
    part.dataset.spoken ||= part.textContent;
    part.textContent = game.spoken(part.dataset.spoken);
  }
  canvas.ariaLabel = game.spoken('The world of Powder Master');
}

const filled = (text, ...values) => values.reduce((before, value) => before.replace('{}', () => value), text);

const pairs = (link) => JSON.stringify([...new URLSearchParams(link)]);
const link = () => pairs(location.hash.slice(1));

function listen(game) {
  addEventListener('hashchange', () => {
    try {
      game.scene(link());
    } catch (error) {
      game.warn(String(error.message ?? error));
    }
  });
  canvas.addEventListener('webglcontextlost', () => rescue(game));
  // What ends the module without a panic, such as memory that can't grow.
  addEventListener('error', ({ error }) => {
    if (error instanceof WebAssembly.RuntimeError) globalThis.powderHost.failed(error.message);
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

// Files that are dropped, pasted or chosen: the game says what it makes of each.
const LARGEST = 256 * 2 ** 20;
async function open(game, files) {
  for (const file of files) {
    if (file.size > LARGEST) {
      game.warn(filled(game.spoken('{}: larger than {} MiB'), file.name, LARGEST / 2 ** 20));
      continue;
    }
    try {
      game.open(file.name, new Uint8Array(await file.arrayBuffer()));
    } catch (error) {
      game.warn(filled(game.spoken('{}: can’t be read: {}'), file.name, error.message ?? error));
    }
  }
}

// The address has it, too: where the clipboard is refused, it can be taken from there.
async function copyLink(game, world) {
  history.replaceState(null, '', `#world=${world}`);
  try {
    await navigator.clipboard.writeText(location.href);
    game.tell(game.spoken('Link copied: whoever opens it has this world'));
  } catch (error) {
    const text = game.spoken('The browser keeps its clipboard ({}): the link is the page’s address now');
    game.warn(filled(text, error.message ?? error));
  }
}

// Lets the player choose files of the device.
function choose(game) {
  const input = Object.assign(document.createElement('input'), { type: 'file', multiple: true });
  input.addEventListener('change', () => void open(game, [...input.files]));
  input.click();
}

function takeFiles(game) {
  const hint = document.getElementById('drop');
  const carries = (event) => event.dataTransfer?.types.includes('Files');
  // Parts of the page are left and entered on the way; it is still over the page as long as this keeps coming.
  let leaves;
  addEventListener('dragover', (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = 'copy';
    hint.hidden = false;
    clearTimeout(leaves);
    leaves = setTimeout(() => { hint.hidden = true; }, 500);
  });
  addEventListener('drop', (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    hint.hidden = true;
    void open(game, [...event.dataTransfer.files]);
  });
  addEventListener('paste', (event) => {
    const files = [...event.clipboardData?.files ?? []];
    if (files.length > 0) event.preventDefault();
    void open(game, files);
  });
}

// The hook for scripts and tests: docs/web.md says what it does.
function hook(game, ready) {
  return {
    ready,
    stats: () => JSON.parse(game.stats()),
    widgets: () => JSON.parse(game.widgets()),
    scene: (name, settings = {}) => game.scene(JSON.stringify(
      [['scene', name], ...Object.entries(settings).map(([key, value]) => [key, String(value)])])),
    pause: (paused = true) => game.pause(paused),
    measure: (link, ticks, warmup = 0) => JSON.parse(game.measure(pairs(link), ticks, warmup)),
    times,
    offline: false,
  };
}

// The path of the next file that is kept, or null if it can't be.
let nextKept = () => {};

// Without its graphics the game can't go on, but its world is not lost.
async function rescue(game) {
  const lost = game.spoken('The browser took the graphics away from the game.');
  const kept = new Promise((resolve) => { nextKept = resolve; });
  fail(lost, [game.spoken('The world is being saved.')]);
  game.rescue();
  fail(lost, await kept
    ? [game.spoken('The world is saved: load the page again, and the world from the list (Ctrl+O, or the button “Load”).')]
    : [game.spoken('The world could not be saved.'), game.spoken('Load the page again.')]);
}

// Tells the game what became of a file that the browser should keep.
async function tellKept(game, path, kept) {
  try {
    const name = await kept;
    if (name !== path) game.renamed(path, name);
    nextKept(name);
  } catch (error) {
    game.notKept(path, error.name ?? String(error));
    nextKept(null);
  }
}

// Keeps what is needed to play without a network: a cache for each build. The page itself comes last, so a build that
// has it is whole; only then those before it go.
async function keepOffline() {
  if (!navigator.serviceWorker) return;
  await navigator.serviceWorker.register('service.js');
  const { scope } = await navigator.serviceWorker.ready;
  const named = `powder-master ${scope}`;
  // Without a network it is the list of the build that is kept.
  const answer = await take('files.json', 'reload');
  const list = await answer.clone().json();
  const name = `${named}#${list.build}`;
  const cache = await caches.open(name);
  if (!await cache.match(scope, { ignoreVary: true })) {
    await cache.put('files.json', answer);
    for (const file of Object.keys(list.bytes)) {
      const hashed = Object.values(list.names).includes(file);
      if (!hashed || !await cache.match(file, { ignoreVary: true })) {
        await cache.put(file, await take(file, hashed ? 'default' : 'reload'));
      }
    }
    const page = await take(scope, 'reload');
    if (!(await page.clone().text()).includes(list.build)) throw new Error('the host is about to change the game');
    await cache.put(scope, page);
  }
  for (const other of await caches.keys()) {
    if (other.split('#')[0] === named && other !== name) await caches.delete(other);
  }
  globalThis.powderMaster.offline = true;
}

async function take(url, cache) {
  const response = await fetch(url, { cache });
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return response;
}

async function main() {
  const lack = missing();
  if (lack) return fail(...lack);
  await isolate().catch((error) => console.warn(`no service worker: ${error}`));

  const part = (name) => import(new URL(name, document.baseURI).href);
  const [storage, sounds] = [part(build.storage), part(build.sound)];
  const [module, game, { keep }, { soundOf }, files] = await Promise.all(
    [download(), part(build.script), storage, sounds, storage.then(({ all }) => all())]);
  const sound = soundOf({ module: build.soundModule, worklet: build.worklet });
  let isReady;
  const ready = new Promise((resolve) => { isReady = resolve; });
  globalThis.powderHost = {
    failed(message) {
      // What comes after the first is its consequence.
      if (cover.classList.contains('failed')) return;
      console.error(message);
      fail(`The game ended: ${message}`, ['Load the page again.']);
    },
    painted() {
      times.firstFrame = performance.now();
      cover.hidden = true;
      isReady();
    },
    say,
    speak: (tag) => speak(game, tag),
    // What comes from the game is a view of its memory, which others can't share.
    keep: (path, bytes, written) => void tellKept(game, path, keep(path, bytes.slice(), written)),
    replace: (path, bytes, written) => void tellKept(game, path, keep(path, bytes.slice(), written, true)),
    maySound: () => sound !== null,
    leaveSound: (controls) => sound?.leave(controls),
    wishSound: (plays) => sound?.wish(plays),
    choose: () => choose(game),
    copyLink: (world) => void copyLink(game, world),
    download(name, bytes) {
      const url = URL.createObjectURL(new Blob([bytes.slice()]));
      Object.assign(document.createElement('a'), { href: url, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(url), 60_000);
    },
  };

  const memory = setAside();
  await game.default({ module_or_path: module, memory });
  await startThreads(game, module, memory);
  for (const file of files) game.restore(file.path, file.bytes, file.written);
  globalThis.powderMaster = hook(game, ready);
  listen(game);
  takeFiles(game);
  const asks = (query) => matchMedia(query).matches;
  game.start(link(), asks('(pointer: coarse)'), asks('(prefers-reduced-motion: reduce)'));
  canvas.focus({ preventScroll: true });
  await ready;
  await keepOffline().catch((error) => console.warn(`not kept for playing offline: ${error}`));
}

main().catch((error) => {
  console.error(error);
  fail(`The game can't start: ${error.message ?? error}`, error.advice ?? ['Load the page again, with a network.']);
});
