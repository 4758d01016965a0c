//! Files that are dragged over the window and dropped on it.

use crate::game::orders::{Order, Orders};
use bevy::{
    prelude::{MessageReader, ResMut, Resource},
    window::{FileDragAndDrop, WindowEvent},
};

/// Names of the files that hang over the window, for the HUD to show.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Hovering(pub Vec<String>);

/// Notes what hangs over the window, and asks for what is dropped to be opened.
pub fn read_drops(mut events: MessageReader<WindowEvent>, mut hovering: ResMut<Hovering>, mut orders: ResMut<Orders>) {
    for event in events.read() {
        let WindowEvent::FileDragAndDrop(event) = event else { continue };
        match event {
            FileDragAndDrop::HoveredFile { path_buf, .. } => {
                let name = path_buf.file_name().unwrap_or(path_buf.as_os_str()).to_string_lossy().into_owned();
                if !hovering.0.contains(&name) {
                    hovering.0.push(name);
                }
            }
            FileDragAndDrop::HoveredFileCanceled { .. } => hovering.0.clear(),
            FileDragAndDrop::DroppedFile { path_buf, .. } => {
                hovering.0.clear();
                orders.push(Order::Load(path_buf.clone()));
            }
        }
    }
}
