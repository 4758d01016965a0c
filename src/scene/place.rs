//! Fills the box: shapes → the particles and the rock that stand on the lattice at the start.

use crate::{
    kernel::{
        element::{ElementId, ElementTable},
        heat::{
            table::HeatTable,
            units::{COLDEST, HOTTEST},
        },
        particles::Particles,
        solids::{Solids, centre, is_whole},
    },
    scene::{
        builtin::Origin,
        elements::NONE,
        error::{SceneError, choices},
        file::Placement,
        flow::VELOCITY,
        number::{Evaluator, Range},
        shape::Region,
    },
};
use glam::{DVec2, IVec2, UVec2, Vec2};

/// Tests of a site against a shape that a scene may cost, so that none hangs the program.
const MOST_WORK: u64 = 1_000_000_000;

/// Pixels of all pictures of a scene: each keeps a byte until the box is filled, however small its file is.
const MOST_PIXELS: usize = 4 * 4096 * 4096;

/// The lattice of a box, and which placement holds each of its sites.
struct Lattice {
    /// Sites along x and y: the cells that cover the box.
    cells: UVec2,
    /// Number of the placement that holds the site plus 1, 0 for a free one; row by row from the bottom.
    holder: Vec<u16>,
}

impl Lattice {
    fn index(&self, cell: IVec2) -> usize {
        cell.y as usize * self.cells.x as usize + cell.x as usize
    }

    /// The cells within the bounds, row by row from the bottom.
    fn within(&self, (min, max): (DVec2, DVec2)) -> impl Iterator<Item = IVec2> + use<> {
        let cells = self.cells.as_dvec2();
        let low = (min - 1.0).floor().clamp(DVec2::ZERO, cells).as_ivec2();
        let high = (max + 1.0).ceil().clamp(DVec2::ZERO, cells).as_ivec2();
        (low.y..high.y).flat_map(move |y| (low.x..high.x).map(move |x| IVec2::new(x, y)))
    }
}

/// What is in the box at the start.
pub(super) struct Filled {
    pub(super) particles: Particles,
    pub(super) solids: Solids,
    pub(super) next_id: u32,
}

/// A placement with its numbers put in.
struct Prepared {
    /// `None` clears.
    element: Option<ElementId>,
    fixed: bool,
    region: Region,
    replace: bool,
    velocity: Vec2,
    /// Temperature, K, if it is not that of new lumps.
    temperature: Option<f32>,
}

/// The box and what bounds its filling.
pub(super) struct Room<'a> {
    pub(super) elements: &'a ElementTable,
    pub(super) table: &'a HeatTable,
    pub(super) origin: &'a Origin,
    /// Spacing d, m.
    pub(super) spacing: f64,
    /// Size of the box, d.
    pub(super) size: Vec2,
    pub(super) particle_limit: u32,
}

/// Carries out the placements in their order. Ids count from 0, placement by placement, row by row from the bottom.
pub(super) fn fill(room: &Room<'_>, values: &Evaluator<'_>, contents: &[Placement]) -> Result<Filled, SceneError> {
    let cells = room.size.ceil().as_uvec2();
    let mut lattice = Lattice { cells, holder: vec![0; cells.x as usize * cells.y as usize] };
    let (mut work, mut pixels) = (0, 0);
    let mut prepared = Vec::with_capacity(contents.len());
    for (i, placement) in contents.iter().enumerate() {
        let placement = prepare(room, values, i, placement)?;
        pixels += placement.region.pixels();
        if pixels > MOST_PIXELS {
            let what = format!("the pictures up to it have {pixels} pixels; allowed: at most {MOST_PIXELS} in a scene");
            return Err(values.fault(format_args!("contents[{i}].image"), what));
        }
        claim(room, &mut lattice, i, &placement, &mut work).map_err(|()| {
            values.fault(format_args!("contents[{i}]"), "too many large shapes; allowed: fewer, or a lower detail")
        })?;
        prepared.push(placement);
    }
    let count = lattice.holder.iter().filter(|holder| **holder != 0).count();
    if count > room.particle_limit as usize {
        let what = format!(
            "{count} particles, but particle_limit is {}; allowed: fewer particles (a larger spacing or lower \
             detail, smaller shapes) or a higher limit",
            room.particle_limit
        );
        return Err(values.fault("contents", what));
    }
    Ok(settle(&lattice, &prepared, room.table))
}

fn prepare(room: &Room<'_>, values: &Evaluator<'_>, i: usize, placement: &Placement) -> Result<Prepared, SceneError> {
    let name = &placement.element;
    let element = if name == NONE {
        None
    } else {
        let found = room.elements.find(name);
        Some(found.ok_or_else(|| {
            let known = room.elements.iter().map(|(_, element)| element.name.as_str()).chain([NONE]);
            values
                .fault(format_args!("contents[{i}].element"), format!("no element `{name}`; {}", choices(name, known)))
        })?)
    };
    let fixed = element.is_none_or(|id| room.elements.get(id).fixed);
    let velocity = values.pair(format_args!("contents[{i}].velocity"), &placement.velocity, VELOCITY)?;
    if fixed && velocity != DVec2::ZERO {
        let what = format!("`{name}` doesn't move; allowed: (0, 0)");
        return Err(values.fault(format_args!("contents[{i}].velocity"), what));
    }
    let temperature = placement.temperature.as_ref().map(|at| {
        let [coldest, hottest] = element.map_or([COLDEST, HOTTEST], |id| room.table.curve(id).stays_between());
        let range = Range::real(f64::from(coldest), f64::from(hottest));
        values.number(format_args!("contents[{i}].temperature"), at, range)
    });
    Ok(Prepared {
        temperature: temperature.transpose()?.map(|at| at as f32),
        element,
        fixed,
        region: Region::new(values, room.origin, room.spacing, &format_args!("contents[{i}]"), &placement.shape)?,
        replace: placement.replace || element.is_none(),
        velocity: (velocity / room.spacing).as_vec2(),
    })
}

/// Notes placement `i` as the holder of its sites; `Err` if that is too much work.
fn claim(room: &Room<'_>, lattice: &mut Lattice, i: usize, placement: &Prepared, work: &mut u64) -> Result<(), ()> {
    let holder = if placement.element.is_some() { i as u16 + 1 } else { 0 };
    let cost = placement.region.cost() as u64;
    for cell in lattice.within(placement.region.bounds()) {
        *work += cost;
        if *work > MOST_WORK {
            return Err(());
        }
        let k = lattice.index(cell);
        let free = lattice.holder[k] == 0;
        let fits = placement.fixed || is_whole(cell, room.size);
        if fits && (free || placement.replace) && placement.region.contains(centre(cell).as_dvec2()) {
            lattice.holder[k] = holder;
        }
    }
    Ok(())
}

/// Gives every held site its particle.
fn settle(lattice: &Lattice, prepared: &[Prepared], table: &HeatTable) -> Filled {
    let mut filled =
        Filled { particles: Particles::default(), solids: Solids::new(lattice.cells.x, lattice.cells.y), next_id: 0 };
    for (i, placement) in prepared.iter().enumerate() {
        let Some(element) = placement.element else { continue };
        let heat = placement.temperature.map_or_else(|| table.spawn_heat(element), |at| table.curve(element).heat(at));
        for cell in lattice.within(placement.region.bounds()) {
            if usize::from(lattice.holder[lattice.index(cell)]) != i + 1 {
                continue;
            }
            if placement.fixed {
                filled.solids.insert(cell, element, filled.next_id);
                filled.solids.set_heat(cell, heat);
            } else {
                filled.particles.push_warm(filled.next_id, element, centre(cell), placement.velocity, heat);
            }
            filled.next_id += 1;
        }
    }
    filled
}
