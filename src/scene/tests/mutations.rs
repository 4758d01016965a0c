//! No text makes the program panic: whatever happens to a scene file, it builds or says one line.

use super::read;
use crate::{
    kernel::random::Random,
    scene::{builtin, builtin_names, effects::EffectModes},
};

/// Mutated files per scene.
const ROUNDS: u32 = 400;

/// What replaces numbers and lands between other things.
const TOKENS: [&str; 22] = [
    "0",
    "-1",
    "0.5",
    "1e9",
    "1e-9",
    "1e308",
    "-1e308",
    "1e999",
    "NaN",
    "inf",
    "4294967296",
    "\"d\"",
    "\"1/0\"",
    "\"((((\"",
    "\"rock\"",
    "(",
    ")",
    "[",
    "}",
    ",",
    "é",
    "\0",
];

fn mutate(text: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(text.len().max(1));
    let end = (at + 1 + random.below(40)).min(text.len());
    let token = TOKENS[random.below(TOKENS.len())].bytes();
    match random.below(6) {
        0 => text[at] ^= 1 << random.below(8),
        1 => drop(text.drain(at..end)),
        2 => {
            let copy = text[at..end].to_vec();
            let to = random.below(text.len().max(1));
            text.splice(to..to, copy);
        }
        3 => drop(text.splice(at..at, token)),
        _ => {
            // The next number: changed files stay well-formed, so that the later checks are reached.
            let numeric = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
            let Some(start) = text[at..].iter().position(numeric).map(|ahead| at + ahead) else { return };
            let length = text[start..].iter().take_while(|byte| numeric(byte)).count();
            drop(text.splice(start..start + length, token));
        }
    }
}

#[test]
fn a_damaged_scene_is_an_error_and_never_a_panic() {
    let mut random = Random::new(0x2545_F491);
    let (mut built, mut refused) = (0, 0);
    for name in builtin_names() {
        let original = builtin::find(name).expect(name).bytes.into_owned();
        for _ in 0..ROUNDS {
            let mut text = original.clone();
            for _ in 0..=random.below(3) {
                mutate(&mut text, &mut random);
            }
            match read(&text).and_then(|file| file.build(&[], None, &EffectModes::new())) {
                Ok(world) => {
                    assert!(world.particles.len() + world.solids.count() <= world.particle_limit as usize);
                    assert!(world.particles.x.iter().chain(&world.particles.vx).all(|value| value.is_finite()));
                    built += 1;
                }
                Err(error) => {
                    assert!(!error.to_string().contains('\n'));
                    refused += 1;
                }
            }
        }
    }
    assert!(built > 100 && refused > 1000, "the mutations are too mild or too wild: {built} built, {refused} refused");
}
