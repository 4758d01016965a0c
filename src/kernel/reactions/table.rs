//! What becomes of which elements where they touch, from the rows of the elements.

use crate::{
    element::{Element, ElementId, ElementTable, ElementTouch},
    heat::{
        table::AIR,
        units::{COLDEST, HOTTEST},
    },
    random::threshold,
};

/// Reactions a second of a contact, lowest and highest: at the highest a contact of a tick is as likely to react as not.
const RATES: [f32; 2] = [1e-3, 60.0];

/// A reaction.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// What becomes of the element that has the row, and of the other; none is air.
    pub into: [Option<ElementId>; 2],
    /// The die of a contact falls below it.
    pub threshold: u32,
    /// Lowest and highest temperature of both, K.
    pub between: [f32; 2],
}

/// What is wrong with the touches of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchFault {
    /// Index of the row.
    pub row: usize,
    /// What it is, and what is allowed.
    pub what: String,
}

/// All reactions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReactionTable {
    reactions: Vec<Reaction>,
    /// Elements of each reaction: that which has the row, and the other.
    pairs: Vec<[ElementId; 2]>,
    /// One more than the reaction of each pair of elements, row by row; 0 is none.
    of_pair: Vec<u16>,
    elements: usize,
}

impl ReactionTable {
    /// That of a table of already validated rows, for particles of a detail: a front passes each in `1/rate`, so finer ones react as
    /// much sooner, and the front is as fast.
    pub fn new(elements: &ElementTable, detail: f32) -> Self {
        Self::of_rows(elements.rows(), detail).unwrap_or_default()
    }

    /// That of rows, for particles of a detail.
    ///
    /// # Errors
    /// If a row's touches lead nowhere, or two rows say what becomes of the same two elements.
    pub fn of_rows(rows: &[Element], detail: f32) -> Result<Self, TouchFault> {
        let mut table = Self { elements: rows.len(), of_pair: vec![0; rows.len() * rows.len()], ..Self::default() };
        for (row, element) in rows.iter().enumerate() {
            for touch in &element.touches {
                table.add(rows, row, touch, detail).map_err(|what| TouchFault { row, what })?;
            }
        }
        Ok(table)
    }

    fn add(&mut self, rows: &[Element], row: usize, touch: &ElementTouch, detail: f32) -> Result<(), String> {
        let find = |name: &str| rows.iter().position(|row| row.name == *name);
        let Some(other) = find(&touch.with) else {
            return Err(format!("with `{}`; allowed: an element", touch.with.escape_debug()));
        };
        if rows[row].fixed && rows[other].fixed {
            return Err(format!("with `{}`; allowed: something that moves, or of what moves", touch.with));
        }
        let product = |name: &String| match find(name) {
            _ if name == AIR => Ok(None),
            Some(product) => Ok(Some(ElementId(product as u8))),
            None => Err(format!("into `{}`; allowed: an element, or `{AIR}`", name.escape_debug())),
        };
        let into = [product(&touch.into.0)?, product(&touch.into.1)?];
        for (from, product) in [row, other].into_iter().zip(into) {
            let energy = product.map_or(0.0, |product| rows[product.index()].energy);
            if energy > rows[from].energy && !touch.light {
                let (name, own) = (&rows[from].name, rows[from].energy);
                return Err(format!(
                    "`{name}` into {energy} MJ/m² of energy; allowed: at most its own {own}, or `light`"
                ));
            }
        }
        let pair = [row, other].map(|row| ElementId(row as u8));
        if into == pair.map(Some) {
            return Err(format!("with `{}` into the same; allowed: something else", touch.with));
        }
        let [low, high] = RATES;
        if !(low..=high).contains(&touch.rate) {
            return Err(format!("a rate of {}; allowed: {low} to {high} a second", touch.rate));
        }
        let (coldest, hottest) = touch.between.unwrap_or((COLDEST, HOTTEST));
        if !(COLDEST <= coldest && coldest < hottest && hottest <= HOTTEST) {
            return Err(format!("between {coldest} and {hottest} K; allowed: {COLDEST} to {HOTTEST}, rising"));
        }
        self.reactions.push(Reaction { into, threshold: threshold(touch.rate * detail), between: [coldest, hottest] });
        self.pairs.push(pair);
        for [a, b] in [[row, other], [other, row]] {
            let place = &mut self.of_pair[a * rows.len() + b];
            if *place != 0 && a != b {
                return Err(format!("with `{}` once more; allowed: one row for two elements", touch.with));
            }
            *place = self.reactions.len() as u16;
        }
        Ok(())
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.reactions.is_empty()
    }

    /// Elements of each reaction.
    pub fn pairs(&self) -> &[[ElementId; 2]] {
        &self.pairs
    }

    /// Index of the reaction of two elements.
    #[inline(always)]
    pub fn find(&self, a: ElementId, b: ElementId) -> Option<usize> {
        usize::from(self.of_pair[a.index() * self.elements + b.index()]).checked_sub(1)
    }

    /// A reaction.
    #[inline(always)]
    pub fn get(&self, index: usize) -> &Reaction {
        &self.reactions[index]
    }

    /// What becomes of `a` in a reaction, and of what it reacts with.
    pub fn products(&self, index: usize, a: ElementId) -> [Option<ElementId>; 2] {
        let [first, second] = self.reactions[index].into;
        if self.pairs[index][0] == a { [first, second] } else { [second, first] }
    }

    /// Whether any two that react are both there, by how many there are of each element.
    pub fn is_called_for(&self, counts: &[u32]) -> bool {
        let count = |id: ElementId| counts.get(id.index()).copied().unwrap_or(0);
        self.pairs.iter().any(|[a, b]| if a == b { count(*a) > 1 } else { count(*a) > 0 && count(*b) > 0 })
    }
}
