// Makes sound on the page's audio thread, from what the game last heard of its world.

// Time after which what it heard is no longer played, s: the game hangs, or no longer draws frames.
const STALE = 0.25;

class Sound extends AudioWorkletProcessor {
  constructor({ processorOptions }) {
    super();
    // Bytes and not a module: browsers take no module to this thread.
    this.sound = new WebAssembly.Instance(new WebAssembly.Module(processorOptions.bytes)).exports;
    this.sound.begin(sampleRate);
    this.gain = this.sound.count() - 1;
    this.heard = currentTime;
    this.port.onmessage = ({ data }) => {
      data.forEach((value, control) => this.sound.set(control, value));
      this.heard = currentTime;
    };
  }

  process(_, [[left, right]]) {
    if (currentTime - this.heard > STALE) this.sound.set(this.gain, 0);
    this.sound.render();
    for (let frame = 0; frame < left.length; frame += 1) {
      left[frame] = this.sound.sample(2 * frame);
      right[frame] = this.sound.sample(2 * frame + 1);
    }
    return true;
  }
}

registerProcessor('sound', Sound);
