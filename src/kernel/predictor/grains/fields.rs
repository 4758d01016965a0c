//! Pairs of fields.

/// Values of cells and of their lower left corners, or of left and of lower faces.
pub(super) type Fields = [Vec<f32>; 2];

/// Two pairs as one.
pub(super) fn both<'a>([a, b]: &'a mut Fields, [c, d]: &'a mut Fields) -> [&'a mut Vec<f32>; 4] {
    [a, b, c, d]
}
