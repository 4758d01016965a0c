//! The panels of the HUD: the row that each brings along, and which of them are open. The bar, the touch list, keys and
//! help follow from the rows.

use crate::game::{
    actions::{Action, PanelId},
    icons::Icon,
    input::bindings::{Binding, Bindings, Group, Mods, Trigger},
};
use bevy::{
    ecs::{
        schedule::{IntoScheduleConfigs, SystemSet},
        system::ScheduleSystem,
    },
    prelude::{App, KeyCode, Res, Resource},
};
use bevy_egui::EguiPrimaryContextPass;

/// A panel: what its file says of it.
#[derive(Clone, Copy)]
pub struct Panel {
    /// Name by which orders and other panels call it; unique.
    pub id: PanelId,
    /// Heading of its window.
    pub title: &'static str,
    /// Its icon in the bar.
    pub icon: Icon,
    /// The keys that open and close it, with their modifiers.
    pub keys: &'static [(KeyCode, Mods)],
    /// Where the help shows it.
    pub group: Group,
    /// What help and tooltip say.
    pub help: &'static str,
    /// Whether the bar has a button for it.
    pub in_bar: bool,
    /// Its line in the touch list, if it has one there.
    pub in_list: Option<&'static str>,
    /// Whether it is looked at beside the game: Esc leaves it open, and it goes with the HUD when that is hidden.
    pub stays: bool,
}

/// The stages of a frame of the HUD.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HudSystems {
    /// The style, the scale and what is read for the bars.
    Begin,
    /// The bars, and the space that they leave to the world.
    Bars,
    /// The panels, in the order in which they were added.
    Panels,
    /// Messages, and what the HUD covers.
    End,
}

/// The place of a panel among the others.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Place(usize);

/// All panels, and what of the HUD is open.
#[derive(Resource)]
pub struct Panels {
    /// Whether the HUD is shown at all.
    pub visible: bool,
    all: Vec<(Panel, bool)>,
}

impl Default for Panels {
    fn default() -> Self {
        Self { visible: true, all: Vec::new() }
    }
}

impl Panels {
    /// Adds a panel to the game, with the system that shows it while it is open.
    pub fn add<M>(app: &mut App, panel: Panel, show: impl IntoScheduleConfigs<ScheduleSystem, M>) {
        let mut panels = app.world_mut().get_resource_or_init::<Self>();
        let place = Place(panels.all.len());
        panels.all.push((panel, false));
        let mut bindings = app.world_mut().get_resource_or_init::<Bindings>();
        for &(key, mods) in panel.keys {
            let (trigger, action) = (Trigger::Key(key), Action::Panel(panel.id));
            bindings.add(Binding { trigger, mods, action, group: panel.group, help: panel.help });
        }
        if let Some(before) = place.0.checked_sub(1) {
            app.configure_sets(EguiPrimaryContextPass, Place(before).before(place));
        }
        app.configure_sets(EguiPrimaryContextPass, place.in_set(HudSystems::Panels))
            .add_systems(EguiPrimaryContextPass, show.in_set(place).run_if(is_open(panel.id)));
    }

    /// The panels in the order in which they were added, and whether each is open.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (&Panel, bool)> {
        self.all.iter().map(|(panel, open)| (panel, *open))
    }

    /// Whether a panel is open, and the HUD with it is shown.
    pub fn shows(&self, id: PanelId) -> bool {
        self.visible && self.all.iter().any(|(panel, open)| panel.id == id && *open)
    }

    /// Opens a panel, or closes it. What is opened is seen, even if the HUD was hidden.
    pub fn toggle(&mut self, id: PanelId) {
        let opened = self.set(id, |open| !open);
        self.visible |= opened;
    }

    /// Closes a panel.
    pub fn close(&mut self, id: PanelId) {
        self.set(id, |_| false);
    }

    /// Closes all but those that stay.
    pub fn close_all(&mut self) {
        self.all.iter_mut().for_each(|(panel, open)| *open &= panel.stays);
    }

    /// Shows the HUD, or hides it; not while a panel is open that Esc would close.
    pub fn turn_hud(&mut self) {
        self.visible = !self.visible || self.all.iter().any(|(panel, open)| *open && !panel.stays);
    }

    fn set(&mut self, id: PanelId, to: impl Fn(bool) -> bool) -> bool {
        let panel = self.all.iter_mut().find(|(panel, _)| panel.id == id);
        debug_assert!(panel.is_some(), "there is no panel called {id:?}");
        panel.is_some_and(|(_, open)| {
            *open = to(*open);
            *open
        })
    }
}

/// Run condition: a panel is open and seen.
pub fn is_open(id: PanelId) -> impl Fn(Res<Panels>) -> bool + Clone {
    move |panels: Res<Panels>| panels.shows(id)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panels() -> Panels {
        let row = |id, stays| Panel {
            id: PanelId(id),
            title: id,
            icon: crate::game::icons::gear,
            keys: &[],
            group: Group::Look,
            help: id,
            in_bar: true,
            in_list: None,
            stays,
        };
        Panels { visible: true, all: vec![(row("details", true), false), (row("help", false), false)] }
    }

    #[test]
    fn what_is_opened_is_seen_and_escape_leaves_what_stays() {
        let (details, help) = (PanelId("details"), PanelId("help"));
        let mut panels = panels();
        panels.visible = false;
        panels.toggle(details);
        assert!(panels.shows(details));
        panels.toggle(help);
        panels.close_all();
        assert!(panels.shows(details) && !panels.shows(help));
        panels.turn_hud();
        assert!(!panels.shows(details), "it goes with the HUD");
        panels.turn_hud();
        assert!(panels.shows(details), "and comes back with it");
        panels.toggle(details);
        assert!(!panels.shows(details) && panels.visible);
    }

    #[test]
    fn the_hud_is_not_hidden_under_a_panel_that_waits_for_an_answer() {
        let mut panels = panels();
        panels.toggle(PanelId("help"));
        panels.turn_hud();
        assert!(panels.shows(PanelId("help")));
    }
}
