//! The head-up display, in egui: a bar with the numbers and menus on top, the palette at the bottom, windows on call.
//! It reads the world and gives orders; it never changes the world itself.

pub mod accuracy;
pub mod bar;
pub mod brush;
pub mod cases;
#[cfg(not(target_arch = "wasm32"))]
pub mod crash;
pub mod details;
pub mod help;
pub mod icons;
pub mod palette;
pub mod saves;
pub mod scenes;
pub mod search;
pub mod settings;
pub mod split;
pub mod stats;
pub mod style;
pub mod toast;
pub mod touch;

use crate::{
    game::{
        camera::Area,
        input::{bindings::Action, keys::Typing, pointer::HudCover, touch::Fingers},
    },
    lab::{self, exam::ExamCase, gauntlet::GauntletCase},
};
use bevy::platform::time::Instant;
use bevy::prelude::{App, IntoScheduleConfigs, Plugin, PreUpdate, Query, Res, ResMut, Resource, Startup, not};
use bevy_egui::{EguiContext, EguiContexts, EguiInput, EguiPreUpdateSet, EguiPrimaryContextPass, egui};
use glam::Vec2;

/// Shows the HUD.
pub struct HudPlugin;

impl Plugin for HudPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins((lab::cases::plugin::<ExamCase>, lab::cases::plugin::<GauntletCase>))
            .init_resource::<stats::Readings>()
            .init_resource::<settings::UiScale>()
            .init_resource::<HudCost>()
            .init_resource::<scenes::SceneMenu>()
            .init_resource::<saves::SaveMenu>()
            .init_resource::<accuracy::AccuracyPanel>()
            .add_systems(Startup, (scenes::list_scenes, greet))
            .add_systems(PreUpdate, mind_the_keys.after(EguiPreUpdateSet::ProcessInput))
            .add_systems(
                EguiPrimaryContextPass,
                (
                    begin,
                    settings::scale_to_window,
                    stats::read,
                    (bar::show, palette::show).chain().run_if(not(touch::in_use)),
                    touch::show.run_if(touch::in_use),
                    settings::make_room,
                    brush::show,
                    scenes::show,
                    saves::show,
                    search::show,
                    details::show,
                    (cases::show::<ExamCase>, cases::show::<GauntletCase>).chain(),
                    split::show,
                    accuracy::show,
                    settings::show,
                    help::show,
                    toast::show,
                    end,
                )
                    .chain(),
            );
        #[cfg(not(target_arch = "wasm32"))]
        app.add_systems(EguiPrimaryContextPass, crash::show.after(settings::show).before(help::show));
    }
}

/// What of the HUD is open.
#[derive(Resource, Clone, Debug, PartialEq, Eq)]
pub struct HudState {
    /// Whether it is shown at all.
    pub visible: bool,
    /// The table of keys.
    pub help: bool,
    /// The books of the simulation.
    pub details: bool,
    /// The physics exam.
    pub exam: bool,
    /// The stability gauntlet.
    pub gauntlet: bool,
    /// What accuracy costs.
    pub accuracy: bool,
    /// All measures, in the panel of what accuracy costs.
    pub measures: bool,
    /// The scene menu.
    pub scenes: bool,
    /// The list of save files.
    pub saves: bool,
    /// The settings.
    pub settings: bool,
    /// What is typed into the search for elements, if it is open.
    pub search: Option<String>,
}

impl Default for HudState {
    fn default() -> Self {
        Self {
            visible: true,
            help: false,
            details: false,
            exam: false,
            gauntlet: false,
            accuracy: false,
            measures: false,
            scenes: false,
            saves: false,
            settings: false,
            search: None,
        }
    }
}

impl HudState {
    /// Opens, closes, shows or hides a part.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::Hud => self.visible = !self.visible,
            Action::Help => self.help = !self.help,
            Action::Details => self.details = !self.details,
            Action::Exam => self.exam = !self.exam,
            Action::Gauntlet => self.gauntlet = !self.gauntlet,
            Action::Accuracy => self.accuracy = !self.accuracy,
            Action::Scenes => self.scenes = !self.scenes,
            Action::Saves => self.saves = !self.saves,
            Action::Settings => self.settings = !self.settings,
            Action::Search => {
                self.search = match self.search {
                    None => Some(String::new()),
                    Some(_) => None,
                };
            }
            Action::Close => {
                let Self { visible, details, accuracy, measures, .. } = *self;
                *self = Self { visible, details, accuracy, measures, ..Self::default() };
            }
            _ => return,
        }
        // What is asked for is shown, even if the HUD was hidden.
        self.visible |= action == Action::Accuracy && self.accuracy;
        self.visible |= self.help
            || self.exam
            || self.gauntlet
            || self.scenes
            || self.saves
            || self.settings
            || self.search.is_some();
    }
}

/// Frames of which the cost is kept for the median.
const HISTORY: usize = 64;

/// Processor time of a frame's HUD, without turning it into triangles.
#[derive(Resource, Clone, Debug, Default)]
pub struct HudCost {
    recent: Vec<f32>,
    next: usize,
    begun: Option<Instant>,
}

impl HudCost {
    /// Median over the last frames, ms.
    pub fn milliseconds(&self) -> f32 {
        let mut sorted = self.recent.clone();
        sorted.sort_unstable_by(f32::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    }

    fn note(&mut self, milliseconds: f32) {
        match self.recent.get_mut(self.next) {
            Some(slot) => *slot = milliseconds,
            None => self.recent.push(milliseconds),
        }
        self.next = (self.next + 1) % HISTORY;
    }
}

/// What a newcomer needs to know.
fn greet(mut toasts: ResMut<toast::Toasts>, fingers: Res<Fingers>) {
    toasts.say(if fingers.in_use {
        "One finger draws, two move and zoom"
    } else {
        "Left button pours, right button erases, F1 shows all keys"
    });
}

fn begin(mut cost: ResMut<HudCost>, mut contexts: EguiContexts, mut styled: bevy::prelude::Local<bool>) {
    cost.begun = Some(Instant::now());
    if let (false, Ok(context)) = (*styled, contexts.ctx_mut()) {
        style::dress(context);
        *styled = true;
    }
}

fn end(mut cost: ResMut<HudCost>, mut cover: ResMut<HudCover>, mut contexts: EguiContexts) {
    if let Ok(context) = contexts.ctx_mut() {
        note_cover(context, &mut cover);
    }
    if let Some(begun) = cost.begun.take() {
        cost.note(begun.elapsed().as_secs_f32() * 1000.0);
    }
}

/// Notes which parts of the window the HUD has.
fn note_cover(context: &egui::Context, cover: &mut HudCover) {
    let zoom = context.zoom_factor();
    cover.menu = egui::Popup::is_any_open(context);
    cover.parts.clear();
    for layer in context.memory(|memory| memory.areas().visible_layer_ids()) {
        // The root, behind everything, fills the window.
        if layer.order == egui::Order::Background {
            continue;
        }
        if let Some(area) = egui::AreaState::load(context, layer.id).filter(|area| area.interactable) {
            let (min, max) = (area.rect().min, area.rect().max);
            cover.parts.push(Area { min: Vec2::new(min.x, min.y) * zoom, max: Vec2::new(max.x, max.y) * zoom });
        }
    }
}

/// Keys belong to the game unless a text field has them; egui would move its focus with Tab and arrows and press what
/// is focused with Space.
fn mind_the_keys(mut contexts: Query<(&mut EguiContext, &mut EguiInput)>, mut typing: ResMut<Typing>) {
    for (mut context, mut input) in &mut contexts {
        let in_text = context.get_mut().text_edit_focused();
        typing.0 = in_text;
        if !in_text {
            input.events.retain(|event| {
                !matches!(event, egui::Event::Key { key, .. } if *key != egui::Key::Escape)
                    && !matches!(event, egui::Event::Text(_))
            });
        }
    }
}
