// A thread of the kernel.

let panic;
self.powderHost = {
  failed(message) {
    panic = message;
    console.error(message);
  },
};

async function load({ script, module, memory }) {
  const game = await import(script);
  await game.default({ module_or_path: module, memory });
  return game;
}

self.onmessage = async ({ data }) => {
  let game;
  try {
    game = await load(data);
  } catch (error) {
    self.postMessage({ failed: String(error) });
    return;
  }
  self.postMessage('ready');
  try {
    game.work();
  } catch (error) {
    const message = panic ?? String(error);
    self.postMessage({ failed: message });
    // The page hears no message while its own thread waits for what this one was at.
    game.fallen(message);
  }
};
