//! Screen readers in a page. A browser knows nothing of what is drawn on a canvas, so the page says the messages of the game, and
//! which control of the HUD has come into focus, was pressed or was changed.

use crate::{game::toasts::Toasts, web::host};
use bevy::prelude::{App, Last, Local, Query, Res};
use bevy_egui::EguiOutput;

/// Says what happens.
pub(super) fn plugin(app: &mut App) {
    app.add_systems(Last, (say_messages, say_controls));
}

fn say_messages(toasts: Res<Toasts>, mut said: Local<Vec<String>>) {
    if said.iter().map(String::as_str).eq(toasts.texts()) {
        return;
    }
    toasts.texts().filter(|text| !said.iter().any(|other| other == text)).for_each(host::say);
    *said = toasts.texts().map(str::to_owned).collect();
}

fn say_controls(outputs: Query<&EguiOutput>) {
    let texts = outputs.iter().map(|output| output.platform_output.events_description());
    texts.filter(|text| !text.is_empty()).for_each(|text| host::say(&text));
}
