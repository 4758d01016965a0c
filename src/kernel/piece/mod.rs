//! A piece of a world that is kept to be put elsewhere, turned and mirrored: what players copy, cut and paste
//! (`spawn` puts it there).

mod cut;
#[cfg(test)]
mod tests;
mod turn;

pub use cut::{Piece, PieceRock, lowest_cell};
pub use turn::Turn;
