// Sound: from what the game hears of its world to the browser's audio thread.

// Time that a sound has to fade before the audio rests, ms.
const FADE = 400;
const GESTURES = ['pointerdown', 'pointerup', 'keydown'];

// The way from the game to the audio thread, or null where a browser has none, as on a page that is not secure. A browser lets
// no page sound before its first click or key: then all that sound needs is fetched and started.
export function soundOf(files) {
  if (!globalThis.AudioContext || !globalThis.AudioWorkletNode || !isSecureContext) return null;
  let context, node, plays = false, resting;

  async function start() {
    for (const gesture of GESTURES) removeEventListener(gesture, start, { capture: true });
    try {
      // Made within the gesture: later it would stay silent.
      context = new AudioContext({ latencyHint: 'interactive' });
      const [bytes] = await Promise.all([
        fetch(files.module, { credentials: 'same-origin' }).then((response) => response.arrayBuffer()),
        context.audioWorklet.addModule(files.worklet),
      ]);
      const options = { numberOfInputs: 0, outputChannelCount: [2], processorOptions: { bytes } };
      const made = new AudioWorkletNode(context, 'sound', options);
      made.connect(context.destination);
      node = made;
      rest();
    } catch (error) {
      console.warn(`no sound: ${error.message ?? error}`);
    }
  }

  // Nothing is made while nothing is to be heard.
  function rest() {
    clearTimeout(resting);
    if (!node) return;
    if (plays && !document.hidden) context.resume();
    else resting = setTimeout(() => context.suspend(), FADE);
  }

  for (const gesture of GESTURES) addEventListener(gesture, start, { capture: true });
  document.addEventListener('visibilitychange', rest);
  return {
    leave: (controls) => node?.port.postMessage(controls.slice()),
    wish: (wanted) => { plays = wanted; rest(); },
  };
}
