//! Which error is shown, and the switch between the two.

use crate::{
    game::{
        hud::{style, widgets},
        language::spoken,
    },
    lab::live::accuracy::CurvePoint,
};
use bevy_egui::egui::{Color32, FontId, Rect, Sense, Ui, vec2};

/// Which error the plot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The share of the liquid that stands elsewhere than in a converged run.
    True,
    /// How far the density is off: a share of the run's own, to be compared at one detail only.
    Density,
}

impl ErrorKind {
    fn name(self) -> &'static str {
        match self {
            Self::True => "true error",
            Self::Density => "density error",
        }
    }

    fn about(self) -> &'static str {
        match self {
            Self::True => {
                "Share of the liquid that stands elsewhere than in a converged run: comparable over all details"
            }
            Self::Density => "How much too dense or too thin the liquid stands: comparable at one detail only",
        }
    }

    /// The error of a point, if it is known.
    pub fn of(self, point: &CurvePoint) -> Option<f32> {
        match self {
            Self::True => point.truth,
            Self::Density => point.error,
        }
    }

    /// The name of the error that is shown in the corner of `field`, and of the other if it `has_both` to show, which is
    /// given back once it is pressed. What they cover is `taken`.
    pub fn choose(self, ui: &Ui, field: Rect, has_both: bool, taken: &mut Vec<Rect>) -> Option<Self> {
        let mut right = field.right_top() + vec2(-6.0, 5.0);
        let mut chosen = None;
        for kind in [Self::Density, Self::True] {
            let is_shown = kind == self;
            if !is_shown && !has_both {
                continue;
            }
            let colour = if is_shown && has_both { Color32::WHITE } else { style::WEAK };
            let name = spoken(kind.name());
            let text = ui.painter().layout_no_wrap(name.clone(), FontId::proportional(style::SMALL), colour);
            let words = Rect::from_min_size(right - vec2(text.size().x, 0.0), text.size());
            let room = words.expand2(vec2(5.0, 2.5));
            right.x = words.left() - 14.0;
            taken.push(room);
            let sense = if has_both { Sense::click() } else { Sense::hover() };
            let response = ui.interact(words.expand(4.0), ui.id().with(("error", kind.name())), sense);
            if has_both {
                widgets::name(&response, &name, is_shown);
                let fill = match (is_shown, response.hovered()) {
                    (true, _) => style::ACCENT_FILL,
                    (false, true) => style::BUTTON_HOVER,
                    (false, false) => style::BUTTON,
                };
                ui.painter().rect_filled(room, 4.0, fill);
            }
            ui.painter().galley(words.min, text, colour);
            if response.on_hover_text(spoken(kind.about())).clicked() && !is_shown {
                chosen = Some(kind);
            }
        }
        chosen
    }
}
