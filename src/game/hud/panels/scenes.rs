//! The scene menu: the scenes that come with the game, and the parameters of each.

use crate::{
    game::{
        actions::PanelId,
        hud::{
            style::{self, weak},
            widgets::{detail_row, line, main_button},
            window::{MIDDLE, PanelWindow},
        },
        icons,
        input::bindings::{Group, NONE},
        orders::{Order, Orders},
        panels::{Panel, Panels, is_open},
    },
    scene::{self, SceneFile},
    sim::state::Setup,
};
use bevy::prelude::{App, IntoScheduleConfigs, KeyCode, Res, ResMut, Resource, Result, Startup, Update, not};
use bevy_egui::egui::{self, Color32, RichText, Ui};
use std::collections::BTreeMap;

/// The scenes to choose from.
#[derive(Resource, Default)]
pub struct SceneMenu {
    scenes: Vec<SceneFile>,
    chosen: Option<usize>,
    values: BTreeMap<String, f64>,
    detail: f64,
}

impl SceneMenu {
    /// The scenes that come with the game, the default one first, the others by title.
    pub fn scenes(&self) -> &[SceneFile] {
        &self.scenes
    }

    /// Looks at a scene, with its parameters as they are in force or by default.
    fn choose(&mut self, index: usize, setup: &Setup) {
        let Some(scene) = self.scenes.get(index) else { return };
        let playing = scene.name() == setup.blueprint.name;
        self.values = scene
            .parameters()
            .iter()
            .map(|(name, spec)| {
                let now = setup.blueprint.parameters.get(name).copied().filter(|_| playing);
                (name.clone(), now.unwrap_or(spec.default))
            })
            .collect();
        self.detail = if playing { setup.asked_detail() } else { 1.0 };
        self.chosen = Some(index);
    }
}

/// Reads the scenes that come with the game.
fn list_scenes(mut menu: ResMut<SceneMenu>) {
    menu.scenes = scene::builtin_names().into_iter().filter_map(|name| scene::load(name).ok()).collect();
    // The default scene first, the rest by title.
    menu.scenes.sort_by(|a, b| (a.name() != "waterfall", a.title()).cmp(&(b.name() != "waterfall", b.title())));
}

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("scenes"),
    title: "Scenes",
    icon: icons::scenes,
    keys: &[(KeyCode::KeyM, NONE)],
    group: Group::World,
    help: "scene menu",
    in_bar: false,
    in_list: None,
    stays: false,
};

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<SceneMenu>();
    Panels::add(app, PANEL, show);
    app.add_systems(Startup, list_scenes).add_systems(Update, forget.run_if(not(is_open(PANEL.id))));
}

/// The next time it opens, it is at the scene that is played.
fn forget(mut menu: ResMut<SceneMenu>) {
    if menu.chosen.is_some() {
        menu.chosen = None;
    }
}

/// Shows the menu.
fn show(mut window: PanelWindow, mut menu: ResMut<SceneMenu>, setup: Res<Setup>, mut orders: ResMut<Orders>) -> Result {
    if menu.chosen.is_none() {
        let playing = menu.scenes.iter().position(|scene| scene.name() == setup.blueprint.name);
        menu.choose(playing.unwrap_or(0), &setup);
    }
    let mut play = false;
    window.show(&PANEL, MIDDLE, |ui| {
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width(190.0);
                let height = ui.ctx().content_rect().height() - 200.0;
                let area = egui::ScrollArea::vertical().id_salt("list").max_height(height);
                area.show(ui, |ui| list(ui, &mut menu, &setup));
            });
            ui.separator();
            ui.vertical(|ui| {
                ui.set_width(320.0);
                play = sheet(ui, &mut menu);
            });
        });
    })?;
    if let (true, Some(scene)) = (play, menu.chosen.and_then(|index| menu.scenes.get(index))) {
        let settings = menu.values.iter().map(|(name, value)| (name.clone(), value.to_string())).collect();
        orders.push(Order::Scene { name: scene.name().to_owned(), settings, detail: menu.detail });
        window.close(PANEL.id);
    }
    Ok(())
}

fn list(ui: &mut Ui, menu: &mut SceneMenu, setup: &Setup) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let mut clicked = None;
    for (index, scene) in menu.scenes.iter().enumerate() {
        let chosen = menu.chosen == Some(index);
        let colour = match scene.name() == setup.blueprint.name {
            true => style::ACCENT,
            false if chosen => Color32::WHITE,
            false => style::TEXT,
        };
        if line(ui, 30.0, 10.0, (scene.title(), colour), chosen).1.clicked() {
            clicked = Some(index);
        }
    }
    if let Some(index) = clicked {
        menu.choose(index, setup);
    }
}

/// What there is to say and to set about the chosen scene; `true` if it is to be played.
fn sheet(ui: &mut Ui, menu: &mut SceneMenu) -> bool {
    let Some(scene) = menu.chosen.and_then(|index| menu.scenes.get(index)) else { return false };
    ui.label(RichText::new(scene.title()).heading().color(Color32::WHITE));
    ui.label(weak(scene.description()));
    ui.add_space(8.0);
    for (name, spec) in scene.parameters() {
        let Some(value) = menu.values.get_mut(name) else { continue };
        ui.label(weak(&spec.description).small());
        let mut slider = egui::Slider::new(value, spec.min..=spec.max).text(name.as_str());
        if spec.integer {
            slider = slider.integer();
        }
        // A range over orders of magnitude is felt by its logarithm.
        ui.add(slider.logarithmic(spec.min > 0.0 && spec.max / spec.min > 100.0));
    }
    if let Some(detail) = detail_row(ui, menu.detail) {
        menu.detail = detail;
    }
    ui.add_space(10.0);
    main_button(ui, "Play").clicked()
}
