//! What a key, a button or a click on the HUD can ask for.

use crate::game::{brush_mode::BrushMode, gauges::grip::Grip, language::spoken, tools::Tool, views::table::View};
use bevy::prelude::MouseButton;
use tr::tr;

/// What a player can do with a key, a button or a click on the HUD.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Begins something that lasts while the button is held.
    Hold(Gesture),
    /// Holds a button of the mouse down, while keys move the pointer.
    Press(MouseButton),
    /// Has keys move the pointer, or the picture again.
    MouseKeys,
    /// Chooses the element under the pointer.
    Sample,
    /// Chooses the element on this digit; while the pointer is over an element's tile, puts that element there.
    Element(char),
    /// Chooses a tool that is not an element.
    Tool(Tool),
    /// Makes the brush larger or smaller by steps.
    Brush(i32),
    /// Turns the brush from round to square and back.
    BrushShape,
    /// Chooses what a brush with an element does; again: to draw.
    BrushMode(BrushMode),
    /// The next of these.
    NextBrushMode,
    /// Stops and starts time.
    Pause,
    /// Runs one tick.
    Step,
    /// Halves (−1) or doubles (+1) the speed.
    Speed(i32),
    /// Lets the world run backwards while the key or button is held.
    Rewind,
    /// Back to the start of the scene.
    Reset,
    /// Takes the last edit back.
    Undo,
    /// Makes it again.
    Redo,
    /// Brings the air to rest.
    ClearAir,
    /// Shows a view.
    View(&'static View),
    /// Shows the next view.
    NextView,
    /// Zooms at the pointer, in (+1) or out (−1).
    Zoom(i32),
    /// Moves the picture while the key is held: right and up count.
    Pan(i32, i32),
    /// Shows or hides the HUD.
    Hud,
    /// Opens or closes a panel.
    Panel(PanelId),
    /// Takes up a frame: the next drag takes the piece of the world that is in it; again: lays it down.
    Take(Take),
    /// Takes up the newest stamp.
    TakeUpStamp,
    /// Turns the stamp in hand a quarter to the left.
    TurnStamp,
    /// Mirrors the stamp in hand: left and right.
    MirrorStamp,
    /// Mirrors the stamp in hand: top and bottom.
    FlipStamp,
    /// Lays down what is in hand, or closes whatever is open, but for the panels that stay.
    Close,
    /// Writes the world into a file.
    Save,
    /// Begins a recording, or ends it.
    Record,
    /// Writes the last minute as a recording.
    KeepLastMinute,
    /// Puts the world beside itself at another quality, or ends that.
    Split,
    /// Takes up the truth lens, or lays it down; by its key as long as that is held.
    Lens,
    /// Switches the sound off, and on again.
    Mute,
    /// Full screen and back.
    FullScreen,
    /// Writes a picture of the window.
    Screenshot,
    /// Copies a link that carries the world.
    #[cfg(target_arch = "wasm32")]
    CopyLink,
    /// Sets a gauge under the pointer; at the mark of one takes that away.
    Gauge,
    /// Begins a line under the pointer through which flow is measured, or ends it.
    GaugeLine,
}

impl Action {
    /// Its name in a file.
    pub fn name(self) -> String {
        match self {
            Self::Element(digit) => format!("Element({digit})"),
            Self::Tool(Tool::Other(row)) => format!("Tool({})", row.name),
            Self::View(view) => format!("View({})", view.name),
            Self::Panel(PanelId(name)) => format!("Panel({name})"),
            _ => format!("{self:?}"),
        }
    }

    /// What it is called in a list of single actions, from what its `help` says in the player's language.
    pub fn label(self, help: &str) -> String {
        match self {
            Self::Element(digit) => tr!("favourite {}", digit),
            Self::View(view) => {
                let name = spoken(&view.name.to_lowercase());
                tr!("view: {}", name)
            }
            Self::Brush(steps) if steps > 0 => tr!("larger brush"),
            Self::Brush(_) => tr!("smaller brush"),
            Self::Pan(-1, _) => tr!("move the picture left"),
            Self::Pan(1, _) => tr!("move the picture right"),
            Self::Pan(_, 1) => tr!("move the picture up"),
            Self::Pan(..) => tr!("move the picture down"),
            Self::Rewind => tr!("back in time, while held"),
            Self::Lens => tr!("the truth lens"),
            Self::Screenshot => tr!("screenshot"),
            Self::GaugeLine => tr!("a line that measures flow"),
            // The rest of a help is how.
            _ => help.split([';', ':', '(']).next().unwrap_or(help).trim_end().to_owned(),
        }
    }
}

/// What a held button does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gesture {
    /// Works with the chosen tool along the way of the pointer.
    Use,
    /// Draws a straight line when released.
    Line,
    /// Draws a filled rectangle when released.
    Rectangle,
    /// Fills the free space around the pointer.
    Fill,
    /// Erases along the way of the pointer; with the pressure tool, sucks.
    Erase,
    /// Moves the picture; a click without moving samples.
    Pan,
    /// Takes the piece of the world in the rectangle when released.
    Take(Take),
    /// Pastes the stamp in hand when released.
    Paste,
    /// Moves a gauge; a click without moving finds it in the panel.
    Gauge(Grip),
}

/// What becomes of the piece that is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Take {
    /// It stays.
    Copy,
    /// It goes.
    Cut,
}

/// Name of a panel of the HUD.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct PanelId(pub &'static str);
