//! What a brush with an element does to what is there.

use crate::game::{edit_icons, icons::Icon};

/// What a brush with an element does to what is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BrushMode {
    /// It pours the element into free room.
    #[default]
    Draw,
    /// It gives what is there the element, and adds nothing where nothing is.
    Replace,
    /// It takes away the element, and leaves all else.
    EraseOnly,
    /// It sets what goes on pouring the element, and what goes on taking all that moves.
    Spring,
}

impl BrushMode {
    /// Its name in messages and for scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Draw => "draw",
            Self::Replace => "replace",
            Self::EraseOnly => "erase only this",
            Self::Spring => "springs and drains",
        }
    }

    /// Its icon.
    pub fn icon(self) -> Icon {
        match self {
            Self::Draw => edit_icons::draw_free,
            Self::Replace => edit_icons::replace,
            Self::EraseOnly => edit_icons::erase_only,
            Self::Spring => edit_icons::spring,
        }
    }

    /// The next one, for a button that goes through them.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Draw => Self::Replace,
            Self::Replace => Self::EraseOnly,
            Self::EraseOnly => Self::Spring,
            Self::Spring => Self::Draw,
        }
    }
}
