// A thread of the kernel.

self.powderHost = { failed: (message) => console.error(message) };

self.onmessage = async ({ data: { script, module, memory } }) => {
  const game = await import(script);
  await game.default({ module_or_path: module, memory });
  self.postMessage('ready');
  game.work();
};
