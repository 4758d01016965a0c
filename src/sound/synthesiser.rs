//! From controls to samples.

use crate::{
    blast::Blast,
    block::{Block, LEN, SILENCE},
    boil::Boil,
    clatter::Clatter,
    controls::Controls,
    fire::Fire,
    grains::Grains,
    hiss::Hiss,
    limiter::{DELAY, Limiter},
    noise::Chance,
    smooth::Follower,
    splash::Splash,
    stream::Stream,
    wind::Wind,
};

/// Frames a second, if nothing calls for another rate.
pub const DEFAULT_RATE: u32 = 48_000;

/// What is below this is not heard, and is taken away: it would only bring the limiter to act. Hz.
const LOWEST: f32 = 22.0;

/// A sound that goes on from call to call.
#[derive(Clone, Debug)]
pub struct Synthesiser {
    splash: Splash,
    stream: Stream,
    wind: Wind,
    hiss: Hiss,
    clatter: Clatter,
    fire: Fire,
    boil: Boil,
    blast: Blast,
    grains: Grains,
    chance: Chance,
    /// Amplitude of noise that is as loud in each band as at 48 kHz.
    density: f32,
    /// What is too low to be heard, of each side, and how fast it is found.
    lowest: [f32; 2],
    seek: f32,
    gain: Follower,
    limiter: Limiter,
    ready: Block,
    /// Frames of `ready` that were given out.
    given: usize,
    /// Blocks since the last one in which anything sounded.
    quiet: usize,
}

impl Synthesiser {
    /// One that makes `rate` frames a second; 8000 … 192 000, and what is beyond counts as the nearest.
    pub fn new(rate: u32) -> Self {
        let rate = rate.clamp(8000, 192_000) as f32;
        Self {
            splash: Splash::new(rate),
            stream: Stream::new(rate),
            wind: Wind::new(rate),
            hiss: Hiss::new(rate),
            clatter: Clatter::new(rate),
            fire: Fire::new(rate),
            boil: Boil::new(rate),
            blast: Blast::new(rate),
            grains: Grains::new(rate),
            chance: Chance::new(15),
            density: (rate / DEFAULT_RATE as f32).sqrt(),
            lowest: [0.0; 2],
            seek: std::f32::consts::TAU * LOWEST / rate,
            gain: Follower::new(0.03, 0.03, rate),
            limiter: Limiter::new(rate),
            ready: SILENCE,
            given: LEN,
            quiet: usize::MAX,
        }
    }

    /// The next frames: left, right, left, right. `out` has an even length. Allocates nothing.
    pub fn render(&mut self, controls: &Controls, out: &mut [f32]) {
        debug_assert!(out.len().is_multiple_of(2), "a frame is a left sample and a right one");
        let controls = controls.within();
        for frame in out.chunks_exact_mut(2) {
            if self.given == LEN {
                self.next_block(&controls);
            }
            frame.copy_from_slice(&self.ready[self.given]);
            self.given += 1;
        }
    }

    /// Whether nothing has sounded for longer than frames are on their way: what comes next is silence as long as the controls
    /// are silent.
    pub fn is_quiet(&self) -> bool {
        self.quiet > DELAY
    }

    fn next_block(&mut self, controls: &Controls) {
        self.given = 0;
        if self.is_quiet() && controls.is_silent() {
            self.ready = SILENCE;
            return;
        }
        let mut block = self.mix(controls);
        let gain = self.gain.follow(controls.gain);
        let mut peak = 0.0_f32;
        for (k, frame) in block.iter_mut().enumerate() {
            for side in 0..2 {
                let low = &mut self.lowest[side];
                *low += (frame[side] - *low) * self.seek;
                frame[side] = (frame[side] - *low) * gain.at(k);
                peak = peak.max(frame[side].abs());
            }
        }
        self.quiet = if peak < 1e-6 { self.quiet.saturating_add(1) } else { 0 };
        self.limiter.pass(&mut block);
        self.ready = block;
    }

    /// All that sounds.
    fn mix(&mut self, controls: &Controls) -> Block {
        let mut noise = SILENCE;
        self.chance.fill(&mut noise, self.density);
        let (mut out, grains) = (SILENCE, &mut self.grains);
        self.splash.render(controls, &noise, grains, &mut out);
        self.stream.render(controls, &noise, grains, &mut out);
        self.wind.render(controls, &noise, &mut out);
        self.hiss.render(controls, &noise, &mut out);
        self.clatter.render(controls, grains);
        self.fire.render(controls, &noise, grains, &mut out);
        self.boil.render(controls, &noise, grains, &mut out);
        self.blast.render(controls, &noise, &mut out);
        grains.render(&noise, &mut out);
        out
    }
}

impl Default for Synthesiser {
    fn default() -> Self {
        Self::new(DEFAULT_RATE)
    }
}
