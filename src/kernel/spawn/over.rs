//! Drawing over what is there, and taking away one element only.

use super::matter::{EditReport, Matter};
use crate::{brush::Stroke, element::ElementId};
use glam::Vec2;

impl Matter<'_> {
    /// Gives all that is under the stroke another element; nothing is added where nothing is. `places` gets where what moves
    /// became something else, d: what sleeps there has to wake.
    pub fn replace(&mut self, element: ElementId, stroke: &Stroke, places: &mut Vec<Vec2>) -> EditReport {
        let selection = self.under(stroke, |other| other != element);
        EditReport { removed: self.turn_into(element, &selection, places), ..EditReport::default() }
    }

    /// The same with all that hangs together with what is at a point, and is of the same element as that.
    pub fn replace_around(&mut self, element: ElementId, at: Vec2, places: &mut Vec<Vec2>) -> EditReport {
        let selection = self.around(at, |other| other != element);
        EditReport { removed: self.turn_into(element, &selection, places), ..EditReport::default() }
    }

    /// Takes away what is of the element under the stroke, and leaves all else.
    pub fn erase_only(&mut self, element: ElementId, stroke: &Stroke) -> EditReport {
        let selection = self.under(stroke, |other| other == element);
        EditReport { removed: self.remove(&selection), ..EditReport::default() }
    }

    /// Takes away all of the element that hangs together with what is at a point; nothing if that is of another.
    pub fn erase_around(&mut self, element: ElementId, at: Vec2) -> EditReport {
        let selection = self.around(at, |other| other == element);
        EditReport { removed: self.remove(&selection), ..EditReport::default() }
    }
}
