//! Numbers that look random and follow from what they are made of, so that no order and no thread shows in them.

/// Scrambles a number (the finaliser of MurmurHash3): neighbouring numbers become unrelated ones.
pub fn mix(mut word: u32) -> u32 {
    word ^= word >> 16;
    word = word.wrapping_mul(0x85eb_ca6b);
    word ^= word >> 13;
    word = word.wrapping_mul(0xc2b2_ae35);
    word ^ (word >> 16)
}

/// The low 16 bits as a number in −1 … 1.
pub fn unit(bits: u32) -> f32 {
    (bits & 0xffff) as f32 / 32_767.5 - 1.0
}
