//! The App with a window.

#[cfg(not(target_arch = "wasm32"))]
use crate::game::crash;
use crate::{
    game::{
        challenges::earned::Earned,
        favourites::Favourites,
        hints::Hints,
        hud::{HudPlugin, paint, panels::scenes::SceneFolder},
        input::keymap::Keymap,
        language::spoken,
        mixer,
        plugin::GamePlugin,
        render::WorldRenderPlugin,
        rest,
        settings::{self, Settings},
        sound::{Output, volume::Volume},
        stamps::shelf::Shelf,
    },
    lab::colours,
    sim::{
        SimulationPlugin, fault,
        recorder::Recorder,
        state::{Census, Setup},
    },
};
use bevy::{
    DefaultPlugins,
    app::{App, AppExit},
    camera::{Camera2d, ClearColor},
    color::Color,
    log::LogPlugin,
    prelude::{Commands, IntoScheduleConfigs, PluginGroup, PreStartup, Res, Single, Startup, Update, With},
    render::view::Msaa,
    time::common_conditions::on_timer,
    window::{PresentMode, PrimaryWindow, Window, WindowPlugin, WindowResizeConstraints, WindowResolution},
};
use std::{
    panic::{self, AssertUnwindSafe},
    path::PathBuf,
    time::Duration,
};
use tr::tr;

/// Size of the window at the first start, logical pixels.
const WINDOW_SIZE: (u32, u32) = (1280, 800);

/// Why there is no game.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GameError {
    /// There is nowhere to show a window, or the graphics can't be set up.
    #[error("{reason}; `powder-master run {scene}` runs it without a window")]
    NoWindow {
        /// What is missing, or what went wrong.
        reason: String,
        /// The scene that was asked for.
        scene: String,
    },
    /// It panicked.
    #[cfg(not(target_arch = "wasm32"))]
    #[error(transparent)]
    Crashed(#[from] crash::Crash),
}

/// Plays in a window until it is closed; whatever ends it otherwise, the world can be had back (see `crash`). `furnish`
/// adds what belongs to the program around it and makes the world; `scene` is what `run` would call it; what the player does goes to
/// `record`.
pub fn run(scene: &str, record: Option<PathBuf>, furnish: impl FnOnce(&mut App)) -> Result<AppExit, GameError> {
    let scene = scene.to_owned();
    if let Some(reason) = missing_display(|name| std::env::var(name).ok()) {
        return Err(GameError::NoWindow { reason, scene });
    }
    // Setting the window up panics where it fails (winit can't reach the display, there is no graphics adapter).
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let built = panic::catch_unwind(AssertUnwindSafe(|| build(record, furnish)));
    panic::set_hook(hook);
    match built {
        #[cfg(not(target_arch = "wasm32"))]
        Ok(app) => Ok(crash::run(app, crash::folder(), |mut app| app.run())?),
        #[cfg(target_arch = "wasm32")]
        Ok(mut app) => Ok(app.run()),
        Err(cause) => Err(GameError::NoWindow { reason: explain(&fault::message(&*cause)), scene }),
    }
}

/// The display that a Unix desktop needs, if none is named.
fn missing_display(variable: impl Fn(&str) -> Option<String>) -> Option<String> {
    let named = |name: &str| variable(name).is_some_and(|value| !value.is_empty());
    let needed = cfg!(all(unix, not(target_os = "macos"), not(target_arch = "wasm32")));
    (needed && !named("DISPLAY") && !named("WAYLAND_DISPLAY") && !named("WAYLAND_SOCKET"))
        .then(|| "no display: neither DISPLAY nor WAYLAND_DISPLAY is set".to_owned())
}

/// One line for what went wrong.
fn explain(panic: &str) -> String {
    if panic.contains("event loop") || panic.contains("EventLoop") {
        let display = std::env::var("DISPLAY").or_else(|_| std::env::var("WAYLAND_DISPLAY")).unwrap_or_default();
        return format!("no display: `{display}` can't be reached");
    }
    format!("can't open a window: {}", panic.lines().next().unwrap_or("unknown reason"))
}

pub(crate) fn build(record: Option<PathBuf>, furnish: impl FnOnce(&mut App)) -> App {
    let mut app = App::new();
    // Before anything is read, so that what is wrong with a file of the user's is told.
    app.add_plugins(LogPlugin { filter: "error,bevy_winit=off".into(), ..LogPlugin::default() });
    let settings = Settings::of_user();
    let window = Window {
        title: "Powder Master".into(),
        name: Some("powder-master".into()),
        resolution: WindowResolution::from(settings.window().unwrap_or(WINDOW_SIZE)),
        present_mode: PresentMode::AutoVsync,
        resize_constraints: constraints(),
        // In a page: its canvas. The page decides which of the browser's own keys to keep back.
        canvas: Some("#world".into()),
        fit_canvas_to_parent: true,
        prevent_default_event_handling: false,
        ..Window::default()
    };
    let [red, green, blue] = colours::SURROUNDINGS;
    app.add_plugins(
        DefaultPlugins
            .set(WindowPlugin { primary_window: Some(window), ..WindowPlugin::default() })
            .disable::<LogPlugin>(),
    )
    .add_plugins(paint::plugin)
    .add_plugins((SimulationPlugin, GamePlugin, HudPlugin, WorldRenderPlugin))
    .insert_resource(Favourites::of_user())
    .add_systems(PreStartup, mixer::desk::read_own)
    .insert_resource(Keymap::of_user())
    .insert_resource(Shelf::of_user())
    .insert_resource(Earned::of_user())
    .insert_resource(SceneFolder::of_user())
    .insert_resource(Hints::of_user())
    .insert_resource(Volume::of_user())
    .insert_resource(Output::of_system())
    .insert_resource(ClearColor(Color::srgb_u8(red, green, blue)))
    .add_plugins(rest::plugin)
    .add_systems(Startup, spawn_camera)
    .add_systems(Update, tell_in_title.run_if(on_timer(TITLE_EVERY)));
    // A page tells its own in another way: `web::reader`.
    #[cfg(not(target_arch = "wasm32"))]
    app.add_plugins(crate::game::screen_reader::plugin);
    settings::plugin(&mut app, settings);
    furnish(&mut app);
    if let Some(path) = record {
        app.world().resource::<Recorder>().begin(app.world(), Some(path));
    }
    app
}

/// The smallest window of a desktop; in a page, the page says how large the canvas is.
fn constraints() -> WindowResizeConstraints {
    let (min_width, min_height) = if cfg!(target_arch = "wasm32") { (1.0, 1.0) } else { (480.0, 320.0) };
    WindowResizeConstraints { min_width, min_height, ..Default::default() }
}

/// How often the title is looked after.
const TITLE_EVERY: Duration = Duration::from_millis(500);

/// Keeps scene and particle count in the title, for the task bar and for tests.
fn tell_in_title(setup: Res<Setup>, census: Res<Census>, mut window: Single<&mut Window, With<PrimaryWindow>>) {
    let (scene, count) = (spoken(&setup.blueprint.title), census.total);
    let title = tr!("Powder Master: {scene}, {count} particles", scene, count);
    if window.title != title {
        window.title = title;
    }
}

/// The camera that window and HUD are drawn for; `WorldCamera` says where it looks.
fn spawn_camera(mut commands: Commands) {
    commands.spawn((Camera2d, Msaa::Off));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(all(unix, not(target_os = "macos")))]
    fn without_a_display_the_error_names_the_way_out() {
        assert!(missing_display(|_| None).is_some());
        assert!(missing_display(|name| (name == "DISPLAY").then(String::new)).is_some());
        assert_eq!(missing_display(|name| (name == "DISPLAY").then(|| ":0".into())), None);
        assert_eq!(missing_display(|name| (name == "WAYLAND_DISPLAY").then(|| "wayland-0".into())), None);
        let error = GameError::NoWindow { reason: "none".into(), scene: "waterfall".into() };
        assert!(error.to_string().contains("powder-master run waterfall"));
    }

    #[test]
    fn a_failed_window_is_explained_in_one_line() {
        assert!(explain("Failed to build event loop: Os(OsError)").starts_with("no display"));
        let reason = explain("Unable to find a GPU!\nMore.");
        assert!(reason.lines().count() == 1 && reason.contains("GPU"), "{reason}");
    }
}
