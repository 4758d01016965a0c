//! Rock that burns, as wood does.

use super::{audible::Audible, kinds::Kind, listener::Listener, source::Source};
use crate::kernel::solids::centre;

/// What the rock that burns gives off. Rock is only looked through where some of it may.
pub(super) fn listen(audible: &Audible, kinds: &[Kind], listener: Listener) -> Source {
    let mut fire = Source::default();
    let fixed = audible.elements.rows().iter().map(|element| element.fixed);
    let may_burn = kinds.iter().zip(fixed).zip(audible.census);
    if !may_burn.into_iter().any(|((kind, fixed), count)| fixed && kind.burning > 0.0 && *count > 0) {
        return fire;
    }
    let spacing = audible.scale.spacing;
    for (cell, element, _) in audible.rock.iter() {
        let burning = kinds[element.index()].burning;
        if burning > 0.0 {
            fire.add(burning * spacing * spacing, listener.hears(centre(cell) * spacing));
        }
    }
    fire
}
