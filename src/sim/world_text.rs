//! A world as text that a link can carry: a save file, packed by zlib, in the alphabet of links (RFC 4648, section 5, without
//! padding).

use crate::sim::{checkpoint::Checkpoint, file::FileError, picture};
use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use std::io;

/// Most characters of such a text that a link is made of: short of 2¹⁶, so that it can still be pasted and sent. One that is read may be
/// longer.
pub const MOST: usize = 64_000;
/// Its name in messages.
const NAME: &str = "link";

/// The text of a world, however long.
///
/// # Errors
/// None: memory takes all.
pub fn write(world: &Checkpoint) -> io::Result<String> {
    Ok(URL_SAFE_NO_PAD.encode(picture::pack(&world.encode())?))
}

/// The world of a text.
///
/// # Errors
/// If it was cut or changed, or holds what no world can.
pub fn read(text: &str) -> Result<Checkpoint, FileError> {
    let damaged = || FileError::Damaged(NAME, "its world can't be unpacked".to_owned());
    let packed = URL_SAFE_NO_PAD.decode(text).map_err(|_| damaged())?;
    Checkpoint::decode(&picture::unpack(&packed).map_err(|_| damaged())?)
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

    fn world(scene: &str) -> Simulation {
        let blueprint = scene::load(scene).unwrap().build(&[], None, &EffectModes::new()).unwrap();
        let water = blueprint.elements.find("water").unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        let stroke = Stroke::rectangle(Vec2::new(4.0, 2.0), Vec2::new(12.0, 9.0));
        simulation.push(Intent::Stamp { element: water, stroke }).run(7);
        simulation
    }

    #[test]
    fn a_small_world_goes_into_a_link_and_goes_on_as_if_it_had_not_been_away() {
        let mut simulation = world("empty");
        let text = write(&Checkpoint::of(simulation.world())).unwrap();
        assert!(text.len() <= MOST, "{} characters", text.len());
        assert!(text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_".contains(&byte)), "{text}");
        let mut again = Simulation::resume(&read(&text).unwrap(), Workers::single());
        again.run(20);
        simulation.run(20);
        assert_eq!(control::hash(again.world()), simulation.hash());
    }

    #[test]
    fn a_link_that_was_cut_or_changed_is_one_line() {
        let text = write(&Checkpoint::of(world("empty").world())).unwrap();
        for end in (0..text.len()).step_by(97) {
            refused(&text[..end]);
        }
        for at in (0..text.len()).step_by(61) {
            let other = if text.as_bytes()[at] == b'A' { 'B' } else { 'A' };
            refused(&format!("{}{other}{}", &text[..at], &text[at + 1..]));
        }
        for text in ["%", "AAAA", "ä"] {
            refused(text);
        }
    }

    fn refused(text: &str) {
        let error = read(text).expect_err("a bad link was read").to_string();
        assert!(!error.contains('\n') && error.len() < 300, "not one clear line: {error}");
    }
}
