//! The window as a whole: full screen and screenshots.

use crate::{
    game::{disk, files, toasts::Toasts},
    sim::{
        checkpoint::Checkpoint,
        new_file::Unwritten,
        picture,
        state::{Clock, Setup},
    },
};
use bevy::{
    image::Image,
    prelude::{On, ResMut, With, World},
    render::view::screenshot::{Screenshot, ScreenshotCaptured},
    window::{MonitorSelection, PrimaryWindow, Window, WindowMode},
};
use std::{env, error::Error, path::PathBuf};
use tr::tr;

/// Covers the monitor, or goes back to a window.
pub fn toggle_full_screen(world: &mut World) {
    let mut windows = world.query_filtered::<&mut Window, With<PrimaryWindow>>();
    for mut window in windows.iter_mut(world) {
        window.mode = match window.mode {
            WindowMode::Windowed => WindowMode::BorderlessFullscreen(MonitorSelection::Current),
            _ => WindowMode::Windowed,
        };
    }
}

/// Writes a PNG of the window into the working directory, as soon as the next frame is drawn. It carries the world as it
/// is now, and opens like a save file.
pub fn take_screenshot(world: &mut World) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let (scene, tick) = (&setup.blueprint.name, world.resource::<Clock>().tick);
    let shown = Checkpoint::of(world);
    let folder = if cfg!(target_arch = "wasm32") { PathBuf::new() } else { env::current_dir().unwrap_or_default() };
    let path = files::free_path(&folder, scene, tick, "png");
    world.spawn(Screenshot::primary_window()).observe(
        move |captured: On<ScreenshotCaptured>, mut toasts: ResMut<Toasts>| {
            let write = |image: Image| -> Result<(), Box<dyn Error>> {
                let image = image.try_into_dynamic()?.to_rgb8();
                let bytes = picture::encode(image.width(), image.height(), &image, &shown.encode())?;
                Ok(disk::give(&path, &bytes).map_err(|error| Unwritten { path: path.clone(), error })?)
            };
            match write(captured.image.clone()) {
                Ok(()) => toasts.say(tr!("Screenshot, with its world: {}", path.display())),
                Err(error) => toasts.warn(tr!("No screenshot: {}", error)),
            }
        },
    );
}
