//! An element more in a world that is played.

use super::restore::Checkpoint;
use crate::{
    kernel::{
        element::{Element, ElementTable},
        sleep::SleepRecord,
    },
    scene::{
        blueprint::Blueprint,
        elements::{self, Fault},
    },
    sim::snapshot::Snapshot,
};
use std::sync::Arc;

impl Checkpoint {
    /// The same world with `element` in its table: behind all others, or in the place of the one of its name, whose lumps are
    /// what it says from here on. It stays the same scene: undo and reset know it still.
    ///
    /// # Errors
    /// If the table can't have it, or lumps that are there would have to come loose or be fixed: one line that says why, and what
    /// is allowed.
    pub fn with_element(mut self, element: Element) -> Result<Self, String> {
        let mut rows = self.setup.elements().rows().to_vec();
        match rows.iter().position(|row| row.name == element.name) {
            Some(row) if rows[row].fixed != element.fixed => {
                let what = if element.fixed { "moves" } else { "stays where it is" };
                return Err(format!("name: the `{}` of this world {what}; allowed: another name", element.name));
            }
            Some(row) => {
                rows[row] = element;
                // What slept may be too light or too thin to lie still now.
                self.state = Arc::new(Snapshot { sleep: SleepRecord::default(), ..Snapshot::clone(&self.state) });
            }
            None if rows.len() == ElementTable::MOST => {
                return Err(format!("this world has {} elements; allowed: at most that", rows.len()));
            }
            None => rows.push(element),
        }
        elements::check(&rows).map_err(|Fault { field, what, .. }| format!("{field}: {what}"))?;
        let table = Arc::new(ElementTable::new(rows));
        let with = |scene: &Blueprint| Arc::new(Blueprint { elements: table.clone(), ..scene.clone() });
        let setup = &mut self.setup;
        let is_at_its_detail = Arc::ptr_eq(&setup.blueprint, &setup.opened);
        setup.opened = with(&setup.opened);
        setup.blueprint = if is_at_its_detail { setup.opened.clone() } else { with(&setup.blueprint) };
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::element::Category,
        scene::{self, effects::EffectModes},
        sim::{
            generation::Generation,
            simulation::Simulation,
            state::{Counters, Elements},
            workers::Workers,
        },
    };

    fn start(scene: &str) -> Checkpoint {
        let blueprint = scene::load(scene).unwrap().build(&[], None, &EffectModes::new()).unwrap();
        Checkpoint::of_scene(Arc::new(blueprint))
    }

    fn syrup() -> Element {
        Element { density: 1100.0, viscosity: 0.5, ..Element::plain("syrup", false) }
    }

    #[test]
    fn an_element_more_changes_no_bit_of_what_is_there() {
        let plain = start("layers");
        let mixed = plain.clone().with_element(syrup()).unwrap();
        let hash = |start: &Checkpoint| Simulation::resume(start, Workers::single()).run(60).hash();
        assert_eq!(hash(&plain), hash(&mixed));
    }

    #[test]
    fn it_is_the_same_scene_at_any_detail_in_a_save_and_after_a_reset() {
        let mut simulation = Simulation::resume(&start("dam_break"), Workers::single());
        simulation.run(5);
        let (before, counted) = (Generation::of(simulation.world()), *simulation.get::<Counters>());
        let mixed = Checkpoint::of(simulation.world()).with_element(syrup()).unwrap();
        mixed.restore(simulation.world_mut());
        let now = Generation::of(simulation.world());
        assert!(now.scene == before.scene && now.state != before.state, "another state of the same scene");
        assert_eq!(*simulation.get::<Counters>(), counted, "what was counted goes on");
        let known = |state: &Checkpoint| state.setup.elements().find("syrup").is_some();
        assert_eq!(simulation.get::<Elements>().mass.len(), mixed.setup.elements().len());
        assert!(known(&Checkpoint::decode(&mixed.encode()).unwrap()), "a save has it");
        let finer = mixed.clone().at_detail(2.0).unwrap();
        assert!(known(&finer) && known(&finer.clone().at_detail(1.0).unwrap()), "each detail has it");
        let finer = finer.with_element(Element::plain("ink", false)).unwrap().at_detail(1.0).unwrap();
        assert!(known(&finer) && finer.setup.elements().find("ink").is_some(), "so it has one that is mixed there");
        crate::sim::control::reset(simulation.world_mut());
        assert!(known(&Checkpoint::of(simulation.world())), "a reset keeps it");
    }

    #[test]
    fn what_slept_wakes_when_it_is_changed() {
        let water = start("hydrostatic").setup.elements().find("water").unwrap();
        let mut simulation = Simulation::resume(&start("hydrostatic"), Workers::single());
        simulation.run(600);
        let asleep = Checkpoint::of(simulation.world());
        assert!(asleep.state.sleep != SleepRecord::default(), "a calm pool sleeps");
        let light = Element { density: 500.0, ..asleep.setup.elements().get(water).clone() };
        let changed = asleep.clone().with_element(light).unwrap();
        assert_eq!(changed.state.sleep, SleepRecord::default());
        assert_eq!(changed.setup.elements().get(water).density, 500.0);
        assert_eq!(asleep.with_element(syrup()).unwrap().state.sleep, changed_by_nothing(&simulation));
    }

    fn changed_by_nothing(simulation: &Simulation) -> SleepRecord {
        Checkpoint::of(simulation.world()).state.sleep.clone()
    }

    #[test]
    fn what_a_table_can_t_have_is_refused() {
        let start = start("layers");
        let refused = |element: Element, expected: &str| {
            let told = start.clone().with_element(element).expect_err("a fault");
            assert!(told.contains(expected), "{told}");
        };
        refused(Element { density: f32::NAN, ..syrup() }, "density: NaN is out of range; allowed: 0.05 to 100000");
        refused(Element { cohesion: 5.0, ..syrup() }, "cohesion: 5 without friction");
        refused(Element { diffusion: 0.1, category: Category::Liquids, ..syrup() }, "diffusion: 0.1 of what is no gas");
        refused(Element::plain("Syrup", false), "name: `Syrup`");
        refused(
            Element::plain("rock", false),
            "name: the `rock` of this world stays where it is; allowed: another name",
        );
        refused(Element::plain("water", true), "name: the `water` of this world moves; allowed: another name");
        let mut full = start.clone();
        for row in start.setup.elements().len()..ElementTable::MOST {
            full = full.with_element(Element::plain(&format!("own_{row}"), false)).unwrap();
        }
        let told = full.with_element(syrup()).expect_err("it is full");
        assert!(told.contains("255 elements"), "{told}");
    }
}
