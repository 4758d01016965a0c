//! What is being mixed.

use super::{
    likeness::{free_name, like},
    own::OwnElements,
};
use crate::{
    game::{toolbox::Toolbox, tools::Tool},
    kernel::element::{Element, ElementId, ElementTable},
    scene,
};
use bevy::prelude::{Res, ResMut, Resource};
use std::sync::Arc;

/// The element in the making.
#[derive(Resource, Clone, Debug)]
pub struct MixerDesk {
    /// Elements that come with the game.
    pub standard: Arc<ElementTable>,
    /// The element in the making, once one was begun.
    pub draft: Option<Element>,
    /// The name of what it was begun like.
    pub base: String,
}

impl Default for MixerDesk {
    fn default() -> Self {
        Self { standard: scene::elements().unwrap_or_default(), draft: None, base: String::new() }
    }
}

impl MixerDesk {
    /// Begins with an element of a world: with a new one that is like it, or, if it is one of the player's own, with that.
    pub fn begin(&mut self, elements: &ElementTable, base: ElementId, own: &OwnElements) {
        let row = elements.get(base);
        if self.standard.find(&row.name).is_none() {
            return self.go_on_with(Element { key: None, ..row.clone() });
        }
        let made = ElementTable::new(own.iter().cloned().collect());
        row.name.clone_into(&mut self.base);
        self.draft = Some(like(elements, base, &free_name(&row.name, &[&self.standard, elements, &made])));
    }

    /// Goes on with an element that was made before.
    pub fn go_on_with(&mut self, element: Element) {
        element.name.clone_into(&mut self.base);
        self.draft = Some(element);
    }

    /// Begins with the element that is in hand, if none is begun yet.
    pub fn begin_with_tool(&mut self, elements: &ElementTable, tools: &Toolbox, own: &OwnElements) {
        if self.draft.is_some() {
            return;
        }
        let in_hand = match tools.tool {
            Tool::Element(id) => Some(id),
            Tool::Other(_) => elements.find("water"),
        };
        if let Some(base) = in_hand.or_else(|| elements.iter().next().map(|(id, _)| id)) {
            self.begin(elements, base, own);
        }
    }
}

/// Takes up the elements that the player made in sessions before.
pub fn read_own(desk: Res<MixerDesk>, mut own: ResMut<OwnElements>) {
    *own = OwnElements::of_user(&desk.standard);
}
