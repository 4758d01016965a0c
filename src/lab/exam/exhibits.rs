//! The museum: cases of the exam as worlds to look at, with what theory or experiment says drawn over them, moment by moment.
//! What is claimed and where it comes from are the case's own words.

use super::{
    case::{CASES, ExamCase},
    cases::{
        dam::{self, DAM_COLUMNS},
        field::{Bore, DAM, DEEP, SHALLOW, draw_out, ellipse},
        layers::{self, slower_root},
        outflow::{LEFT_TANK, Levelling, OUTFLOW_TANK, RIGHT_TANK, WALL, fall_of_the_level},
        tank::SLOSHING_LENGTH,
    },
    set_up::{GRAVITY, scene},
};
use crate::{
    kernel::{element::Element, params::Preset},
    scene::{self as scenes, SceneError, blueprint::Blueprint, effects::EffectModes},
};
use glam::{DVec2, dvec2};
use std::f64::consts::PI;

/// Something that theory draws, m.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A line through points.
    Line(Vec<DVec2>),
    /// A circle: its middle and its radius.
    Circle(DVec2, f64),
}

/// A case of the exam as a world to look at.
pub struct Exhibit {
    /// Name of the case.
    pub name: &'static str,
    /// What is drawn.
    pub drawn: &'static str,
    /// How fast it is best looked at: as a share of the world's time.
    pub speed: f32,
    /// Scene, of the exam's own or of the game's, and its parameters.
    scene: (&'static str, &'static [(&'static str, &'static str)]),
    /// What is done to the start.
    arrange: fn(&mut Blueprint),
    /// What there is after so many seconds; nothing where theory says no more.
    theory: fn(f64) -> Vec<Mark>,
}

/// All exhibits, in the order of the museum.
pub static EXHIBITS: [Exhibit; 13] = [
    Exhibit {
        name: "free_fall",
        drawn: "Each ring goes the parabola of its particle.",
        speed: 0.25,
        scene: ("free_fall", &[]),
        arrange: as_it_is,
        theory: free_fall,
    },
    Exhibit {
        name: "falling_drop",
        drawn: "The circle falls as a rigid body would.",
        speed: 0.25,
        scene: ("falling_drop", &[]),
        arrange: as_it_is,
        theory: falling_drop,
    },
    Exhibit {
        name: "elliptic_drop",
        drawn: "The ellipse into which the disc is drawn out.",
        speed: 0.25,
        scene: ("elliptic_drop", &[]),
        arrange: draw_out,
        theory: elliptic_drop,
    },
    Exhibit {
        name: "dam_break",
        drawn: "Where the front was in the experiment, and how high the water stood at the wall.",
        speed: 0.5,
        scene: ("dam_break", &[]),
        arrange: as_it_is,
        theory: dam_break,
    },
    Exhibit {
        name: "wet_bed",
        drawn: "The surface: the fan that runs out, the plateau, and the bore before it.",
        speed: 1.0,
        scene: ("wet_bed", &[]),
        arrange: as_it_is,
        theory: wet_bed,
    },
    Exhibit {
        name: "sloshing",
        drawn: "The surface, as a sum of standing waves.",
        speed: 1.0,
        scene: ("sloshing", &[]),
        arrange: as_it_is,
        theory: sloshing,
    },
    Exhibit {
        name: "internal_wave",
        drawn: "The surface between oil and brine, as a sum of standing waves.",
        speed: 1.0,
        scene: ("layers", &[]),
        arrange: as_it_is,
        theory: internal_wave,
    },
    Exhibit {
        name: "vessels",
        drawn: "Both levels, by the flow through the slot.",
        speed: 1.0,
        scene: ("communicating_vessels", &[]),
        arrange: as_it_is,
        theory: vessels,
    },
    Exhibit {
        name: "orifice",
        drawn: "The level of the tank that runs out.",
        speed: 1.0,
        scene: ("orifice", &[("grain", "0.05")]),
        arrange: as_it_is,
        theory: orifice,
    },
    Exhibit {
        name: "u_tube",
        drawn: "Where oil and water come to rest.",
        speed: 1.0,
        scene: ("u_tube", &[]),
        arrange: as_it_is,
        theory: u_tube,
    },
    Exhibit {
        name: "ice_floats",
        drawn: "The level of the water, and the top and bottom of the ice.",
        speed: 1.0,
        scene: ("ice_floats", &[]),
        arrange: as_it_is,
        theory: ice_floats,
    },
    Exhibit {
        name: "repose",
        drawn: "The heap of all grains, with slopes at their angle of friction.",
        speed: 2.0,
        scene: ("repose", &[]),
        arrange: as_it_is,
        theory: repose,
    },
    Exhibit {
        name: "collapse",
        drawn: "How high it stands at the wall in the end, and how far it comes.",
        speed: 1.0,
        scene: ("collapse", &[("aspect", "2")]),
        arrange: as_it_is,
        theory: collapse,
    },
];

impl Exhibit {
    /// The one of a name.
    pub fn find(name: &str) -> Option<&'static Self> {
        EXHIBITS.iter().find(|exhibit| exhibit.name == name)
    }

    /// The case that it shows.
    pub fn case(&self) -> Option<&'static ExamCase> {
        CASES.iter().find(|case| case.name == self.name)
    }

    /// Its start at a quality.
    ///
    /// # Errors
    /// If it can't be had at that quality: one line that says why.
    pub fn build(&self, preset: Preset) -> Result<Blueprint, SceneError> {
        let (name, parameters) = self.scene;
        let settings: Vec<_> = parameters.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        let mut blueprint = scene(name)?.build(&settings, Some(preset), &EffectModes::new())?;
        (self.arrange)(&mut blueprint);
        Ok(blueprint)
    }

    /// What theory or experiment says of it after so many seconds; nothing before the start, and where it says no more.
    pub fn theory(&self, seconds: f64) -> Vec<Mark> {
        (self.theory)(seconds.max(0.0))
    }
}

fn as_it_is(_: &mut Blueprint) {}

/// A number of an element that comes with the game.
fn of_element(name: &str, number: fn(&Element) -> f32) -> f64 {
    let elements = scenes::elements().ok();
    let row = elements.as_ref().and_then(|elements| elements.find(name).map(|id| elements.get(id)));
    row.map_or(f64::NAN, |row| f64::from(number(row)))
}

fn density(name: &str) -> f64 {
    of_element(name, |element| element.density)
}

/// A level between two places.
fn level(from: f64, to: f64, height: f64) -> Mark {
    Mark::Line(vec![dvec2(from, height), dvec2(to, height)])
}

/// A function of x between two places.
fn curve(from: f64, to: f64, of: impl Fn(f64) -> f64) -> Mark {
    const PIECES: u32 = 120;
    let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(PIECES);
    Mark::Line((0..=PIECES).map(|k| dvec2(at(k), of(at(k)))).collect())
}

/// Places (m) and velocities (m/s) of assets/exam/free_fall.ron.
const THROWN: [[f64; 4]; 6] = [
    [2.05, 9.05, 0.0, 0.0],
    [5.05, 8.05, 3.0, 0.0],
    [16.05, 9.05, -4.0, 0.0],
    [10.05, 7.05, 0.0, 3.0],
    [13.05, 10.05, 0.0, -3.0],
    [18.05, 8.05, 1.0, 2.0],
];

/// A place after a fall of `t` s.
fn fallen([x, y, u, v]: [f64; 4], t: f64) -> DVec2 {
    dvec2(x + u * t, y + v * t - 0.5 * GRAVITY * t * t)
}

fn free_fall(t: f64) -> Vec<Mark> {
    let rings = THROWN.map(|thrown| fallen(thrown, t)).into_iter().filter(|at| at.y > 0.0);
    rings.map(|at| Mark::Circle(at, 0.3)).collect()
}

fn falling_drop(t: f64) -> Vec<Mark> {
    let (middle, radius) = (fallen([4.0, 10.0, 2.0, 0.0], t), 2.0);
    if middle.y > radius { vec![Mark::Circle(middle, radius)] } else { Vec::new() }
}

/// Middle of the box of the elliptic drop, and radius at the start, m.
const DROP: ([f64; 2], f64) = ([5.0, 9.0], 3.0);

fn elliptic_drop(t: f64) -> Vec<Mark> {
    let ([x, y], radius) = DROP;
    let [a, b] = ellipse(t).map(|axis| axis * radius);
    // Then it touches the box.
    if b > y {
        return Vec::new();
    }
    let at = |k: u32| {
        let (sine, cosine) = (PI * f64::from(k) / 60.0).sin_cos();
        dvec2(x + a * cosine, y + b * sine)
    };
    vec![Mark::Line((0..=120).map(at).collect())]
}

fn dam_break(t: f64) -> Vec<Mark> {
    let base = DAM_COLUMNS * 0.1;
    let time = t * (GRAVITY / base).sqrt();
    let (front, height) = (dam::front(time * 2.0_f64.sqrt()) * base, dam::height(time) * 2.0 * base);
    let ticks = [[dvec2(front, 0.0), dvec2(front, 2.0)], [dvec2(0.0, height), dvec2(1.6, height)]];
    // The experiment's channel was longer than this box of four bases.
    let is_here = |tick: &[DVec2; 2]| tick[1].is_finite() && tick[1].x <= 4.0 * base;
    ticks.into_iter().filter(is_here).map(|tick| Mark::Line(tick.to_vec())).collect()
}

fn wet_bed(t: f64) -> Vec<Mark> {
    let (bore, still) = (Bore::of(DEEP, SHALLOW), (GRAVITY * DEEP).sqrt());
    let (head, tail) = (DAM - still * t, DAM + (bore.flow - (GRAVITY * bore.depth).sqrt()) * t);
    let front = DAM + bore.speed * t;
    // The bore is followed until it is half a depth from the end of the box.
    if front > 78.0 {
        return Vec::new();
    }
    // Ritter's fan: `√(g h) = (2 √(g H) − (x − x₀)/t)/3`.
    let fan = |x: f64| ((2.0 * still - (x - DAM) / t.max(1e-9)) / 3.0).powi(2) / GRAVITY;
    let mut surface = vec![dvec2(0.0, DEEP), dvec2(head, DEEP)];
    surface.extend((1..30).map(|k| head + (tail - head) * f64::from(k) / 30.0).map(|x| dvec2(x, fan(x))));
    surface.extend([dvec2(tail, bore.depth), dvec2(front, bore.depth), dvec2(front, SHALLOW), dvec2(80.0, SHALLOW)]);
    vec![Mark::Line(surface)]
}

/// A surface at `height` that was tilted by ±`tilt` over `length`, as the sum of the standing waves that it consists of; `rate`
/// gives ω of a wave number.
fn tilted(t: f64, (length, height, tilt): (f64, f64, f64), rate: impl Fn(f64) -> f64) -> Mark {
    // cos(n π x/L) of odd n, n⁻² as high each.
    let waves = [1.0, 3.0, 5.0, 7.0, 9.0].map(|n: f64| {
        let k = n * PI / length;
        (k, 8.0 * tilt / (PI * n).powi(2) * (rate(k) * t).cos())
    });
    curve(0.0, length, |x| height + waves.iter().map(|(k, high)| high * (k * x).cos()).sum::<f64>())
}

fn sloshing(t: f64) -> Vec<Mark> {
    let depth = 3.0;
    vec![tilted(t, (SLOSHING_LENGTH, depth, 0.3), |k| (GRAVITY * k * (k * depth).tanh()).sqrt())]
}

fn internal_wave(t: f64) -> Vec<Mark> {
    let (light, heavy) = (density("oil"), density("brine"));
    vec![tilted(t, (layers::LENGTH, layers::DEPTH, 0.2), |k| slower_root(k, light, heavy))]
}

fn vessels(t: f64) -> Vec<Mark> {
    let [left, right] = Levelling::after(t);
    let beyond = LEFT_TANK + WALL;
    vec![level(0.0, LEFT_TANK, left), level(beyond, beyond + RIGHT_TANK, right)]
}

fn orifice(t: f64) -> Vec<Mark> {
    vec![level(0.0, OUTFLOW_TANK, fall_of_the_level(t))]
}

/// Heights of water in the arms of assets/exam/u_tube.ron at the start, and of the oil, m.
const ARMS: [f64; 2] = [3.0, 5.0];
const OIL: f64 = 4.0;

fn u_tube(_: f64) -> Vec<Mark> {
    // Both arms are as wide, so what sinks in one rises in the other.
    let held = OIL * density("oil") / density("water");
    let between = 0.5 * (ARMS[0] + ARMS[1] - held);
    vec![level(0.0, 1.0, between), level(0.0, 1.0, between + OIL), level(2.0, 3.0, between + held)]
}

/// Width of the tank, volume of water and size of the ice of assets/exam/ice_floats.ron, m and m².
const ICE_TANK: f64 = 9.0;
const ICE_WATER: f64 = 9.0 * 4.0 - 3.0 * 1.4;
const ICE: [f64; 2] = [3.0, 1.5];

fn ice_floats(_: f64) -> Vec<Mark> {
    let under = density("ice") / density("water");
    let surface = (ICE_WATER + under * ICE[0] * ICE[1]) / ICE_TANK;
    let [top, bottom] = [surface + (1.0 - under) * ICE[1], surface - under * ICE[1]];
    vec![level(0.0, ICE_TANK, surface), level(3.0, 6.0, top), level(3.0, 6.0, bottom)]
}

/// Grains of the heap, and their spacing, m.
const GRAINS: f64 = 1500.0;
const GRAIN: f64 = 0.1;

fn repose(_: f64) -> Vec<Mark> {
    let slope = of_element("sand", |element| element.friction).to_radians().tan();
    let (height, middle) = ((GRAINS * GRAIN * GRAIN * slope).sqrt(), 2.0 * GRAINS.sqrt() * GRAIN);
    let foot = height / slope;
    vec![Mark::Line(vec![dvec2(middle - foot, 0.0), dvec2(middle, height), dvec2(middle + foot, 0.0)])]
}

/// Length of the column of sand, m.
const COLUMN: f64 = 8.0;

fn collapse(_: f64) -> Vec<Mark> {
    let aspect: f64 = 2.0;
    let (height, front) = (aspect.cbrt() * COLUMN, (1.0 + 1.2 * aspect) * COLUMN);
    vec![level(0.0, 3.0, height), Mark::Line(vec![dvec2(front, 0.0), dvec2(front, 2.0)])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::{simulation::Simulation, state::ParticleStore, workers::Workers};
    use std::sync::Arc;

    fn points(marks: &[Mark]) -> Vec<DVec2> {
        let of = |mark: &Mark| match mark {
            Mark::Line(points) => points.clone(),
            Mark::Circle(middle, radius) => {
                [DVec2::X, -DVec2::X, DVec2::Y, -DVec2::Y].map(|way| *middle + *radius * way).to_vec()
            }
        };
        marks.iter().flat_map(of).collect()
    }

    #[test]
    fn every_exhibit_is_a_case_and_draws_within_its_box() {
        for (k, exhibit) in EXHIBITS.iter().enumerate() {
            assert!(EXHIBITS[..k].iter().all(|other| other.name != exhibit.name), "{} twice", exhibit.name);
            assert!(exhibit.case().is_some(), "{} is no case of the exam", exhibit.name);
            let blueprint = exhibit.build(Preset::Balanced).unwrap();
            let size = blueprint.domain.size.as_dvec2() * f64::from(blueprint.scale.spacing);
            for t in [0.0, 0.3, 1.0, 3.0, 30.0] {
                for at in points(&exhibit.theory(t)) {
                    let inside = at.is_finite() && at.cmpge(dvec2(-0.4, -0.4)).all() && at.cmple(size + 0.4).all();
                    assert!(inside, "{} after {t} s: {at}", exhibit.name);
                }
            }
            let moment = if exhibit.name == "dam_break" { 0.5 } else { 0.1 };
            assert!(!exhibit.theory(moment).is_empty(), "{} draws nothing", exhibit.name);
        }
        assert!(Exhibit::find("no such case").is_none());
    }

    /// What is drawn at the start lies where the matter is.
    #[test]
    fn what_is_drawn_at_the_start_is_the_start() {
        for (name, expected) in [
            ("sloshing", 3.0 + 0.3),
            ("internal_wave", 1.5 + 0.2),
            ("wet_bed", 4.0),
            ("vessels", 5.0),
            ("orifice", 4.0),
        ] {
            let at = points(&Exhibit::find(name).unwrap().theory(0.0))[0];
            assert!((at.y - expected).abs() < 0.02, "{name}: {at}");
        }
    }

    #[test]
    fn the_world_goes_where_theory_says() {
        let run = |name: &str, ticks: u32| {
            let blueprint = Exhibit::find(name).unwrap().build(Preset::Balanced).unwrap();
            let d = f64::from(blueprint.scale.spacing);
            let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
            simulation.run(ticks);
            let particles = simulation.get::<ParticleStore>();
            let places: Vec<DVec2> = (0..particles.len()).map(|i| particles.position(i).as_dvec2() * d).collect();
            (places, Exhibit::find(name).unwrap().theory(f64::from(ticks) / 60.0))
        };
        let (places, marks) = run("free_fall", 60);
        for mark in &marks {
            let Mark::Circle(middle, _) = mark else { panic!("rings") };
            assert!(places.iter().any(|at| at.distance(*middle) < 0.01), "nothing is at {middle}");
        }
        assert_eq!(marks.len(), places.len());
        let (places, marks) = run("elliptic_drop", 60);
        let top = |places: &[DVec2]| places.iter().map(|at| at.y).fold(f64::MIN, f64::max);
        assert!((top(&places) + 0.05 - top(&points(&marks))).abs() < 0.1, "the long axis");
    }
}
