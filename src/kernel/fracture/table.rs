//! What which elements bear, and what becomes of them beyond that, from their rows.

use crate::element::{Element, ElementId, ElementTable};

/// Lowest and highest strength, Pa/m.
const STRENGTHS: [f32; 2] = [100.0, 1e7];

/// What an element bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fracture {
    /// Overpressure that a wall of it just bears for each metre that it is thick, Pa/m.
    pub above: f32,
    /// What becomes of it.
    pub into: ElementId,
}

/// What is wrong with what a row breaks into.
#[derive(Clone, Debug, PartialEq)]
pub struct FractureFault {
    /// Index of the row.
    pub row: usize,
    /// What it is, and what is allowed.
    pub what: String,
}

/// What all elements bear.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FractureTable {
    fractures: Vec<Option<Fracture>>,
}

impl FractureTable {
    /// That of a table of already validated rows.
    pub fn new(elements: &ElementTable) -> Self {
        Self::of_rows(elements.rows()).unwrap_or_else(|_| Self { fractures: vec![None; elements.len()] })
    }

    /// That of rows.
    ///
    /// # Errors
    /// If what moves breaks, or anything into what does not move or holds other energy or gas than it: pressure does no
    /// chemistry.
    pub fn of_rows(rows: &[Element]) -> Result<Self, FractureFault> {
        let fractures = (0..rows.len()).map(|row| look_up(rows, row).map_err(|what| FractureFault { row, what }));
        Ok(Self { fractures: fractures.collect::<Result<_, _>>()? })
    }

    /// That of an element, if anything breaks it.
    pub fn of(&self, element: ElementId) -> Option<&Fracture> {
        self.fractures[element.index()].as_ref()
    }

    /// What the weakest of the elements bears that are there, Pa/m, by how many lumps there are of each.
    pub fn weakest(&self, counts: &[u32]) -> Option<f32> {
        let present = self.fractures.iter().zip(counts).filter(|(_, count)| **count > 0);
        present.filter_map(|(fracture, _)| Some(fracture.as_ref()?.above)).reduce(f32::min)
    }
}

fn look_up(rows: &[Element], row: usize) -> Result<Option<Fracture>, String> {
    let element = &rows[row];
    let Some(breaks) = &element.breaks else { return Ok(None) };
    if !element.fixed {
        return Err(format!("of `{}`, which moves; allowed: only of what is fixed", element.name));
    }
    let [weakest, strongest] = STRENGTHS;
    if !(weakest..=strongest).contains(&breaks.above) {
        return Err(format!("above {} Pa/m; allowed: {weakest} to {strongest}", breaks.above));
    }
    let found = rows.iter().position(|other| other.name == breaks.into && !other.fixed);
    let Some(product) = found else {
        return Err(format!("into `{}`; allowed: an element that moves", breaks.into.escape_debug()));
    };
    let of = |element: &Element| (element.energy, element.gas);
    if of(&rows[product]) != of(element) {
        return Err(format!("into `{}`; allowed: what has as much `energy` and `gas`", breaks.into));
    }
    Ok(Some(Fracture { above: breaks.above, into: ElementId(product as u8) }))
}
