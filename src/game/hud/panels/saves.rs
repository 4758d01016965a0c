//! The list of save files.

use crate::{
    game::{
        actions::PanelId,
        disk,
        hud::{
            style::{self, weak},
            widgets::{LINE, field},
            window::{MIDDLE, PanelWindow},
        },
        icons,
        input::bindings::{CTRL, Group},
        language::{grouped, spoken},
        orders::{Order, Orders},
        panels::{Panel, Panels, is_open},
        saves::{self, LoadError, SaveFolders, Summary},
    },
    kernel::units::TICKS_PER_SECOND,
};
use bevy::prelude::{App, IntoScheduleConfigs, KeyCode, Res, ResMut, Resource, Result, Update, not};
use bevy_egui::egui::{self, Align2, Color32, TextStyle, Ui, pos2, vec2};
use std::path::PathBuf;
use tr::tr;

/// Size of a row, points.
const ROW: egui::Vec2 = vec2(430.0, 42.0);

/// The files as they were when the list was opened.
#[derive(Resource, Default)]
pub struct SaveMenu {
    open: bool,
    files: Vec<SaveFile>,
}

impl SaveMenu {
    /// Whether there are files of which it is not known yet what is in them.
    pub fn is_reading(&self) -> bool {
        self.files.iter().any(|file| file.summary.is_none())
    }
}

struct SaveFile {
    path: PathBuf,
    age: String,
    /// What is in it, once it was read.
    summary: Option<Result<Summary, LoadError>>,
}

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("saves"),
    title: "Load",
    icon: icons::load,
    keys: &[(KeyCode::KeyO, CTRL)],
    group: Group::World,
    help: "load a saved world (can be undone)",
    in_bar: true,
    in_list: Some("Load"),
    stays: false,
};

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<SaveMenu>();
    Panels::add(app, PANEL, show);
    app.add_systems(Update, forget.run_if(not(is_open(PANEL.id))));
}

/// The next time it opens, the files are listed anew.
fn forget(mut menu: ResMut<SaveMenu>) {
    if menu.open {
        *menu = SaveMenu::default();
    }
}

/// Shows the list.
fn show(
    mut window: PanelWindow,
    mut menu: ResMut<SaveMenu>,
    folders: Res<SaveFolders>,
    mut orders: ResMut<Orders>,
) -> Result {
    if !menu.open {
        *menu = SaveMenu { open: true, files: list(&folders) };
    }
    // One a frame: a hundred large files must not hold a frame up.
    if let Some(file) = menu.files.iter_mut().find(|file| file.summary.is_none()) {
        file.summary = Some(Summary::read(&file.path));
    }
    let mut chosen = None;
    window.show(&PANEL, MIDDLE, |ui| {
        ui.set_width(ROW.x);
        if menu.files.is_empty() {
            ui.label(weak(tr!("No saved world yet.")));
        }
        egui::ScrollArea::vertical().max_height(ui.ctx().content_rect().height() - 220.0).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            for file in &menu.files {
                if row(ui, file) {
                    chosen = Some(file.path.clone());
                }
            }
        });
        #[cfg(target_arch = "wasm32")]
        if ui.button(tr!("Open a file of this device")).clicked() {
            disk::choose();
        }
        #[cfg(target_arch = "wasm32")]
        if ui.button(tr!("Copy a link to this world")).clicked() {
            orders.push(Order::Act(crate::game::actions::Action::CopyLink));
        }
        ui.label(weak(tr!("Saves, screenshots, recordings and scenes can also be dropped on the window.")));
        for folder in &folders.0 {
            ui.label(weak(folder.display().to_string()).small());
        }
    })?;
    if let Some(path) = chosen {
        orders.push(Order::Load(path));
        window.close(PANEL.id);
    }
    Ok(())
}

fn list(folders: &SaveFolders) -> Vec<SaveFile> {
    let files = saves::list(&folders.0).into_iter();
    files
        .map(|(path, written)| {
            let age = disk::now().duration_since(written).unwrap_or_default();
            SaveFile { path, age: age_text(age.as_secs()), summary: None }
        })
        .collect()
}

/// How long ago, in words.
fn age_text(seconds: u64) -> String {
    match seconds {
        0..60 => tr!("just now"),
        60..3600 => tr!("{n} minute ago" | "{n} minutes ago" % seconds / 60),
        3600..86_400 => tr!("{n} hour ago" | "{n} hours ago" % seconds / 3600),
        _ => tr!("{n} day ago" | "{n} days ago" % seconds / 86_400),
    }
}

/// A line of the list; `true` if it is clicked.
fn row(ui: &mut Ui, file: &SaveFile) -> bool {
    let name = file.path.file_name().unwrap_or_default().to_string_lossy();
    let (rect, response) = field(ui, ROW, &name, false, LINE);
    let font = |text: TextStyle| text.resolve(ui.style());
    let (large, small) = (font(TextStyle::Button), font(TextStyle::Small));
    let (title, about, colour) = match &file.summary {
        None => (name.to_string(), String::new(), style::WEAK),
        Some(Err(error)) => (name.to_string(), error.to_string(), style::WARN),
        Some(Ok(summary)) => {
            let seconds = summary.tick as f64 / f64::from(TICKS_PER_SECOND);
            let (tick, particles) = (grouped(summary.tick), grouped(summary.particles as u64));
            let seconds = format!("{seconds:.1}");
            let about = tr!("tick {tick} ({seconds} s), {particles} particles", tick, seconds, particles);
            (spoken(&summary.title), about, Color32::WHITE)
        }
    };
    let painter = ui.painter().with_clip_rect(rect.shrink(2.0));
    let (left, right) = (rect.left() + 10.0, rect.right() - 10.0);
    let (upper, lower) = (rect.top() + 13.0, rect.bottom() - 11.0);
    painter.text(pos2(left, upper), Align2::LEFT_CENTER, title, large, colour);
    painter.text(pos2(right, upper), Align2::RIGHT_CENTER, &file.age, small.clone(), style::WEAK);
    painter.text(pos2(left, lower), Align2::LEFT_CENTER, about, small, style::WEAK);
    response.on_hover_text(name).clicked()
}

#[cfg(test)]
mod tests {
    use super::age_text;

    #[test]
    fn ages_are_told_in_the_largest_unit() {
        for (seconds, text) in [
            (3, "just now"),
            (60, "1 minute ago"),
            (7300, "2 hours ago"),
            (90_000, "1 day ago"),
            (200_000, "2 days ago"),
        ] {
            assert_eq!(age_text(seconds), text);
        }
    }
}
