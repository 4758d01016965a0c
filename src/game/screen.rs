//! The window as a whole: full screen and screenshots.

use crate::{
    game::{files, hud::toast::Toasts},
    sim::state::{Clock, Setup},
};
use bevy::{
    prelude::{On, ResMut, With, World},
    render::view::screenshot::{Screenshot, ScreenshotCaptured},
    window::{MonitorSelection, PrimaryWindow, Window, WindowMode},
};

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

/// Writes a PNG of the window into the working directory, as soon as the next frame is drawn.
pub fn take_screenshot(world: &mut World) {
    let scene = world.get_resource::<Setup>().map_or("world", |setup| setup.blueprint.name.as_str());
    let tick = world.get_resource::<Clock>().map_or(0, |clock| clock.tick);
    let path = files::free_path(&std::env::current_dir().unwrap_or_default(), scene, tick, "png");
    world.spawn(Screenshot::primary_window()).observe(
        move |captured: On<ScreenshotCaptured>, mut toasts: ResMut<Toasts>| {
            let written = captured
                .image
                .clone()
                .try_into_dynamic()
                .map_err(|error| error.to_string())
                .and_then(|image| image.to_rgb8().save(&path).map_err(|error| error.to_string()));
            match written {
                Ok(()) => toasts.say(format!("Screenshot: {}", path.display())),
                Err(error) => toasts.warn(format!("No screenshot: {error}")),
            }
        },
    );
}
