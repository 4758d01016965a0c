//! What stands, flows and blows in a random scene: shapes, emitters, winds, drains, pressures.

use super::dice::Dice;
use glam::Vec2;

/// A number in spacings, as an expression.
fn spacings(value: f64) -> String {
    format!("\"{value} * d\"")
}

/// A point in the box or somewhat outside.
fn point(dice: &mut Dice, size: Vec2) -> String {
    let mut axis = |length: f32| spacings(dice.within(f64::from(-0.2 * length), f64::from(1.2 * length)));
    format!("({}, {})", axis(size.x), axis(size.y))
}

/// Both corners of a rectangle in the box that holds at least one site.
fn area(dice: &mut Dice, size: Vec2) -> String {
    let mut axis = |length: f32| {
        let low = dice.whole(0, length as u32 - 2);
        (low, dice.whole(low + 1, length as u32))
    };
    let ((left, right), (low, high)) = (axis(size.x), axis(size.y));
    format!("min: (\"{left} * d\", \"{low} * d\"), max: (\"{right} * d\", \"{high} * d\")")
}

fn velocity(dice: &mut Dice) -> String {
    let mut axis = || match dice.below(5) {
        0 | 1 => 0.0,
        2 => dice.number(-300.0, 300.0),
        _ => dice.within(-10.0, 10.0),
    };
    format!("velocity: ({:?}, {:?})", axis(), axis())
}

fn shape(dice: &mut Dice, size: Vec2) -> String {
    match dice.below(8) {
        0..3 => format!("Rect({})", area(dice, size)),
        3 | 4 => {
            let radius = dice.within(0.12, 0.4 * f64::from(size.max_element()));
            format!("Disc(centre: {}, radius: {})", point(dice, size), spacings(radius))
        }
        5 | 6 => {
            let width = dice.within(0.2, 6.0);
            format!("Line(from: {}, to: {}, width: {})", point(dice, size), point(dice, size), spacings(width))
        }
        _ => {
            let points: Vec<String> = (0..dice.whole(3, 6)).map(|_| point(dice, size)).collect();
            format!("Polygon(points: [{}])", points.join(", "))
        }
    }
}

/// An element in a shape.
pub(super) fn placement(dice: &mut Dice, size: Vec2) -> String {
    let element = match dice.below(8) {
        0..=3 => movable(dice),
        4..=6 => "rock",
        _ => "none",
    };
    let (shape, replace) = (shape(dice, size), dice.comes(1, 2));
    let velocity = if !["rock", "none"].contains(&element) { format!(", {}", velocity(dice)) } else { String::new() };
    format!("(element: \"{element}\", shape: {shape}, replace: {replace}{velocity})")
}

/// What moves besides water.
const OTHERS: [&str; 26] = [
    "brine",
    "oil",
    "honey",
    "mercury",
    "tar",
    "sand",
    "wet_sand",
    "dust",
    "salt",
    "snow",
    "coal",
    "stone",
    "ash",
    "acid",
    "steam",
    "smoke",
    "hydrogen",
    "ice",
    "lava",
    "ember",
    "fire",
    "charcoal",
    "burning_oil",
    "nitrogen",
    "gunpowder",
    "chips",
];

/// What moves: water, or anything else as often.
fn movable(dice: &mut Dice) -> &'static str {
    if dice.comes(1, 2) { "water" } else { dice.one(&OTHERS) }
}

/// Rock in a shape.
pub(super) fn rock(dice: &mut Dice, size: Vec2) -> String {
    format!("(element: \"rock\", shape: {})", shape(dice, size))
}

/// Matter at rest from wall to wall, around the rock that stands there.
pub(super) fn pool(dice: &mut Dice, size: Vec2) -> String {
    let level = dice.whole(1, size.y as u32);
    let (width, level) = (spacings(f64::from(size.x.ceil()) + 1.0), spacings(f64::from(level)));
    format!("(element: \"{}\", shape: Rect(min: (\"-1 * d\", \"-1 * d\"), max: ({width}, {level})))", movable(dice))
}

/// An emitter.
pub(super) fn emitter(dice: &mut Dice, size: Vec2) -> String {
    let (area, velocity, rate) = (area(dice, size), velocity(dice), dice.number(0.001, 1e6));
    let mut rest = String::new();
    if dice.comes(1, 2) {
        rest += &format!(", total: {}", dice.whole(1, 5000));
    }
    if dice.comes(1, 2) {
        rest += &format!(", start: {:?}", dice.within(0.0, 0.5));
    }
    let element = movable(dice);
    format!("(element: \"{element}\", {area}, {velocity}, rate: {rate:?}{rest})")
}

/// A wind.
pub(super) fn wind(dice: &mut Dice, size: Vec2) -> String {
    format!("({}, {}, rate: {:?})", area(dice, size), velocity(dice), dice.number(0.001, 1000.0))
}

/// A drain.
pub(super) fn drain(dice: &mut Dice, size: Vec2) -> String {
    format!("({})", area(dice, size))
}

/// Air at another pressure at the start.
pub(super) fn pressure(dice: &mut Dice, size: Vec2) -> String {
    format!("({}, pressure: {:?})", area(dice, size), dice.number(0.1, 10.0))
}

/// Up to `most` of what `entry` makes.
pub(super) fn some(dice: &mut Dice, most: u32, size: Vec2, entry: fn(&mut Dice, Vec2) -> String) -> Vec<String> {
    (0..dice.whole(0, most)).map(|_| entry(dice, size)).collect()
}

#[cfg(test)]
mod tests {
    use super::OTHERS;

    #[test]
    fn random_worlds_have_all_that_moves() {
        let elements = crate::scene::elements().expect("the table that comes with the game is valid");
        let mut movable: Vec<_> = elements.iter().filter(|(_, row)| !row.fixed).map(|(_, row)| &row.name[..]).collect();
        let mut known = OTHERS.to_vec();
        known.push("water");
        movable.sort_unstable();
        known.sort_unstable();
        assert_eq!(movable, known);
    }
}
