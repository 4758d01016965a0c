// Waiting for a state, never for a time: used by the tests of window and page.

import assert from 'node:assert/strict';

export const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

// Most that a state may take, s. A machine that has much else to do must not fail a test; a game that is broken will.
const PATIENCE = 180;

// Looks until `good` holds, and returns what it saw then.
export async function poll(what, look, good, patience = PATIENCE) {
  for (const end = Date.now() + 1000 * patience; ;) {
    const now = await look();
    if (good(now)) return now;
    assert.ok(Date.now() < end, `${what}: not within ${patience} s; at last: ${JSON.stringify(now)}`);
    await sleep(50);
  }
}

// The one thing that can be pressed under a name (or a pattern of one); none if there is no such thing, or it can't be
// pressed now.
export function pressable(widgets, name) {
  const isIt = (other) => (name instanceof RegExp ? name.test(other) : name === other);
  const named = widgets.filter((widget) => isIt(widget.name) && widget.kind !== 'Label' && widget.kind !== 'Window');
  assert.ok(named.length < 2, `${named.length} things are called ${name}`);
  return named.find(({ enabled }) => enabled);
}

export const near = ([a, b], [c, d]) => Math.abs(a - c) < 1 && Math.abs(b - d) < 1;

export const middle = ({ place: [x, y, width, height] }) => [Math.round(x + width / 2), Math.round(y + height / 2)];

export const isOpen = (widgets, window) => widgets.some(({ kind, name }) => kind === 'Window' && name === window);
