//! What the effects of a tick are decided by.

use crate::kernel::{
    element::{Element, ElementTable},
    params::Preset,
};
use serde::{Deserialize, Serialize};

/// What a scene or a player wants of an effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// Runs only while something in the world calls for it.
    #[default]
    Auto,
    /// Always runs.
    On,
    /// Never runs.
    Off,
}

/// What is known of the world when a tick is planned. The gate gathers it once a tick; the decisions are functions of it and
/// of nothing else.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// What is wanted of each effect, in their order.
    pub modes: &'a [Mode],
    /// The named quality in force.
    pub preset: Preset,
    /// Whether the quality has the pressure predictor.
    pub predicts: bool,
    /// All elements.
    pub elements: &'a ElementTable,
    /// Density of the air, kg/m².
    pub air_density: f32,
    /// How many particles there are of each.
    pub counts: &'a [u32],
    /// Movable particles.
    pub particles: usize,
    /// How many of them sleep.
    pub asleep: usize,
    /// Whether any matter is or was warmer or colder than the room.
    pub has_heat: bool,
    /// Whether any air is warmer or colder than the surroundings.
    pub air_is_warm: bool,
    /// Whether the air presses harder than a layer of the weakest of the rock that is there bears.
    pub presses: bool,
    /// Whether matter is there that reacts with other matter that is there.
    pub can_react: bool,
    /// Whether matter is there that decays, and may be warm enough for it.
    pub may_decay: bool,
    /// Whether the liquid has a tension.
    pub has_tension: bool,
    /// Whether the scene has winds.
    pub has_winds: bool,
    /// Whether the air moves.
    pub air_moves: bool,
    /// Whether the fastest particle could wake air at rest.
    pub stirs_air: bool,
}

impl Facts<'_> {
    /// Whether anything movable is there.
    pub(super) fn has_liquid(&self) -> bool {
        self.particles > 0
    }

    /// Whether a movable particle is there of an element with this property.
    pub(super) fn present(&self, property: fn(&Element) -> bool) -> bool {
        let mut counted = self.elements.iter().zip(self.counts);
        counted.any(|((_, element), &count)| count > 0 && !element.fixed && property(element))
    }

    /// Whether gases are there.
    pub fn has_gases(&self) -> bool {
        self.present(Element::is_gas)
    }

    /// Whether grains are there.
    pub fn has_grains(&self) -> bool {
        self.present(|element| element.friction > 0.0)
    }

    /// Whether liquids that have a viscosity are there.
    pub fn has_viscous(&self) -> bool {
        self.present(|element| element.viscosity > 0.0)
    }

    /// Inertias of the lightest and of the heaviest movable particles that are there, kg/m², if they differ.
    pub fn densities(&self) -> Option<[f32; 2]> {
        let present = |((_, element), count): &((_, &Element), &u32)| **count > 0 && !element.fixed;
        let counted = self.elements.iter().zip(self.counts).filter(present);
        let densities = counted.map(|((_, element), _)| element.inertia(self.air_density));
        let ends = densities.fold([f32::MAX, 0.0], |[least, most], density| [least.min(density), most.max(density)]);
        (ends[0] < ends[1]).then_some(ends)
    }

    /// Whether anything is there that the air drags.
    pub(super) fn feels_air(&self) -> bool {
        self.present(|element| element.drag > 0.0)
    }
}
