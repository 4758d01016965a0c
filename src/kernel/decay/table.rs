//! What becomes of which elements in time, from their rows.

use crate::{
    element::{Element, ElementId, ElementTable},
    heat::{
        table::{AIR, MOST_TURNS},
        units::{COLDEST, HOTTEST, ROOM},
    },
    random::threshold,
};

/// Length of open surface that lets enough air to a lump, d. A lump of a plane surface has 1, under a heap of grains .30, and one
/// row further in nothing.
pub const OPEN: f32 = 0.25;
/// Shortest and longest time, s.
const TIMES: [f32; 2] = [0.02, 1000.0];

/// What becomes of an element in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Decay {
    /// Temperature from which on it does, K.
    pub above: f32,
    /// The die falls below it.
    pub threshold: u32,
    /// Whether it needs air.
    pub needs_air: bool,
    /// What comes of it, in turn; none is air.
    pub into: Vec<Option<ElementId>>,
}

/// What is wrong with the decay of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct DecayFault {
    /// Index of the row.
    pub row: usize,
    /// What it is, and what is allowed.
    pub what: String,
}

/// What becomes of all elements in time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DecayTable {
    decays: Vec<Option<Decay>>,
    /// See [`DecayTable::ignition`].
    ignition: Vec<Option<f32>>,
}

impl DecayTable {
    /// That of a table of already validated rows, for particles of a detail.
    pub fn new(elements: &ElementTable, detail: f32) -> Self {
        Self::of_rows(elements.rows(), detail).unwrap_or_else(|_| {
            let count = elements.len();
            Self { decays: vec![None; count], ignition: vec![None; count] }
        })
    }

    /// That of rows, for particles of a detail. What needs air burns row by row from its surface, so finer lumps burn out as
    /// much sooner, and the surface recedes as fast.
    ///
    /// # Errors
    /// If a row's decay leads nowhere, or to more energy than there was.
    pub fn of_rows(rows: &[Element], detail: f32) -> Result<Self, DecayFault> {
        let decays = (0..rows.len()).map(|row| look_up(rows, row, detail).map_err(|what| DecayFault { row, what }));
        let decays = decays.collect::<Result<Vec<_>, _>>()?;
        let ignition = (0..rows.len()).map(|row| ignition(rows, row, &decays)).collect();
        Ok(Self { decays, ignition })
    }

    /// That of an element.
    #[inline(always)]
    pub fn of(&self, element: ElementId) -> Option<&Decay> {
        self.decays[element.index()].as_ref()
    }

    /// Temperature from which on an element burns, K: its decay sets chemical energy free, or heat makes it something that burns, as
    /// charcoal ember. None of what can't burn.
    pub fn ignition(&self, element: ElementId) -> Option<f32> {
        self.ignition[element.index()]
    }

    /// The lowest temperature from which on any element burns, K.
    pub fn lowest_ignition(&self) -> Option<f32> {
        self.ignition.iter().flatten().copied().min_by(f32::total_cmp)
    }

    /// Whether anything may decay, by how many lumps there are of each element, and by whether any is or was ever warmer than the
    /// room.
    pub fn is_called_for(&self, counts: &[u32], has_heat: bool) -> bool {
        let mut present = self.decays.iter().zip(counts).filter(|(_, count)| **count > 0);
        present.any(|(decay, _)| decay.as_ref().is_some_and(|decay| has_heat || decay.above <= ROOM))
    }
}

/// See [`DecayTable::ignition`].
fn ignition(rows: &[Element], row: usize, decays: &[Option<Decay>]) -> Option<f32> {
    let energy = |product: &Option<ElementId>| product.map_or(0.0, |product| rows[product.index()].energy);
    let burns = |row: usize| {
        let decay = decays[row].as_ref()?;
        decay.into.iter().any(|product| energy(product) < rows[row].energy).then_some(decay.above)
    };
    burns(row).or_else(|| {
        let (change, above) = rows[row].changes.iter().find_map(|change| Some((change, change.above?)))?;
        let products = rows.iter().enumerate().filter(|(_, product)| change.into.contains(&product.name));
        products.filter_map(|(product, _)| burns(product)).reduce(f32::min).map(|ignition| ignition.max(above))
    })
}

fn look_up(rows: &[Element], row: usize, detail: f32) -> Result<Option<Decay>, String> {
    let element = &rows[row];
    let Some(decay) = &element.decays else { return Ok(None) };
    let [shortest, longest] = TIMES;
    if !(shortest..=longest).contains(&decay.seconds) {
        return Err(format!("after {} s; allowed: {shortest} to {longest}", decay.seconds));
    }
    let above = decay.above.unwrap_or(COLDEST);
    if !(COLDEST..=HOTTEST).contains(&above) {
        return Err(format!("above {above} K; allowed: {COLDEST} to {HOTTEST}"));
    }
    if decay.into.is_empty() || decay.into.len() > MOST_TURNS {
        return Err(format!("into {} lumps in turn; allowed: 1 to {MOST_TURNS}", decay.into.len()));
    }
    let find = |name: &String| match rows.iter().position(|row| row.name == *name) {
        _ if name == AIR => Ok(None),
        Some(product) if product == row => Err(format!("into `{name}`; allowed: another element, or `{AIR}`")),
        Some(product) if rows[product].energy > element.energy => Err(format!(
            "into `{name}`, which has {} MJ/m² of energy; allowed: at most its own {}",
            rows[product].energy, element.energy
        )),
        Some(product) => Ok(Some(ElementId(product as u8))),
        None => Err(format!("into `{}`; allowed: another element, or `{AIR}`", name.escape_debug())),
    };
    let into = decay.into.iter().map(find).collect::<Result<_, _>>()?;
    let faster = if decay.needs_air { detail } else { 1.0 };
    Ok(Some(Decay { above, threshold: threshold(faster / decay.seconds), needs_air: decay.needs_air, into }))
}
