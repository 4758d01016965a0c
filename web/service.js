// Lets the game be played offline once it was loaded, and gives the page the headers under which it may use threads,
// on a host that does not send them. What is kept for playing offline is `web/page.js`'s business: a cache for each build.

const SCOPE = self.registration.scope;
const HEADERS = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Resource-Policy': 'same-origin',
};

self.addEventListener('install', () => self.skipWaiting());
self.addEventListener('activate', (event) => event.waitUntil(self.clients.claim()));
self.addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method === 'GET' && new URL(request.url).origin === self.location.origin) {
    event.respondWith(answer(request));
  }
});

async function answer(request) {
  // A file with a hash in its name never changes.
  if (/-[0-9a-f]{16}\.\w+$/.test(new URL(request.url).pathname)) {
    const kept = await caches.match(request, { ignoreVary: true });
    if (kept) return isolated(kept);
  }
  try {
    return isolated(await fetch(request));
  } catch (error) {
    const kept = await offline(request);
    if (kept) return isolated(kept);
    throw error;
  }
}

// A file of the newest build that is kept as a whole: of such a one the page itself is kept, which comes last.
async function offline(request) {
  const names = (await caches.keys()).filter((name) => name.startsWith(`powder-master ${SCOPE}#`));
  for (const name of names.reverse()) {
    const cache = await caches.open(name);
    if (await cache.match(SCOPE, { ignoreVary: true })) {
      return cache.match(request, { ignoreSearch: true, ignoreVary: true });
    }
  }
}

function isolated(response) {
  if (response.status === 0) return response;
  const headers = new Headers(response.headers);
  for (const [name, value] of Object.entries(HEADERS)) headers.set(name, value);
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}
