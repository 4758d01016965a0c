//! What the player has set: language, size of the HUD, how much of the picture is drawn, size of the window, and the scene played last.
//! Kept from session to session; read before there is a window, and written a second after the last change.

use crate::{
    game::{
        hud::{
            layout::{CHOICES, UiScale},
            motion::ReducedMotion,
        },
        input::mouse_keys::MouseKeys,
        kept::KeptFile,
        language::{self, Language},
        render::level::{Level, PictureLevel},
    },
    scene::builtin_names,
    sim::state::Setup,
};
use bevy::{
    app::App,
    log::error,
    prelude::{DetectChangesMut, Real, Res, ResMut, Resource, Single, Time, Update, With},
    window::{PrimaryWindow, Window},
};
use serde::{Deserialize, Serialize};

/// The file that they are kept in.
const FILE: &str = "settings.ron";
/// How long nothing must have changed before they are written, s: a window that is being resized changes in each frame.
const CALM: f32 = 1.0;
/// Smallest and largest window that is opened again, logical pixels.
const WINDOW: [u32; 2] = [320, 16384];

/// What is kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Choices {
    /// Size of the HUD on top of the automatic one.
    hud: f32,
    /// The picture's level, or `None` if frame times decide.
    picture: Option<Level>,
    /// Size of the window, logical pixels, or `None` for the game's own.
    window: Option<(u32, u32)>,
    /// The built-in scene that was played last.
    scene: Option<String>,
    /// Whether keys move the pointer.
    mouse_keys: bool,
    /// Whether the HUD moves as little as can be, or `None` for what the system asks for.
    reduced_motion: Option<bool>,
    /// Tag of the language, or `None` for that of the system.
    language: Option<String>,
}

impl Default for Choices {
    fn default() -> Self {
        Self {
            hud: 1.0,
            picture: None,
            window: None,
            scene: None,
            mouse_keys: false,
            reduced_motion: None,
            language: None,
        }
    }
}

impl Choices {
    fn check(&self) -> Result<(), String> {
        if !CHOICES.contains(&self.hud) {
            return Err(format!("hud {}; allowed: {CHOICES:?}", self.hud));
        }
        let [least, most] = WINDOW;
        match self.window {
            Some((x, y)) if !(least..=most).contains(&x) || !(least..=most).contains(&y) => {
                Err(format!("window ({x}, {y}); allowed: {least} … {most} each"))
            }
            _ => Ok(()),
        }
    }
}

/// The settings as they are kept, and their file.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Settings {
    kept: Choices,
    /// What is to be written, and for how long it has been that, s.
    next: Option<(Choices, f32)>,
    file: KeptFile,
}

impl Settings {
    /// Those of the user. What is wrong with the file is told in a line of the log.
    pub fn of_user() -> Self {
        Self::of_file(KeptFile::of_user(FILE))
    }

    fn of_file(file: KeptFile) -> Self {
        Self { kept: file.read(Choices::check), next: None, file }
    }

    /// Size of the window of the last session, logical pixels.
    pub fn window(&self) -> Option<(u32, u32)> {
        self.kept.window
    }

    /// The built-in scene that was played last, unless this version has none of that name.
    pub fn scene(&self) -> Option<&str> {
        self.kept.scene.as_deref().filter(|name| builtin_names().contains(name))
    }

    /// Writes what has changed once it has been the same for a while.
    fn follow(&mut self, now: Choices, seconds: f32) {
        if now == self.kept {
            self.next = None;
            return;
        }
        let since = match self.next.take() {
            Some((next, since)) if next == now => since + seconds,
            _ => 0.0,
        };
        if since < CALM {
            self.next = Some((now, since));
            return;
        }
        if let Err(error) = self.file.write(&now) {
            error!("{error}");
        }
        self.kept = now;
    }
}

/// Puts the settings of the last session in force, and keeps those of this one.
pub fn plugin(app: &mut App, settings: Settings) {
    let Choices { hud, picture, mouse_keys, reduced_motion, language, .. } = settings.kept.clone();
    language::plugin(app, language.as_deref());
    app.insert_resource(UiScale { factor: hud })
        .insert_resource(MouseKeys(mouse_keys))
        .insert_resource(ReducedMotion { chosen: reduced_motion, by_system: false })
        .insert_resource(settings)
        .add_systems(Update, keep);
    app.world_mut().get_resource_or_init::<PictureLevel>().want(picture);
}

/// Keeps what is set.
fn keep(
    mut settings: ResMut<Settings>,
    (scale, mouse_keys, motion, language): (Res<UiScale>, Res<MouseKeys>, Res<ReducedMotion>, Res<Language>),
    level: Res<PictureLevel>,
    window: Single<&Window, With<PrimaryWindow>>,
    setup: Option<Res<Setup>>,
    time: Res<Time<Real>>,
) {
    let size = window.resolution.size().as_uvec2().to_array();
    // A window that is minimised has no size, and that of a page is the page's.
    let sensible = size.iter().all(|edge| (WINDOW[0]..=WINDOW[1]).contains(edge)) && !cfg!(target_arch = "wasm32");
    let window = if sensible { Some(size.into()) } else { settings.kept.window };
    let last = settings.kept.scene.as_ref();
    let scene = setup.as_ref().map(|setup| &setup.blueprint.name);
    let scene = scene.filter(|name| last == Some(name) || builtin_names().contains(&name.as_str())).or(last).cloned();
    let now = Choices {
        hud: scale.factor,
        picture: level.wanted(),
        window,
        scene,
        mouse_keys: mouse_keys.0,
        reduced_motion: motion.chosen,
        language: language.chosen().map(str::to_owned),
    };
    settings.bypass_change_detection().follow(now, time.delta_secs());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::kept::parse;
    use std::fs;

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn they_outlive_the_session_once_they_are_calm() {
        let folder = std::env::temp_dir().join(format!("powder-settings-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let file = || KeptFile::of_folder(&folder, FILE);
        let mut settings = Settings::of_file(file());
        let scene = Some("volcano".to_owned());
        let chosen = Choices {
            hud: 1.3,
            picture: Some(Level::Plain),
            window: Some((900, 700)),
            scene,
            mouse_keys: true,
            reduced_motion: Some(true),
            language: Some("de".to_owned()),
        };
        settings.follow(Choices::default(), 10.0);
        assert!(!folder.exists(), "nothing changed, so nothing is written");
        for width in 800..900 {
            settings.follow(Choices { window: Some((width, 700)), ..chosen.clone() }, 0.5);
        }
        assert!(!folder.exists(), "a window is being resized");
        (0..3).for_each(|_| settings.follow(chosen.clone(), 0.5));
        let again = Settings::of_file(file());
        assert_eq!((again.scene(), again.window()), (Some("volcano"), Some((900, 700))));
        assert_eq!(again.kept, chosen);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_scene_of_another_version_is_not_asked_for() {
        let kept = Choices { scene: Some("atlantis".to_owned()), ..Choices::default() };
        assert_eq!(Settings { kept, ..Settings::default() }.scene(), None);
    }

    #[test]
    fn a_damaged_file_is_left_out() {
        let read = |text: &[u8]| parse(text, Choices::check);
        for damaged in [
            &b""[..],
            b"(hud: 0.0)",
            b"(hud: nan)",
            b"(window: Some((0, 5)))",
            b"(picture: Some(Best))",
            b"(sound: 1)",
            b"\xff",
        ] {
            assert!(read(damaged).is_err_and(|fault| fault.lines().count() == 1), "{damaged:?}");
        }
        assert_eq!(read(b"(hud: 1.3)"), Ok(Choices { hud: 1.3, ..Choices::default() }), "a file of before has less");
    }
}
