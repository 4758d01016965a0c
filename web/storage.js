// The player's files (saved worlds), in the browser's own database.

const STORE = 'files';

function request(of) {
  return new Promise((resolve, reject) => {
    of.onsuccess = () => resolve(of.result);
    of.onerror = () => reject(of.error);
  });
}

let database;

function open() {
  database ??= new Promise((resolve, reject) => {
    const opening = indexedDB.open('powder-master', 1);
    opening.onupgradeneeded = () => opening.result.createObjectStore(STORE, { keyPath: 'path' });
    opening.onsuccess = () => resolve(opening.result);
    opening.onerror = () => reject(opening.error);
  });
  return database;
}

// All files: { path, bytes, written }; none where the browser keeps nothing (private windows).
export async function all() {
  try {
    return await request((await open()).transaction(STORE).objectStore(STORE).getAll());
  } catch (error) {
    console.warn(`saved worlds can't be read: ${error}`);
    return [];
  }
}

// Keeps a file, or throws.
export async function keep(path, bytes, written) {
  await request((await open()).transaction(STORE, 'readwrite').objectStore(STORE).put({ path, bytes, written }));
}
