//! What a particle can be made of. The rows come from `assets/elements.ron`; the kernel only looks them up. What its
//! passes read of them stands in [`ElementParams`].

use crate::{
    heat::units::{COLDEST, HOTTEST, ROOM},
    params::named,
    units::{Scale, TICK_SECONDS},
};
use serde::{Deserialize, Serialize};

/// Row of an element in the [`ElementTable`]; a particle stores it in one byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ElementId(pub u8);

impl ElementId {
    /// The row as an index.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

named! {
    /// Where an element stands in the palette.
    #[derive(PartialOrd, Ord)]
    Category:

    /// What stays in its place.
    Solids = "solids",
    /// What piles up.
    Powders = "powders",
    /// What flows.
    Liquids = "liquids",
    /// What the air lifts.
    Gases = "gases",
}

/// One row of the element table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Name in scenes, on the command line and in the palette; unique.
    pub name: String,
    /// Its group in the palette.
    pub category: Category,
    /// The digit key that selects it, `'0'`–`'9'`, if it has one; unique.
    pub key: Option<char>,
    /// Colour, sRGB.
    pub colour: [u8; 3],
    /// Fixed elements never move: they stop liquids and air and are stored in the rock grid.
    pub fixed: bool,
    /// Density, kg/m²; 0.05 … 100 000. Weighs the particle in energy, momentum and drag, and
    /// where densities differ in pressure, contact and viscosity.
    pub density: f32,
    /// Kinematic viscosity ν, m²/s; raising it makes the liquid thicker, and walls hold it harder. 0 … 10. In XSPH's c ([`Element::smoothing`]) that is
    /// 3.2 ν Δt/d² for a tick of Δt, in as many passes as it takes; 16 do at most some 1.5 m²/s at d = 0.1 m and one substep
    /// a tick, and what is beyond is cut and counted.
    #[serde(default)]
    pub viscosity: f32,
    /// XSPH c that particles have unless their viscosity is more (Macklin & Müller 2013, eq. 17): share of the velocity
    /// difference to its neighbours that a particle of the scene's own spacing gives up each tick, however many substeps that
    /// has; raising it smooths the flow, and walls let it slip. 0 … 0.5. It belongs to the particles' size: a scene of smaller particles flows as
    /// smoothly for their size. A run at another detail, which has the same liquid, has c times detail².
    #[serde(default)]
    pub smoothing: f32,
    /// Angle of friction φ among grains, degrees: the slope up to which a heap stands; raising it makes heaps steeper. 0 … 60;
    /// 0 of what is no powder.
    #[serde(default)]
    pub friction: f32,
    /// Cohesion among grains, Pa: the shear stress that they bear without being pressed together; raising it lets steeper and
    /// higher cliffs stand. 0 … 50 000; above 0 only with friction.
    #[serde(default)]
    pub cohesion: f32,
    /// Diffusion D of a gas in the air, m²/s: lumps that are not among their like wander until they are √(2 D t) from where they
    /// were; raising it makes a cloud spread sooner. 0 … 1; above 0 only of gases.
    #[serde(default)]
    pub diffusion: f32,
    /// Vorticity confinement ε (eq. 16), m/s² for each 1/s of vorticity, whatever the detail; raising it keeps eddies
    /// alive longer. 0 … 1.
    #[serde(default)]
    pub vorticity: f32,
    /// Drag coefficient C of F = C v² of a particle of the scene's own spacing, kg/m. Raising it lets the air carry the
    /// particle more. 0 … 1000. It belongs to the matter: at another detail the particles that stand for this one share
    /// it, so that the wind carries the same water as far.
    #[serde(default)]
    pub drag: f32,
    /// Heat capacity c, MJ/m²K; raising it makes the matter slower to warm and to cool. 0.2 … 5.
    #[serde(default = "one")]
    pub capacity: f32,
    /// Conductivity k of the matter in life, W/mK; raising it lets heat through sooner. 0 … 500. What is simulated is
    /// `k′ = 6·10⁴ √(0.6 k)`.
    #[serde(default = "half")]
    pub conductivity: f32,
    /// Chemical energy E, MJ/m²: what it becomes that has less gets the rest as heat. 0 … 8000.
    #[serde(default)]
    pub energy: f32,
    /// Air that it holds bound, m² at the surroundings' pressure for each m² of it: what it becomes that holds less gives the rest
    /// off, and what holds more takes it. Of what comes of it in turn each gives off as much. 0 … 100.
    #[serde(default)]
    pub gas: f32,
    /// Temperature of what is new, K. 1 … 4000.
    #[serde(default = "room")]
    pub spawn: f32,
    /// What it becomes when it is hot or cold enough: at most one of each.
    #[serde(default)]
    pub changes: Vec<ElementChange>,
    /// What it becomes in time, as by burning.
    #[serde(default)]
    pub decays: Option<ElementDecay>,
    /// What it becomes where the air presses on it harder than it bears; only of what is fixed.
    #[serde(default)]
    pub breaks: Option<ElementBreak>,
    /// What it and another become where they touch: at most one row for two elements, which either of them has.
    #[serde(default)]
    pub touches: Vec<ElementTouch>,
    /// Share of the free sites under the brush that one tick of pouring fills. 0 < flow ≤ 1.
    #[serde(default = "one")]
    pub flow: f32,
    /// What there is to know of it, in a sentence for players.
    #[serde(default)]
    pub card: String,
}

/// A change of an element at a temperature.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ElementChange {
    /// It happens above this temperature, K; then `below` is not given. 1 … 4000.
    pub above: Option<f32>,
    /// It happens below this temperature, K.
    pub below: Option<f32>,
    /// Names of what comes of it, lump after lump in turn, 1 … 16; `air` is a lump that goes into the air.
    pub into: Vec<String>,
    /// Heat that it takes above, or gives below, MJ/m²; 0 … 16 000. Where it follows from other changes it need not be given; so
    /// it does for what parts into several, which are as warm as what parts.
    pub latent: Option<f32>,
}

/// What an element becomes in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElementDecay {
    /// From this temperature on, K; 1 … 4000. At any, if it is not given.
    #[serde(default)]
    pub above: Option<f32>,
    /// Mean time until it does, s; raising it makes it burn longer. 0.02 … 1000.
    pub seconds: f32,
    /// Whether it needs air: then it does only at an open surface, and finer particles as much sooner.
    #[serde(default)]
    pub needs_air: bool,
    /// Names of what comes of it, lump after lump in turn, 1 … 16; `air` is a lump that goes into the air. None may have more
    /// energy than it.
    pub into: Vec<String>,
}

/// What a fixed element becomes where the air presses on it harder than it bears.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElementBreak {
    /// Overpressure that a wall of it just bears for each metre that it is thick, up to 2 m, Pa/m; raising it makes it stronger.
    /// 100 … 10⁷.
    pub above: f32,
    /// Name of what comes of it: what moves, and has as much energy and gas.
    pub into: String,
}

/// What an element and another become where they touch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElementTouch {
    /// Name of the other: any, but two that are fixed never react.
    pub with: String,
    /// Names of what becomes of this one and of the other; `air` is a lump that goes into the air.
    pub into: (String, String),
    /// Reactions a second of two lumps that touch; raising it makes them react sooner. 0.001 … 60.
    pub rate: f32,
    /// Lowest and highest temperature of both at which they do, K; 1 … 4000. Any, if it is not given.
    #[serde(default)]
    pub between: Option<(f32, f32)>,
    /// Whether light gives what they have more of energy afterwards.
    #[serde(default)]
    pub light: bool,
}

/// A number of an element and the range that it must be in.
#[derive(Clone, Copy, Debug)]
pub struct ElementNumber {
    /// Name of the field.
    pub name: &'static str,
    /// Its value.
    pub value: f32,
    /// Lowest that is allowed.
    pub min: f32,
    /// Highest that is allowed.
    pub max: f32,
}

impl Element {
    /// All numbers of the row.
    pub fn numbers(&self) -> [ElementNumber; 14] {
        let number = |name, value, min, max| ElementNumber { name, value, min, max };
        [
            number("density", self.density, 0.05, 100_000.0),
            number("viscosity", self.viscosity, 0.0, 10.0),
            number("smoothing", self.smoothing, 0.0, 0.5),
            number("friction", self.friction, 0.0, 60.0),
            number("cohesion", self.cohesion, 0.0, 50_000.0),
            number("diffusion", self.diffusion, 0.0, 1.0),
            number("vorticity", self.vorticity, 0.0, 1.0),
            number("drag", self.drag, 0.0, 1000.0),
            number("capacity", self.capacity, 0.2, 5.0),
            number("conductivity", self.conductivity, 0.0, 500.0),
            number("energy", self.energy, 0.0, 8000.0),
            number("gas", self.gas, 0.0, 100.0),
            number("spawn", self.spawn, COLDEST, HOTTEST),
            number("flow", self.flow, f32::MIN_POSITIVE, 1.0),
        ]
    }

    /// Whether the air lifts it.
    pub fn is_gas(&self) -> bool {
        self.category == Category::Gases
    }

    /// Inertia of a lump, kg/m²: a gas moves as much air as it displaces along with it (the added mass of a cylinder, Batchelor
    /// 1967, "An introduction to fluid dynamics", §6.4). `air`: density of the air, kg/m².
    pub fn inertia(&self, air: f32) -> f32 {
        if self.is_gas() { self.density + air } else { self.density }
    }

    /// What a lump feels of gravity, as a share: a gas weighs what it has more than the air that it displaces, less than nothing
    /// if it is lighter.
    pub fn weight(&self, air: f32) -> f32 {
        if self.is_gas() { (self.density - air) / (self.density + air) } else { 1.0 }
    }

    /// An element as heavy as water, with nothing else to it.
    pub fn plain(name: &str, fixed: bool) -> Self {
        Self {
            name: name.into(),
            category: if fixed { Category::Solids } else { Category::Liquids },
            key: None,
            colour: [40, 130, 220],
            fixed,
            density: 1000.0,
            viscosity: 0.0,
            smoothing: 0.0,
            friction: 0.0,
            cohesion: 0.0,
            diffusion: 0.0,
            vorticity: 0.0,
            drag: 0.0,
            capacity: 1.0,
            conductivity: 0.5,
            energy: 0.0,
            gas: 0.0,
            spawn: ROOM,
            changes: Vec::new(),
            decays: None,
            breaks: None,
            touches: Vec::new(),
            flow: 1.0,
            card: String::new(),
        }
    }
}

fn one() -> f32 {
    1.0
}

fn half() -> f32 {
    0.5
}

fn room() -> f32 {
    ROOM
}

/// All elements, in the order of the palette within their category. Never empty, at most [`ElementTable::MOST`] rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementTable {
    rows: Vec<Element>,
}

impl ElementTable {
    /// Most rows: an id is one byte, and the rock grid keeps 255 for "no rock".
    pub const MOST: usize = 255;

    /// A table of already validated rows.
    pub fn new(rows: Vec<Element>) -> Self {
        debug_assert!(rows.len() <= Self::MOST, "an element id is one byte, and one value of it means none");
        Self { rows }
    }

    /// All rows.
    pub fn rows(&self) -> &[Element] {
        &self.rows
    }

    /// The row of `id`. Ids come from this table, so the row exists.
    pub fn get(&self, id: ElementId) -> &Element {
        &self.rows[id.index()]
    }

    /// The element called `name`.
    pub fn find(&self, name: &str) -> Option<ElementId> {
        self.iter().find(|(_, element)| element.name == name).map(|(id, _)| id)
    }

    /// All rows with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (ElementId, &Element)> {
        self.rows.iter().enumerate().map(|(row, element)| (ElementId(row as u8), element))
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row at all.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

/// XSPH c that thickens a liquid as much as the predictor's grid does, which draws particles to its own velocities: measured by
/// shear over 20 d without any other viscosity (`shear_decay` of the exam), 1.0 d²/s. What is as viscous or more needs none of it.
pub const GRID_VISCOSITY: f32 = 0.054;

/// What the kernel's passes read of the elements, in kernel units: an entry an element in each array. Built when a scene
/// opens.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementParams {
    /// Drag as k of `dv/dt = −k |v| v`, 1/d: `C / (ρ D²)` per metre, times d, with the scene's own spacing D.
    pub drag: Vec<f32>,
    /// Mass of a particle, kg/m² d²: its density, with the air that moves with a gas ([`Element::inertia`]).
    pub mass: Vec<f32>,
    /// What it feels of gravity, as a share ([`Element::weight`]).
    pub weight: Vec<f32>,
    /// XSPH c, a share a tick at the spacing of the run; beyond what 16 passes of a substep can do it is cut where it is used.
    pub viscosity: Vec<f32>,
    /// The part of that which is viscosity and no smoothing: as hard walls hold it.
    pub stickiness: Vec<f32>,
    /// Share of what the predictor's grid evens out of velocities that they still take: it is viscous itself
    /// ([`GRID_VISCOSITY`]).
    pub drawn: Vec<f32>,
    /// sin φ of grains; 0 of what is none.
    pub friction: Vec<f32>,
    /// Stress that grains bear without pressure by their density, d/s²: `cos φ c / (ρ d²)`.
    pub cohesion: Vec<f32>,
    /// Diffusion D, d²/s.
    pub diffusion: Vec<f32>,
    /// Vorticity confinement ε, d/s.
    pub vorticity: Vec<f32>,
}

/// What sets elements apart in the passes over all particles, where any of these is there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Traits<'a> {
    /// sin φ of the elements, 0 of what is no grain; none where no grain is.
    pub sines: Option<&'a [f32]>,
    /// What the elements feel of gravity, as a share; none where all feel all of it.
    pub weights: Option<&'a [f32]>,
    /// Share of what the predictor's grid evens out that the elements take; none where all take all of it.
    pub drawn: Option<&'a [f32]>,
}

/// Sine of an angle of 0 … 60 degrees, to the last bit of f32 the same everywhere: the first terms of its series, whose next is
/// less than 10⁻¹¹.
fn sine(degrees: f32) -> f32 {
    let angle = f64::from(degrees) * (std::f64::consts::PI / 180.0);
    let square = angle * angle;
    let (mut term, mut sum) = (angle, angle);
    for k in 1..7 {
        let k = f64::from(k);
        term *= -square / (2.0 * k * (2.0 * k + 1.0));
        sum += term;
    }
    sum as f32
}

impl ElementParams {
    /// The parameters of all rows of a table at a scale, in air of a density, kg/m².
    pub fn new(elements: &ElementTable, scale: Scale, air: f32) -> Self {
        let each = |of: &dyn Fn(&Element) -> f32| elements.iter().map(|(_, element)| of(element)).collect();
        let viscosity = |element: &Element| 3.2 * element.viscosity * TICK_SECONDS / (scale.spacing * scale.spacing);
        Self {
            drag: each(&|element| element.drag / (element.inertia(air) * scale.spacing * scale.particles_per_own())),
            mass: each(&|element| element.inertia(air)),
            weight: each(&|element| element.weight(air)),
            viscosity: each(&|element| viscosity(element).max(element.smoothing * scale.particles_per_own())),
            stickiness: each(&viscosity),
            drawn: each(&|element| (1.0 - viscosity(element) / GRID_VISCOSITY).max(0.0)),
            friction: each(&|element| sine(element.friction)),
            cohesion: each(&|element| {
                let sine = sine(element.friction);
                (1.0 - sine * sine).sqrt() * element.cohesion / (element.density * scale.spacing * scale.spacing)
            }),
            diffusion: each(&|element| element.diffusion / (scale.spacing * scale.spacing)),
            vorticity: each(&|element| scale.to_kernel(element.vorticity)),
        }
    }
}
