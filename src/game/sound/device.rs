//! The system's default device: WASAPI on Windows, CoreAudio on macOS.

use super::{
    desk::{Desk, Player},
    wishes::next_wish,
};
use cpal::{
    SampleFormat,
    traits::{DeviceTrait, HostTrait, StreamTrait},
};
use std::sync::{Arc, mpsc::Receiver};

/// Plays until the game is over.
///
/// # Errors
/// Why there is no sound, in half a sentence.
pub(super) fn play(desk: &Arc<Desk>, wishes: &Receiver<bool>) -> Result<(), String> {
    let device = cpal::default_host().default_output_device().ok_or("there is no device to play it")?;
    run(&device, desk, wishes).map_err(|error| format!("the device does not play: {error}"))
}

fn run(device: &cpal::Device, desk: &Arc<Desk>, wishes: &Receiver<bool>) -> Result<(), cpal::Error> {
    let supported = device.default_output_config()?;
    // Both systems mix in f32, and take it whatever the device has.
    debug_assert_eq!(supported.sample_format(), SampleFormat::F32);
    let config = supported.config();
    let channels = usize::from(config.channels).max(1);
    let mut player = Player::new(desk.clone(), config.sample_rate);
    let mut samples: Vec<f32> = Vec::new();
    let fill = move |out: &mut [f32], _: &cpal::OutputCallbackInfo| {
        samples.resize(2 * (out.len() / channels), 0.0);
        player.play(&mut samples);
        for (frame, [left, right]) in out.chunks_exact_mut(channels).zip(samples.as_chunks::<2>().0) {
            match frame {
                [one] => *one = 0.5 * (left + right),
                [first, second, rest @ ..] => {
                    (*first, *second) = (*left, *right);
                    rest.fill(0.0);
                }
                [] => {}
            }
        }
    };
    let stream = device.build_output_stream(config, fill, |error| bevy::log::warn!("sound: {error}"), None)?;
    let mut plays = false;
    while let Some(wish) = next_wish(wishes, plays) {
        if wish { stream.play() } else { stream.pause() }?;
        plays = wish;
    }
    Ok(())
}
