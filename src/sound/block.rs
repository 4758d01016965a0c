//! A block of frames, left and right: what all sounds are made in.

/// Frames of a block. Changing this affects how finely pitches follow their controls, and what a block costs beside its frames.
pub(crate) const LEN: usize = 32;

/// Frames, left and right.
pub(crate) type Block = [[f32; 2]; LEN];

/// Nothing.
pub(crate) const SILENCE: Block = [[0.0; 2]; LEN];
