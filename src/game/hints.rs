//! Hints: what a newcomer may want to know, told once, when it is of use, and never again. What was told is kept from session
//! to session. Who has found something already is not told.

use crate::{
    game::{
        actions::{Action, Gesture},
        frame::Tempo,
        hud::panels::{accuracy, elements, scenes},
        input::{bindings::Bindings, strokes::DragState, touch::Fingers},
        kept::KeptFile,
        language::spoken,
        panels::Panels,
        toasts::Toasts,
        toolbox::Toolbox,
        tools::{HEAT, IGNITE, Tool, WIND},
    },
    lab::split::Split,
    sim::{
        pace::Pace,
        state::{Census, Setup},
    },
};
use bevy::{
    ecs::system::SystemParam,
    log::error,
    prelude::{App, Local, Real, Res, ResMut, Resource, Time, Update},
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use tr::tr;

/// The file that is kept.
const FILE: &str = "hints.ron";
/// Time from a start, or from one hint, to the next at least, s.
const PAUSE: f32 = 10.0;
/// A world that has been late for so long is told why, s.
const LATE: f32 = 4.0;
/// Share of the wanted speed below which it is late.
const SLOW: f32 = 0.8;
/// When a player may have seen enough of a scene, s.
const LONG: f32 = 90.0;
/// Lumps of fire that are a fire.
const FIRE: u32 = 12;

/// What the player has done so far in this session, and what goes on.
#[derive(Clone, Debug, Default)]
struct Facts {
    /// Strokes with elements that move, that stay, and of the eraser.
    pours: u32,
    walls: u32,
    erased: u32,
    /// Strokes since the element was another.
    alike: u32,
    /// The last stroke's tool, and the size of its brush in spacings of the scene.
    last: Option<Tool>,
    size: Option<f32>,
    /// The stroke that goes on.
    stroke: Option<(Gesture, Tool)>,
    /// Time played, and time that the world has been late without a break, s.
    played: f32,
    late: f32,
    burns: bool,
    /// What the player has found: the wind, other sizes, the panels.
    blew: bool,
    resized: bool,
    saw_elements: bool,
    saw_gallery: bool,
}

/// A hint.
struct Hint {
    /// By which it is kept.
    name: &'static str,
    /// Whether it is of use now.
    due: fn(&Facts) -> bool,
    /// Whether the player knows it already.
    known: fn(&Facts) -> bool,
    /// What it says to whom has keys.
    text: fn(&dyn Fn(Action) -> String) -> String,
    /// What it says to whom has none; nothing if it is about keys.
    by_fingers: &'static str,
}

/// All, the most urgent first.
const HINTS: [Hint; 8] = [
    Hint {
        name: "late",
        due: |facts| facts.late >= LATE,
        known: |_| false,
        text: |key| {
            let panel = key(Action::Panel(accuracy::panel::PANEL.id));
            tr!("So many particles are too much for this machine at this quality: {} shows cheaper ones", panel)
        },
        by_fingers: "So many particles are too much for this machine: choose a cheaper quality under the gauge",
    },
    Hint {
        name: "fire",
        due: |facts| facts.burns,
        known: |_| false,
        text: |key| {
            let [heat, light] = [&HEAT, &IGNITE].map(|row| key(Action::Tool(Tool::Other(row))));
            tr!("Fire! Water puts it out. {heat} heats and cools, {light} lights what can burn", heat, light)
        },
        by_fingers: "Fire! Water puts it out. The tool heat warms and cools, ignite lights what can burn",
    },
    Hint {
        name: "undo",
        due: |facts| facts.erased > 0,
        known: |_| false,
        text: |key| {
            let key = key(Action::Undo);
            tr!("{} brings back what was erased, as often as you like", key)
        },
        by_fingers: "The bent arrow brings back what was erased, as often as you like",
    },
    Hint {
        name: "wind",
        due: |facts| facts.pours > 0,
        known: |facts| facts.blew,
        text: |key| {
            let key = key(Action::Tool(Tool::Other(&WIND)));
            tr!("{} blows wind: drag it through what you poured", key)
        },
        by_fingers: "The tool wind blows: drag it through what you poured",
    },
    Hint {
        name: "fill",
        due: |facts| facts.walls > 0,
        known: |_| false,
        text: |_| tr!("Shift draws straight walls, Ctrl+Shift and a click fills the space between them"),
        by_fingers: "",
    },
    Hint {
        name: "brush",
        due: |facts| facts.pours + facts.walls >= 4,
        known: |facts| facts.resized,
        text: |key| {
            let key = key(Action::BrushShape);
            tr!("The wheel makes the brush larger or smaller, {} makes it square", key)
        },
        by_fingers: "Plus and minus make the brush larger and smaller",
    },
    Hint {
        name: "elements",
        due: |facts| facts.alike >= 6,
        known: |facts| facts.saw_elements,
        text: |key| {
            let key = key(Action::Panel(elements::PANEL.id));
            tr!("{} shows all there is to pour, from acid to wood", key)
        },
        by_fingers: "Elements shows all there is to pour, from acid to wood",
    },
    Hint {
        name: "gallery",
        due: |facts| facts.played >= LONG,
        known: |facts| facts.saw_gallery,
        text: |key| {
            let key = key(Action::Panel(scenes::panel::PANEL.id));
            tr!("{} opens the gallery: there are many more scenes", key)
        },
        by_fingers: "Scenes opens the gallery: there are many more",
    },
];

/// What is kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept {
    /// Whether there are hints at all.
    on: bool,
    /// Names of the hints that were told, or were not needed.
    seen: BTreeSet<String>,
}

impl Default for Kept {
    fn default() -> Self {
        Self { on: true, seen: BTreeSet::new() }
    }
}

/// Which hints were told.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq)]
pub struct Hints {
    kept: Kept,
    file: KeptFile,
}

impl Hints {
    /// Those of the user.
    pub fn of_user() -> Self {
        Self::of_file(KeptFile::of_user(FILE))
    }

    /// Those that a folder keeps, or none yet.
    #[cfg(test)]
    pub fn of_folder(folder: &std::path::Path) -> Self {
        Self::of_file(KeptFile::of_folder(folder, FILE))
    }

    fn of_file(file: KeptFile) -> Self {
        Self { kept: file.read(|_| Ok(())), file }
    }

    /// Whether there are hints.
    pub fn are_on(&self) -> bool {
        self.kept.on
    }

    /// Switches them on, all of them anew, or off.
    pub fn switch(&mut self, on: bool) {
        self.kept = Kept { on, ..Kept::default() };
        self.write();
    }

    /// Whether a hint was told.
    fn has(&self, hint: &Hint) -> bool {
        self.kept.seen.contains(hint.name)
    }

    /// Notes that a hint was told, or is not needed.
    fn note(&mut self, hint: &Hint) {
        self.kept.seen.insert(hint.name.to_owned());
        self.write();
    }

    /// Keeps it. What can't be kept holds for the session, and is told in a line of the log.
    fn write(&self) {
        if let Err(error) = self.file.write(&self.kept) {
            error!("{error}");
        }
    }
}

/// Adds the hints.
pub fn plugin(app: &mut App) {
    app.init_resource::<Hints>().add_systems(Update, hint);
}

/// What hints go by.
#[derive(SystemParam)]
struct Seen<'w> {
    setup: Option<Res<'w, Setup>>,
    census: Option<Res<'w, Census>>,
    drag: Res<'w, DragState>,
    tools: Res<'w, Toolbox>,
    tempo: Res<'w, Tempo>,
    pace: Res<'w, Pace>,
    split: Res<'w, Split>,
    panels: Res<'w, Panels>,
    time: Res<'w, Time<Real>>,
}

impl Seen<'_> {
    /// Whether the player looks at a world that moves, and not at a panel.
    fn is_calm(&self) -> bool {
        !self.pace.paused && !self.panels.iter().any(|(panel, open)| open && !panel.stays)
    }
}

/// Tells a hint if there is one to tell.
fn hint(
    seen: Seen,
    (bindings, fingers): (Res<Bindings>, Res<Fingers>),
    mut facts: Local<Facts>,
    mut since: Local<f32>,
    mut hints: ResMut<Hints>,
    mut toasts: ResMut<Toasts>,
) {
    facts.follow(&seen);
    *since += seen.time.delta_secs();
    if !hints.are_on() || *since < PAUSE || !seen.is_calm() || facts.stroke.is_some() {
        return;
    }
    for hint in HINTS.iter().filter(|hint| (hint.due)(&facts)) {
        if hints.has(hint) {
            continue;
        }
        hints.note(hint);
        let text = match fingers.in_use {
            true => spoken(hint.by_fingers),
            false => (hint.text)(&|action| bindings.key(action)),
        };
        if !(hint.known)(&facts) && !text.is_empty() {
            toasts.hint(text);
            *since = 0.0;
            return;
        }
    }
}

impl Facts {
    fn follow(&mut self, seen: &Seen) {
        let seconds = seen.time.delta_secs();
        self.played += seconds;
        // Two worlds are slower than one, and that is no matter of the quality.
        let is_late = !seen.split.is_on() && seen.tempo.lag.is_some_and(|share| share < SLOW);
        self.late = if is_late { self.late + seconds } else { 0.0 };
        self.saw_elements |= seen.panels.shows(elements::PANEL.id);
        self.saw_gallery |= seen.panels.shows(scenes::panel::PANEL.id);
        let Some(setup) = &seen.setup else { return };
        let fire = setup.elements().find("fire");
        let burning =
            fire.zip(seen.census.as_ref()).and_then(|(id, census)| census.by_element.get(id.index()).copied());
        self.burns = burning.is_some_and(|lumps| lumps >= FIRE);
        let stroke = seen.drag.current().map(|drag| (drag.gesture, drag.tool));
        if let Some((gesture, tool)) = self.stroke.filter(|_| stroke.is_none()) {
            self.end_stroke(gesture, tool, setup);
            self.resized |= self.size.is_some_and(|size| size != seen.tools.radius());
            self.size = Some(seen.tools.radius());
        }
        self.stroke = stroke;
    }

    fn end_stroke(&mut self, gesture: Gesture, tool: Tool, setup: &Setup) {
        match (gesture, tool) {
            (Gesture::Pan | Gesture::Take(_) | Gesture::Paste | Gesture::Gauge(_), _) => return,
            (Gesture::Erase, Tool::Element(_)) => self.erased += 1,
            (_, Tool::Element(id)) if setup.elements().get(id).fixed => self.walls += 1,
            (_, Tool::Element(_)) => self.pours += 1,
            (_, Tool::Other(row)) => self.blew |= *row == WIND,
        }
        self.alike = if self.last == Some(tool) { self.alike + 1 } else { 1 };
        self.last = Some(tool);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn every_hint_has_a_name_of_its_own_and_names_keys_that_there_are() {
        let mut app = App::new();
        crate::game::hud::panels::plugin(&mut app);
        let bindings = app.world().resource::<Bindings>().clone();
        for (k, hint) in HINTS.iter().enumerate() {
            assert!(HINTS[k + 1..].iter().all(|other| other.name != hint.name));
            let text = (hint.text)(&|action| {
                let key = bindings.key(action);
                assert!(!key.is_empty(), "{}: {action:?} has no key", hint.name);
                key
            });
            assert!(text.chars().count() <= 100 && !text.contains('_'), "{text}");
        }
    }

    #[test]
    #[cfg_attr(target_arch = "wasm32", ignore = "a module has no files")]
    fn what_was_told_outlives_the_session_and_a_damaged_file_begins_anew() {
        let folder = std::env::temp_dir().join(format!("powder-hints-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let mut hints = Hints::of_folder(&folder);
        assert!(hints.are_on() && !hints.has(&HINTS[0]));
        hints.note(&HINTS[0]);
        assert_eq!(Hints::of_folder(&folder), hints);
        hints.switch(false);
        assert!(!Hints::of_folder(&folder).are_on());
        hints.switch(true);
        assert!(!Hints::of_folder(&folder).has(&HINTS[0]), "switched on again, all are told anew");
        for damaged in [&b""[..], b"(on: true", b"(on: 3, seen: [])", b"\xff"] {
            fs::write(folder.join(FILE), damaged).expect("it is ours");
            assert_eq!(Hints::of_folder(&folder).kept, Kept::default());
        }
        fs::remove_dir_all(folder).expect("it is ours");
    }
}
