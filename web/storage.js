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
  // What is refused now may be allowed later.
  database.catch(() => { database = undefined; });
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

// A name that is not taken: `a.pms`, `a-2.pms`, …
function free(path, taken) {
  const ending = path.lastIndexOf('.');
  let name = path;
  for (let number = 2; taken.includes(name); number += 1) {
    name = `${path.slice(0, ending)}-${number}${path.slice(ending)}`;
  }
  return name;
}

// Keeps a file, or throws; says under which name. A new one gets a name of its own, for another page may have taken this one;
// `instead` puts it in the place of what is there.
export async function keep(path, bytes, written, instead = false) {
  // Else the browser may clear it away when space runs out.
  navigator.storage?.persist?.().catch(() => {});
  const transaction = (await open()).transaction(STORE, 'readwrite');
  // What is put in may still be refused when all is written.
  const done = new Promise((resolve, reject) => {
    transaction.oncomplete = resolve;
    transaction.onabort = () => reject(transaction.error ?? new Error('it was not written'));
  });
  const write = async () => {
    const store = transaction.objectStore(STORE);
    const name = instead ? path : free(path, await request(store.getAllKeys()));
    await request(store.put({ path: name, bytes, written }));
    return name;
  };
  const [name] = await Promise.all([write(), done]);
  return name;
}
