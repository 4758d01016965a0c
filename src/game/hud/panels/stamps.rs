//! The shelf of stamps: to begin a copy, and to take a stamp up.

use crate::{
    game::{
        actions::{Action, PanelId, Take},
        edit_icons,
        hud::{
            stamps::picture::{Pictures, mesh},
            style::{self, weak},
            widgets::{BUTTON, field},
            window::{MIDDLE, PanelWindow},
        },
        icons::{self, Icon},
        input::bindings::{Bindings, Group, NONE},
        orders::{Order, Orders},
        panels::{Panel, Panels},
        stamps::shelf::{Kept, Shelf},
    },
    sim::state::Setup,
};
use bevy::prelude::{App, KeyCode, Res, ResMut, Result};
use bevy_egui::egui::{Color32, Rect, TextStyle, Ui, Vec2, pos2, vec2};
use tr::tr;

/// Size of a picture, points.
const PICTURE: Vec2 = vec2(104.0, 78.0);
/// Pictures in a row.
const COLUMNS: usize = 4;
/// Between them, points.
const GAP: f32 = 6.0;
/// Height of the buttons, points.
const BUTTON_HEIGHT: f32 = 48.0;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("stamps"),
    title: "Stamps",
    icon: edit_icons::stamp,
    keys: &[(KeyCode::KeyK, NONE)],
    group: Group::Draw,
    help: "stamps: copy, cut and paste pieces of the world",
    in_bar: true,
    in_list: Some("Stamps: copy, cut and paste"),
    stays: false,
};

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<Pictures>();
    Panels::add(app, PANEL, show);
}

/// Shows the shelf.
fn show(
    mut window: PanelWindow,
    mut shelf: ResMut<Shelf>,
    mut pictures: ResMut<Pictures>,
    (setup, bindings): (Res<Setup>, Res<Bindings>),
    mut orders: ResMut<Orders>,
) -> Result {
    let mut order = None;
    window.show(&PANEL, MIDDLE, |ui| {
        let width = COLUMNS as f32 * (PICTURE.x + GAP) - GAP;
        ui.set_width(width);
        ui.spacing_mut().item_spacing = Vec2::splat(GAP);
        ui.horizontal(|ui| {
            for (take, icon, text) in
                [(Take::Copy, edit_icons::copy as Icon, tr!("Copy")), (Take::Cut, edit_icons::cut, tr!("Cut"))]
            {
                let size = vec2((width - GAP) / 2.0, BUTTON_HEIGHT);
                let action = Action::Take(take);
                if button(ui, size, icon, &format!("{text} ({})", bindings.key(action))) {
                    order = Some(Order::Act(action));
                }
            }
        });
        let stamps = shelf.stamps();
        let key = bindings.key(Action::TakeUpStamp);
        ui.label(weak(match stamps {
            [] => tr!("Drag a frame around a piece of the world: it is kept here, also for the next session."),
            _ => tr!(
                "The last ones, the newest first. A click takes one up ({key}: the newest), a click in the world \
                 pastes it.",
                key
            ),
        }));
        for row in stamps.chunks(COLUMNS) {
            ui.horizontal(|ui| {
                for kept in row {
                    if picture(ui, kept, &mut pictures, &setup) {
                        order = Some(Order::TakeUpStamp(kept.number));
                    }
                }
            });
        }
    })?;
    if let Some(order) = order {
        orders.push(order);
        window.close(PANEL.id);
    }
    Ok(())
}

/// A button with an icon and a text beside it; whether it was pressed.
fn button(ui: &mut Ui, size: Vec2, icon: Icon, text: &str) -> bool {
    let (rect, response) = field(ui, size, text, false, BUTTON);
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    let left = rect.center().x - (galley.size().x + 26.0) / 2.0;
    icons::draw(ui.painter(), icons::square(pos2(left + 9.0, rect.center().y), 18.0), icon, style::TEXT);
    ui.painter().galley(pos2(left + 26.0, rect.center().y - galley.size().y / 2.0), galley, Color32::WHITE);
    response.clicked()
}

/// The picture of a stamp; whether it was pressed.
fn picture(ui: &mut Ui, kept: &Kept, pictures: &mut Pictures, setup: &Setup) -> bool {
    let piece = &kept.stamp.piece;
    let (rect, response) = field(ui, PICTURE, &tr!("stamp {}", kept.number), false, BUTTON);
    let size = vec2(piece.size.x as f32, piece.size.y as f32);
    let room = rect.shrink(6.0);
    let shown = Rect::from_center_size(room.center(), size * (room.size() / size).min_elem());
    let at =
        |corner: glam::Vec2| pos2(shown.left() + corner.x * shown.width(), shown.bottom() - corner.y * shown.height());
    let texture = pictures.of(ui.ctx(), kept, setup.elements());
    ui.painter().add(mesh(texture, Color32::WHITE, at));
    let about = tr!("{} × {} cells, {} particles", piece.size.x, piece.size.y, piece.count());
    response.on_hover_text(about).clicked()
}
