//! The curves of all elements, from the changes in their rows.
//!
//! Where the curves stand beside one another follows from the changes. What is at rest at [`ROOM`] holds no heat there. What
//! comes of it by a change at T holds as much as it at T, and what the change takes more; so the other way round. As heat is a
//! state, no way round through changes can give any: where two ways lead to one element they must agree, or the table is
//! refused. What is never at rest at [`ROOM`] and boils away to air alone leaves it no heat.

use crate::{
    element::{Element, ElementChange, ElementId, ElementTable},
    heat::{
        curve::{Change, HeatCurve, conduction_of},
        rates::OF_GAS,
        units::{COLDEST, HOTTEST, QUANTUM, ROOM},
    },
};

/// What lumps go into that are no more.
pub const AIR: &str = "air";
/// By how much two ways to an element may differ, MJ/m²: what numbers in a table are rounded to.
const AGREE: f64 = 1.0;
/// Most heat that an element may hold, MJ/m²: what counts in quanta, and some room.
const MOST: f64 = 16_000.0;
/// Most turns of a change.
pub const MOST_TURNS: usize = 16;

/// What is wrong with the changes of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFault {
    /// Index of the row.
    pub row: usize,
    /// What it is, and what is allowed.
    pub what: String,
}

/// How warm all elements are by their heat.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatTable {
    curves: Vec<HeatCurve>,
    /// Heat of a new lump, quanta.
    spawn: Vec<i32>,
    /// Chemical energy, quanta.
    energy: Vec<i32>,
}

impl HeatTable {
    /// That of a table of already validated rows.
    pub fn new(elements: &ElementTable) -> Self {
        let rows = elements.rows();
        let plain = |row: &Element| HeatCurve::plain(1e6 * row.capacity, row.conductivity);
        let curves = curves(rows).unwrap_or_else(|_| rows.iter().map(plain).collect());
        let spawn = |(curve, row): (&HeatCurve, &Element)| if row.spawn == ROOM { 0 } else { curve.heat(row.spawn) };
        let spawn = curves.iter().zip(rows).map(spawn).collect();
        let energy = rows.iter().map(|row| quanta(f64::from(row.energy))).collect();
        Self { curves, spawn, energy }
    }

    /// The curve of an element.
    #[inline(always)]
    pub fn curve(&self, id: ElementId) -> &HeatCurve {
        &self.curves[id.index()]
    }

    /// The curves of all elements, in the order of their ids.
    pub fn curves(&self) -> &[HeatCurve] {
        &self.curves
    }

    /// Heat of a new lump of an element, quanta.
    pub fn spawn_heat(&self, id: ElementId) -> i32 {
        self.spawn[id.index()]
    }

    /// Chemical energy of a lump of an element beside its heat, quanta: what another has less is set free when it becomes that.
    #[inline(always)]
    pub fn energy(&self, id: ElementId) -> i32 {
        self.energy[id.index()]
    }
}

/// A change with its products looked up.
struct Looked {
    at: f64,
    /// 1 for what happens above, −1 for what happens below.
    sign: f64,
    /// The first of the products that is an element; none where all is air.
    first: Option<usize>,
    into: Vec<Option<ElementId>>,
    latent: Option<f64>,
}

impl Looked {
    /// The products, if none of them is air.
    fn parts(&self) -> Option<Vec<usize>> {
        self.into.iter().map(|part| part.map(ElementId::index)).collect()
    }
}

/// The curves of the rows.
///
/// # Errors
/// If a change leads nowhere, or two of them contradict each other.
pub fn curves(rows: &[Element]) -> Result<Vec<HeatCurve>, CurveFault> {
    let mut changes = Vec::with_capacity(rows.len());
    for (row, element) in rows.iter().enumerate() {
        changes.push(look_up(rows, element).map_err(|what| CurveFault { row, what })?);
    }
    let bases = bases(rows, &changes)?;
    let held = |row: usize, kelvin: f64| bases[row] + f64::from(rows[row].capacity) * (kelvin - f64::from(ROOM));
    let mut curves = Vec::with_capacity(rows.len());
    for (row, (element, changes)) in rows.iter().zip(&changes).enumerate() {
        let fault = |what: String| CurveFault { row, what };
        let end = |sign: f64, end: f32| {
            changes.iter().find(|change| change.sign == sign).map_or(f64::from(end), |change| change.at)
        };
        for kelvin in [end(-1.0, COLDEST), end(1.0, HOTTEST)] {
            let held = held(row, kelvin);
            if held.abs() > MOST {
                return Err(fault(format!("it holds {held:.0} MJ/m² at {kelvin} K; allowed: at most {MOST}")));
            }
        }
        let mut curve = HeatCurve {
            base: quanta(bases[row]),
            openness: if element.is_gas() { OF_GAS } else { 1.0 },
            ..HeatCurve::plain(element.capacity * 1e6, element.conductivity)
        };
        for change in changes {
            let begin = held(row, change.at);
            // What the products hold together at that temperature, to each lump. What the air gets of what goes into it is no
            // matter of the table.
            let parts = change.parts();
            let whole = parts
                .as_ref()
                .map(|parts| parts.iter().map(|part| held(*part, change.at)).sum::<f64>() / parts.len() as f64);
            let after = whole.or_else(|| change.first.map(|first| held(first, change.at)));
            let takes = after.map_or(change.latent.unwrap_or_default(), |after| change.sign * (after - begin));
            let latent = match change.latent {
                Some(latent) if whole.is_some() && (latent - takes).abs() > AGREE => {
                    let what = format!(
                        "at {} K it takes {latent} MJ/m², but by the other changes {takes:.1}; allowed: one of both",
                        change.at
                    );
                    return Err(fault(what));
                }
                Some(latent) if whole.is_none() => latent,
                _ => takes,
            };
            if latent < 0.0 {
                let what = format!("at {} K it takes {latent:.1} MJ/m²; allowed: 0 or more", change.at);
                return Err(fault(what));
            }
            let product = conduction_of(change.first.map_or(element, |first| &rows[first]).conductivity);
            let products = change.into.iter().flatten().map(|id| 1e6 * rows[id.index()].capacity);
            curve.least_capacity = products.fold(curve.least_capacity, f32::min);
            let plateau = [quanta(begin), quanta(begin + change.sign * latent)];
            // Each has what it holds at that temperature; beside air there is nothing to share.
            let share = |part: usize| quanta(held(part, change.at)) - plateau[1];
            let mut shares =
                parts.map_or_else(|| vec![0; change.into.len()], |parts| parts.into_iter().map(share).collect());
            shares[0] -= shares.iter().sum::<i32>();
            let own = Some(Change { at: change.at as f32, plateau, into: change.into.clone(), shares });
            if change.sign > 0.0 {
                (curve.above, curve.conduction[2]) = (own, product);
            } else {
                (curve.below, curve.conduction[1]) = (own, product);
            }
        }
        curves.push(curve);
    }
    Ok(curves)
}

fn quanta(megajoules: f64) -> i32 {
    (megajoules * 1e6 / f64::from(QUANTUM)).round() as i32
}

/// Looks up the products of a row's changes.
fn look_up(rows: &[Element], element: &Element) -> Result<Vec<Looked>, String> {
    let mut looked: Vec<Looked> = Vec::new();
    for ElementChange { above, below, into, latent } in &element.changes {
        let (at, sign) = match (above, below) {
            (Some(at), None) => (*at, 1.0),
            (None, Some(at)) => (*at, -1.0),
            _ => return Err("a change; allowed: either `above` or `below` a temperature".to_owned()),
        };
        if !(COLDEST..=HOTTEST).contains(&at) {
            return Err(format!("a change at {at} K; allowed: {COLDEST} to {HOTTEST}"));
        }
        if looked.iter().any(|other| other.sign == sign) {
            return Err("two changes the same way; allowed: one above, one below".to_owned());
        }
        if latent.is_some_and(|latent| !(0.0..=MOST as f32).contains(&latent)) {
            return Err(format!("a latent heat of {latent:?} MJ/m²; allowed: 0 to {MOST}"));
        }
        if into.is_empty() || into.len() > MOST_TURNS {
            return Err(format!("a change into {} lumps in turn; allowed: 1 to {MOST_TURNS}", into.len()));
        }
        let find = |name: &String| match rows.iter().position(|row| row.name == *name) {
            _ if name == AIR => Ok(None),
            Some(row) if rows[row].name != element.name => Ok(Some(ElementId(row as u8))),
            _ => Err(format!("a change into `{}`; allowed: another element, or `{AIR}`", name.escape_debug())),
        };
        let into: Vec<Option<ElementId>> = into.iter().map(find).collect::<Result<_, _>>()?;
        if let Some(other) =
            into.iter().flatten().map(|id| &rows[id.index()]).find(|other| other.energy != element.energy)
        {
            return Err(format!(
                "a change into `{}`, which has {} MJ/m² of energy; allowed: as much as its own {}",
                other.name, other.energy, element.energy
            ));
        }
        let first = into.iter().flatten().next().map(|id| id.index());
        if first.is_none() && latent.is_none() {
            return Err(format!(
                "a change into `{AIR}` alone; allowed: a `latent`, or an element among what comes of it"
            ));
        }
        looked.push(Looked { at: f64::from(at), sign, first, latent: latent.map(f64::from), into });
    }
    if let [a, b] = &looked[..]
        && (a.at - b.at) * a.sign <= 0.0
    {
        return Err(format!(
            "changes above {} and below {} K; allowed: the first hotter",
            a.at.min(b.at),
            a.at.max(b.at)
        ));
    }
    Ok(looked)
}

/// What each element holds at [`ROOM`] on its own slope, MJ/m².
fn bases(rows: &[Element], changes: &[Vec<Looked>]) -> Result<Vec<f64>, CurveFault> {
    let room = f64::from(ROOM);
    let rests = |changes: &Vec<Looked>| changes.iter().all(|change| (change.at - room) * change.sign > 0.0);
    let mut bases: Vec<Option<f64>> = changes.iter().map(|changes| rests(changes).then_some(0.0)).collect();
    loop {
        let mut is_done = true;
        for (row, changes) in changes.iter().enumerate() {
            for change @ Looked { at, sign, first, latent, .. } in changes {
                let Some(latent) = latent else { continue };
                // What parts into several says nothing of one of them.
                if change.into.len() > 1 && change.parts().is_some() {
                    continue;
                }
                let slope = |row: usize| f64::from(rows[row].capacity) * (at - room);
                match (bases[row], first.map(|first| (first, bases[first]))) {
                    (Some(base), Some((first, None))) => {
                        bases[first] = Some(base + slope(row) + sign * latent - slope(first));
                    }
                    (None, Some((first, Some(base)))) => {
                        bases[row] = Some(base + slope(first) - sign * latent - slope(row));
                    }
                    (None, None) => bases[row] = Some(-sign * latent - slope(row)),
                    _ => continue,
                }
                is_done = false;
            }
        }
        if is_done {
            break;
        }
    }
    let unknown = |row: usize| CurveFault {
        row,
        what: format!("what it holds at {ROOM} K follows from no change; allowed: a `latent` on the way to it"),
    };
    bases.into_iter().enumerate().map(|(row, base)| base.ok_or_else(|| unknown(row))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, capacity: f32, changes: Vec<ElementChange>) -> Element {
        Element { capacity, changes, ..Element::plain(name, false) }
    }

    fn above(at: f32, into: &[&str], latent: Option<f32>) -> ElementChange {
        ElementChange {
            above: Some(at),
            below: None,
            into: into.iter().map(|name| (*name).to_owned()).collect(),
            latent,
        }
    }

    fn below(at: f32, into: &[&str], latent: Option<f32>) -> ElementChange {
        ElementChange { above: None, below: Some(at), ..above(at, into, latent) }
    }

    fn water() -> Vec<Element> {
        vec![
            row("water", 4.19, vec![below(273.0, &["ice"], Some(334.0)), above(373.0, &["steam"], Some(452.0))]),
            row("ice", 1.93, vec![above(273.0, &["water"], None)]),
            row("steam", 0.3, vec![below(373.0, &["water"], None)]),
        ]
    }

    #[test]
    fn both_sides_of_a_change_meet_at_its_temperature() {
        let curves = curves(&water()).expect("sound");
        for (own, other) in [(0, 1), (0, 2), (1, 0), (2, 0)] {
            let change = if other == 1 { &curves[own].below } else { &curves[own].above };
            let change = if own == 0 {
                change
            } else {
                curves[own].above.as_ref().map_or(&curves[own].below, |_| &curves[own].above)
            };
            let Change { at, plateau, .. } = change.as_ref().expect("a change");
            for heat in plateau {
                let [a, b] = [own, other].map(|row| curves[row].temperature(*heat));
                assert!((a - at).abs() < 1e-3 && (b - at).abs() < 1e-3, "{own} to {other}: {a} and {b} K at {at} K");
            }
        }
        // Melted and frozen again, a lump has the heat that it had.
        let [melts, freezes] =
            [&curves[1].above, &curves[0].below].map(|change| change.as_ref().expect("a change").plateau);
        assert_eq!(melts, [freezes[1], freezes[0]]);
    }

    #[test]
    fn what_is_about_to_split_may_take_less_than_its_first_product() {
        let mut rows = water();
        rows.push(row("brine", 4.0, vec![above(375.0, &["steam", "salt"], None)]));
        rows.push(row("salt", 1.1, vec![]));
        rows.push(row("snow", 0.42, vec![above(273.0, &["water", "air", "air"], Some(67.0))]));
        let curves = curves(&rows).expect("sound");
        let boils = curves[3].above.as_ref().expect("it boils");
        let [begin, end] = boils.plateau;
        // What steam and salt hold at 375 K, less what brine does: the latent heat follows.
        let takes = (4.19 * 80.0 + 452.0 + 0.3 * 2.0 + 1.1 * 82.0) / 2.0 - 4.0 * 82.0;
        assert!((f64::from(end - begin) * f64::from(QUANTUM) / 1e6 - takes).abs() < 0.1, "it does not take {takes}");
        let [steam, salt] = [0, 1].map(|k| end + boils.shares[k]);
        let hot = [curves[2].temperature(steam), curves[4].temperature(salt)];
        assert!(hot.iter().all(|kelvin| (kelvin - 375.0).abs() < 0.01), "{hot:?} K");
        assert_eq!(steam + salt, 2 * end);
        assert_eq!(
            curves[5].above.as_ref().map(|change| change.into.clone()),
            Some(vec![Some(ElementId(0)), None, None])
        );
    }

    #[test]
    fn what_boils_away_takes_its_latent_heat_and_leaves_the_air_none() {
        let mut rows = water();
        rows.push(row("nitrogen", 1.5, vec![above(77.0, &["air"], Some(32.0))]));
        let curves = curves(&rows).expect("sound");
        let [begin, end] = curves[3].above.as_ref().expect("it boils").plateau;
        assert_eq!((end, f64::from(begin) * f64::from(QUANTUM)), (0, -32e6));
        assert_eq!(curves[3].heat(77.0), begin);
    }

    #[test]
    fn contradictions_are_refused() {
        let fault = |rows: &[Element]| curves(rows).expect_err("a fault").what;
        let with = |k: usize, changes: Vec<ElementChange>| {
            let mut rows = water();
            rows[k].changes = changes;
            rows
        };
        for (rows, expected) in [
            (with(1, vec![above(273.0, &["water"], Some(300.0))]), "it takes 300 MJ/m², but by the other changes 334"),
            (with(1, vec![above(273.0, &["ice"], None)]), "into `ice`; allowed: another element, or `air`"),
            (with(1, vec![above(273.0, &["wine"], None)]), "into `wine`"),
            (with(1, vec![above(273.0, &["air"], None)]), "into `air` alone; allowed: a `latent`"),
            (
                with(2, vec![below(373.0, &["water"], None), above(3000.0, &["ice", "water"], Some(13_000.0))]),
                "it takes 13000 MJ/m², but by the other changes",
            ),
            (with(1, vec![above(273.0, &[], None)]), "into 0 lumps"),
            (with(1, vec![above(5000.0, &["water"], None)]), "at 5000 K; allowed: 1 to 4000"),
            (with(1, vec![above(f32::NAN, &["water"], None)]), "at NaN K"),
            (with(1, vec![above(273.0, &["water"], Some(-1.0))]), "a latent heat"),
            (with(1, vec![above(273.0, &["water"], None), above(280.0, &["steam"], None)]), "two changes the same way"),
            (with(0, vec![below(373.0, &["ice"], Some(1.0)), above(273.0, &["steam"], Some(1.0))]), "the first hotter"),
            (with(0, vec![]), "follows from no change"),
            (
                with(1, vec![ElementChange { above: Some(1.0), ..below(2.0, &["water"], None) }]),
                "either `above` or `below`",
            ),
        ] {
            assert!(fault(&rows).contains(expected), "{}", fault(&rows));
        }
        // What melts must not give heat.
        let rows = [row("a", 5.0, vec![above(1000.0, &["b"], None)]), row("b", 1.0, vec![])];
        assert!(fault(&rows).contains("it takes -2828.0 MJ/m²; allowed: 0 or more"), "{}", fault(&rows));
        let rows = [
            row("a", 5.0, vec![above(300.0, &["b"], Some(15_000.0))]),
            row("b", 1.0, vec![below(300.0, &["a"], None)]),
        ];
        assert!(fault(&rows).contains("allowed: at most 16000"), "{}", fault(&rows));
    }
}
