//! The synthesiser as a module of its own: `web/worklet.js` runs it on a page's audio thread, which can't share the game's
//! memory. Numbers only go in and out, so that the script needs to know nothing of this memory.

use powder_sound::{Controls, Synthesiser};
use std::cell::RefCell;

/// Frames that a page asks for at once (Web Audio API, "render quantum").
const FRAMES: usize = 128;

/// What plays, and what it is to play.
struct Sound {
    synthesiser: Synthesiser,
    controls: [f32; Controls::ALL.len()],
    frames: [f32; 2 * FRAMES],
}

thread_local! {
    static SOUND: RefCell<Option<Sound>> = const { RefCell::new(None) };
}

fn with<T>(work: impl FnOnce(&mut Sound) -> T) -> Option<T> {
    SOUND.with_borrow_mut(|sound| sound.as_mut().map(work))
}

/// Begins, with `rate` frames a second.
#[unsafe(no_mangle)]
pub extern "C" fn begin(rate: u32) {
    let controls = Controls::SILENT.to_array();
    let sound = Sound { synthesiser: Synthesiser::new(rate), controls, frames: [0.0; 2 * FRAMES] };
    SOUND.set(Some(sound));
}

/// Number of controls.
#[unsafe(no_mangle)]
pub extern "C" fn count() -> u32 {
    Controls::ALL.len() as u32
}

/// Sets a control. One that there is not is none.
#[unsafe(no_mangle)]
pub extern "C" fn set(control: u32, value: f32) {
    with(|sound| {
        if let Some(place) = sound.controls.get_mut(control as usize) {
            *place = value;
        }
    });
}

/// Makes the next 128 frames.
#[unsafe(no_mangle)]
pub extern "C" fn render() {
    with(|sound| sound.synthesiser.render(&Controls::from_array(sound.controls), &mut sound.frames));
}

/// A sample of them: left of the first frame, right of the first frame, left of the second one.
#[unsafe(no_mangle)]
pub extern "C" fn sample(place: u32) -> f32 {
    with(|sound| sound.frames.get(place as usize).copied()).flatten().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_hears_what_the_synthesiser_plays() {
        assert_eq!(sample(0), 0.0, "it has not begun");
        begin(48_000);
        let wind = Controls { wind_level: 0.2, ..Controls::SILENT };
        for (place, value) in wind.to_array().into_iter().enumerate() {
            set(place as u32, value);
        }
        set(count(), 1.0);
        let (mut synthesiser, mut expected) = (Synthesiser::new(48_000), [0.0; 2 * FRAMES]);
        let mut loudest = 0.0_f32;
        for _ in 0..100 {
            render();
            synthesiser.render(&wind, &mut expected);
            let heard: Vec<f32> = (0..2 * FRAMES as u32).map(|place| sample(place)).collect();
            assert_eq!(heard, expected);
            loudest = heard.into_iter().map(f32::abs).fold(loudest, f32::max);
        }
        assert!(loudest > 0.05);
        assert_eq!(sample(2 * FRAMES as u32), 0.0, "there are no more");
    }
}
