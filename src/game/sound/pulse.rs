//! PulseAudio's protocol over its socket, which PipeWire speaks, too: no library of the system is needed.

use super::{
    desk::{Desk, Player},
    wishes::next_wish,
};
use bevy::tasks::block_on;
use pulseaudio::{
    AsPlaybackSource, Client, ClientError,
    protocol::{
        ChannelMap, ChannelVolume, DEFAULT_SINK, PlaybackStreamParams, SampleFormat, SampleSpec,
        stream::{BufferAttr, StreamFlags},
    },
};
use std::sync::{Arc, mpsc::Receiver};

/// Frames a second; a server with another rate converts.
const RATE: u32 = 48_000;
/// Bytes of a frame.
const FRAME: usize = 8;
/// Sound that waits to be played, ms. Raising it makes sound later, lowering it makes a busy machine stutter.
const BUFFER: u32 = 60;
/// Least sound that is asked for at once, ms.
const REQUEST: u32 = 10;

/// Plays until the game is over.
///
/// # Errors
/// Why there is no sound, in half a sentence.
pub(super) fn play(desk: &Arc<Desk>, wishes: &Receiver<bool>) -> Result<(), String> {
    run(desk, wishes).map_err(|error| match error {
        ClientError::ServerUnavailable => "no PulseAudio or PipeWire server is running".to_owned(),
        ClientError::Io(error) => format!("the sound server can't be reached: {error}"),
        error => format!("the sound server refuses: {error}"),
    })
}

fn run(desk: &Arc<Desk>, wishes: &Receiver<bool>) -> Result<(), ClientError> {
    let client = Client::from_env(c"Powder Master")?;
    let mut player = Player::new(desk.clone(), RATE);
    let mut samples: Vec<f32> = Vec::new();
    let source = move |bytes: &mut [u8]| {
        samples.resize(2 * (bytes.len() / FRAME), 0.0);
        player.play(&mut samples);
        let (values, rest) = bytes.as_chunks_mut::<4>();
        values.iter_mut().zip(&samples).for_each(|(bytes, sample)| *bytes = sample.to_le_bytes());
        rest.fill(0);
        bytes.len()
    };
    let stream = block_on(client.create_playback_stream(parameters(), source.as_playback_source()))?;
    let mut plays = false;
    while let Some(wish) = next_wish(wishes, plays) {
        block_on(async { if wish { stream.uncork().await } else { stream.cork().await } })?;
        plays = wish;
    }
    Ok(())
}

/// What the server is asked for: it begins at rest.
fn parameters() -> PlaybackStreamParams {
    let bytes = |milliseconds: u32| RATE / 1000 * milliseconds * FRAME as u32;
    PlaybackStreamParams {
        sample_spec: SampleSpec { format: SampleFormat::Float32Le, channels: 2, sample_rate: RATE },
        channel_map: ChannelMap::stereo(),
        sink_name: Some(DEFAULT_SINK.to_owned()),
        // Else the server may choose none at all.
        cvolume: Some(ChannelVolume::norm(2)),
        buffer_attr: BufferAttr {
            target_length: bytes(BUFFER),
            minimum_request_length: bytes(REQUEST),
            // It begins with what there is: else it would wait for as much as the buffer holds.
            pre_buffering: 0,
            ..BufferAttr::default()
        },
        flags: StreamFlags { start_corked: true, adjust_latency: true, ..StreamFlags::default() },
        ..PlaybackStreamParams::default()
    }
}
