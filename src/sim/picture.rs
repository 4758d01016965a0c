//! Pictures that carry a world: a PNG like any other, with a save file in a part of its own, which other programs pass over.
//!
//! ```text
//! signature │ part …                                                   (PNG; numbers big-endian)
//!
//! part: length of the body, u32 │ kind, 4 letters │ body │ checksum, u32
//!   "pmWd"  by its letters private, not needed to show the picture, and right however the pixels are changed:
//!           a save file (`sim::checkpoint`), packed by zlib
//! ```
//!
//! The checksums of parts are for programs that have none inside: a world is held to that of its save file. Whoever reads
//! a picture and writes another, as messengers do to make it smaller, drops what it does not know; nothing can be done
//! about that.

use crate::sim::{checkpoint::Checkpoint, file::FileError};
use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};
use std::io::{self, Read, Write};

/// What a picture begins with.
const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Its name in messages.
const NAME: &str = "picture";
/// Kind of the part that is a world.
const WORLD: [u8; 4] = *b"pmWd";
/// Kind of the last part.
const END: [u8; 4] = *b"IEND";
/// Most bytes of a save file in a picture: some eleven million particles. A small file can unpack to a thousand times as much.
const MOST: u64 = 256 << 20;

/// Whether bytes are meant to be a picture.
pub fn is_meant(bytes: &[u8]) -> bool {
    bytes.starts_with(SIGNATURE)
}

/// Reads a world from a save file, or from a picture that carries one.
///
/// # Errors
/// If it is neither, was cut or changed, or holds what no world can.
pub fn read_world(bytes: &[u8]) -> Result<Checkpoint, FileError> {
    if is_meant(bytes) { Checkpoint::decode(&save_in(bytes)?) } else { Checkpoint::decode(bytes) }
}

/// A picture of three bytes a pixel that carries a save file.
///
/// # Errors
/// If the pixels are not as many as it has.
pub fn encode(width: u32, height: u32, pixels: &[u8], save: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.write_chunk(png::chunk::ChunkType(WORLD), &pack(save)?)?;
    writer.finish()?;
    Ok(bytes)
}

/// Packs a save file.
///
/// # Errors
/// None: memory takes all.
pub fn pack(save: &[u8]) -> io::Result<Vec<u8>> {
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    packed.write_all(save)?;
    packed.finish()
}

/// The save file that a picture carries.
fn save_in(bytes: &[u8]) -> Result<Vec<u8>, FileError> {
    unpack(world_part(bytes)?)
}

/// The save file that was packed.
///
/// # Errors
/// If it can't be unpacked.
pub fn unpack(packed: &[u8]) -> Result<Vec<u8>, FileError> {
    let mut save = Vec::new();
    let read = ZlibDecoder::new(packed).take(MOST + 1).read_to_end(&mut save);
    read.map_err(|_| damaged("its world can't be unpacked"))?;
    if save.len() as u64 > MOST {
        return Err(damaged(format_args!("its world unpacks to more than {} MiB", MOST >> 20)));
    }
    Ok(save)
}

fn damaged(what: impl ToString) -> FileError {
    FileError::Damaged(NAME, what.to_string())
}

/// Goes through the parts of a picture, to its end.
fn world_part(bytes: &[u8]) -> Result<&[u8], FileError> {
    let short = || damaged("it breaks off");
    let mut rest = bytes.strip_prefix(SIGNATURE).ok_or(FileError::Foreign(NAME))?;
    let mut world = None;
    loop {
        let (&length, behind) = rest.split_first_chunk().ok_or_else(short)?;
        let (&kind, behind) = behind.split_first_chunk().ok_or_else(short)?;
        let (body, behind) = behind.split_at_checked(u32::from_be_bytes(length) as usize).ok_or_else(short)?;
        let (_checksum, behind) = behind.split_first_chunk::<4>().ok_or_else(short)?;
        match kind {
            WORLD => world = Some(body),
            END => return world.ok_or(FileError::Bare),
            _ => {}
        }
        rest = behind;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::brush::Stroke,
        scene::{self, effects::EffectModes},
        sim::{control, intent::Intent, simulation::Simulation, workers::Workers},
    };
    use glam::Vec2;
    use std::sync::Arc;

    /// A world with wind, water and heat in it, and a picture that carries it.
    fn shared() -> (Simulation, Vec<u8>) {
        let settings = [("columns", "16"), ("rows", "16")].map(|(key, value)| (key.to_owned(), value.to_owned()));
        let blueprint = scene::load("empty").unwrap().build(&settings, None, &EffectModes::new()).unwrap();
        let water = blueprint.elements.find("water").unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        let stroke = Stroke::rectangle(Vec2::new(4.0, 2.0), Vec2::new(8.0, 6.0));
        simulation.push(Intent::Stamp { element: water, stroke }).push(Intent::Warm { stroke, degrees: 40.0 });
        simulation.push(Intent::Blow { stroke, velocity: Vec2::new(30.0, 5.0) }).run(7);
        let pixels: Vec<u8> = (0..3 * 40 * 30).map(|k| (k % 251) as u8).collect();
        let bytes = encode(40, 30, &pixels, &Checkpoint::of(simulation.world()).encode()).unwrap();
        (simulation, bytes)
    }

    fn refusal(bytes: &[u8]) -> String {
        let text = read_world(bytes).expect_err("a bad picture was read").to_string();
        assert!(!text.contains('\n') && text.len() < 300, "not one clear line: {text}");
        text
    }

    #[test]
    fn a_picture_shows_its_pixels_and_its_world_goes_on_as_if_it_had_not_been_away() {
        let (mut simulation, bytes) = shared();
        let mut reader = png::Decoder::new(io::Cursor::new(&bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        reader.finish().expect("other programs read it to its end");
        assert!(pixels.iter().enumerate().all(|(k, &value)| value == (k % 251) as u8));
        let opened = read_world(&bytes).unwrap();
        assert_eq!(opened.state.hash(), simulation.hash());
        let mut again = Simulation::resume(&opened, Workers::single());
        again.run(20);
        simulation.run(20);
        assert_eq!(control::hash(again.world()), simulation.hash(), "it went another way");
    }

    #[test]
    fn half_a_picture_is_refused_wherever_it_breaks_off() {
        let (_, bytes) = shared();
        for len in 0..bytes.len() {
            let text = refusal(&bytes[..len]);
            let says = if len < SIGNATURE.len() { "not a save file" } else { "the picture is damaged: it breaks off" };
            assert!(text.contains(says), "{len} bytes: {text}");
        }
    }

    #[test]
    fn a_changed_world_is_refused_and_a_picture_without_one_says_so() {
        let (_, bytes) = shared();
        let at = bytes.windows(4).position(|window| window == WORLD).unwrap();
        let length = u32::from_be_bytes(bytes[at - 4..at].try_into().unwrap()) as usize;
        let mut changed = bytes.clone();
        for k in (at + 4..at + 4 + length).step_by(11) {
            changed[k] ^= 0x20;
            refusal(&changed);
            changed[k] ^= 0x20;
        }
        let bare = [&bytes[..at - 4], &bytes[at + 8 + length..]].concat();
        assert!(refusal(&bare).contains("a picture without a world"));
        changed[at + 1] = b'x';
        assert!(refusal(&changed).contains("a picture without a world"), "another program's part");
    }

    #[test]
    fn what_unpacks_to_more_than_any_world_is_refused() {
        let mut packed = ZlibEncoder::new(Vec::new(), Compression::fast());
        (0..=MOST >> 20).for_each(|_| packed.write_all(&[0; 1 << 20]).unwrap());
        let text = unpack(&packed.finish().unwrap()).unwrap_err().to_string();
        assert!(text.contains("more than 256 MiB"), "{text}");
    }
}
