//! What a challenge asks for, and with what it is to be done: words of its file that are checked against the elements.

use crate::{
    kernel::element::ElementTable,
    scene::{
        error::{SceneError, choices},
        number::Range,
    },
};
use glam::DVec2;
use serde::Deserialize;

/// Tools that a challenge can give beside elements, by the names that they have in the palette.
pub const HANDS: [&str; 6] = ["erase", "wind", "pressure", "heat", "degrees", "ignite"];

/// Where a corner may be, m.
const PLACE: Range = Range::real(-1e6, 1e6);
/// Most particles that a condition can ask for.
const MOST: u32 = 1_000_000;

/// What holds while enough of something, or little enough, is somewhere. Counts are in particles of the scene's own
/// spacing, rock included: they mean the same at every detail.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Condition {
    /// Names of the elements that are counted, all together.
    pub of: Vec<String>,
    /// Lower left and upper right corner of the rectangle that is looked at, m. Default: the whole box.
    #[serde(default)]
    pub inside: Option<(DVec2, DVec2)>,
    /// The same, but all that is not in this rectangle is looked at. Default: nothing is left out.
    #[serde(default)]
    pub outside: Option<(DVec2, DVec2)>,
    /// Fewest of them. Default: none need be there.
    #[serde(default)]
    pub at_least: Option<u32>,
    /// Most of them. Default: as many as there are.
    #[serde(default)]
    pub at_most: Option<u32>,
}

impl Condition {
    /// Checks it against the elements that there are.
    pub(super) fn check(&self, file: &str, field: &str, elements: &ElementTable) -> Result<(), SceneError> {
        let fault = |part: &str, what: String| Err(SceneError::value(file, format_args!("{field}.{part}"), what));
        if self.of.is_empty() {
            return fault("of", "empty; allowed: names of elements".to_owned());
        }
        for name in &self.of {
            if elements.find(name).is_none() {
                let known = elements.iter().map(|(_, element)| element.name.as_str());
                return fault("of", format!("no element `{name}`; {}", choices(name, known)));
            }
        }
        for (part, area) in [("inside", self.inside), ("outside", self.outside)] {
            let Some((min, max)) = area else { continue };
            let corners = [min.x, min.y, max.x, max.y];
            if corners.iter().any(|corner| PLACE.check(*corner).is_err()) || !min.cmplt(max).all() {
                return fault(part, "allowed: two corners in m, the second beyond the first in x and y".to_owned());
            }
        }
        let counts = [("at_least", self.at_least, 1), ("at_most", self.at_most, 0)];
        if counts.iter().all(|(_, count, _)| count.is_none()) {
            return fault("at_least", "neither this nor at_most is there; allowed: one of them, or both".to_owned());
        }
        for (part, count, least) in counts {
            if count.is_some_and(|count| !(least..=MOST).contains(&count)) {
                return fault(part, format!("allowed: whole numbers from {least} to {MOST}"));
            }
        }
        Ok(())
    }
}

/// What the player has: names of elements, which are poured or drawn, and of [`HANDS`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(transparent)]
pub struct Means(Vec<String>);

impl Means {
    /// Their names, in the order of the file.
    pub fn iter(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }

    /// Whether something is among them.
    pub fn have(&self, name: &str) -> bool {
        self.0.iter().any(|own| own == name)
    }

    /// Checks them against the elements that there are.
    pub(super) fn check(&self, file: &str, elements: &ElementTable) -> Result<(), SceneError> {
        if self.0.is_empty() {
            return Err(SceneError::value(file, "means", "empty; allowed: names of elements and tools"));
        }
        match self.0.iter().find(|name| elements.find(name).is_none() && !HANDS.contains(&name.as_str())) {
            None => Ok(()),
            Some(name) => {
                let known = elements.iter().map(|(_, element)| element.name.as_str()).chain(HANDS);
                let what = format!("no element or tool `{name}`; {}", choices(name, known));
                Err(SceneError::value(file, "means", what))
            }
        }
    }
}
