//! What a prediction did.

/// What a prediction did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PredictorReport {
    /// Whether anything was liquid. Where nothing is (single drops, spray), velocities stay as they are.
    pub liquid: bool,
    /// Iterations of conjugate gradients.
    pub iterations: u32,
    /// Residual that is left, relative to the right-hand side.
    pub residual: f32,
    /// Whether the solve stopped above its tolerance: at the most iterations, or because it came no further.
    pub unsolved: bool,
    /// Liquid cells whose density error was cut to the feedback's range.
    pub cuts: u64,
}
