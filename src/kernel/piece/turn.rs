//! The eight ways in which a piece can lie.

use glam::{IVec2, Vec2, Vec2Swizzles};
use serde::{Deserialize, Serialize};

/// How a piece is turned and mirrored: along which axis of the piece each axis of the world lies, and which way. Turned
/// four times, or mirrored twice, it is what it was, to the bit: nothing is computed before the piece is put somewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Turn {
    /// Whether x and y of the piece change places.
    swapped: bool,
    /// Whether left and right change places then.
    across: bool,
    /// Whether top and bottom change places then.
    upside_down: bool,
}

impl Turn {
    /// A quarter turn further, to the left.
    #[must_use]
    pub fn quarter(self) -> Self {
        Self { swapped: !self.swapped, across: !self.upside_down, upside_down: self.across }
    }

    /// Left and right change places.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { across: !self.across, ..self }
    }

    /// Top and bottom change places.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self { upside_down: !self.upside_down, ..self }
    }

    /// Cells along x and y of a piece of `size` cells that lies so.
    pub fn size(self, size: IVec2) -> IVec2 {
        if self.swapped { size.yx() } else { size }
    }

    /// Where a place of a piece of `size` cells is then, d from the lower left corner.
    pub fn place(self, at: Vec2, size: IVec2) -> Vec2 {
        let (at, size) = (if self.swapped { at.yx() } else { at }, self.size(size).as_vec2());
        let x = if self.across { size.x - at.x } else { at.x };
        let y = if self.upside_down { size.y - at.y } else { at.y };
        Vec2::new(x, y)
    }

    /// Where a cell of it is then.
    pub fn cell(self, cell: IVec2, size: IVec2) -> IVec2 {
        let (cell, last) = (if self.swapped { cell.yx() } else { cell }, self.size(size) - 1);
        let x = if self.across { last.x - cell.x } else { cell.x };
        let y = if self.upside_down { last.y - cell.y } else { cell.y };
        IVec2::new(x, y)
    }

    /// Which way a direction of it points then.
    pub fn direction(self, way: Vec2) -> Vec2 {
        let way = if self.swapped { way.yx() } else { way };
        Vec2::new(if self.across { -way.x } else { way.x }, if self.upside_down { -way.y } else { way.y })
    }
}
