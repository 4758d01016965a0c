//! What becomes of matter by its heat.

use super::*;

#[test]
fn boiling_takes_as_long_as_the_heat_takes_to_come() {
    let mut bench =
        Bench::new(Vec2::new(20.0, 20.0), 0.1).fill(0.0, |at| ((at - 10.0).length() < 3.0).then_some((WATER, 293.0)));
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::splat(10.0), 5.0);
    let mut ticks = 0;
    while bench.count(WATER) > 0 {
        let (mut warm, _, record, _) = bench.warm();
        warm_under(&mut warm, &stroke, 10.0, record);
        bench.change();
        ticks += 1;
    }
    // 80 K of slope and 452 MJ/m² at 4.19 MJ/m²K are 187.9 K.
    assert_eq!(ticks, 19);
    assert_eq!(bench.total(), 0);
    // Nothing is hotter than it can be, nor colder.
    let (mut warm, _, record, _) = bench.warm();
    warm_under(&mut warm, &stroke, 1e9, record);
    assert!((0..bench.particles.len()).all(|i| bench.kelvin(i) <= HOTTEST + 1.0));
    let (mut warm, _, record, _) = bench.warm();
    warm_under(&mut warm, &stroke, -1e9, record);
    assert!((0..bench.particles.len()).all(|i| bench.kelvin(i) >= COLDEST - 1.0));
    assert_eq!(bench.total(), 0);
}

#[test]
fn a_temperature_that_is_set_holds_whatever_matter_becomes_on_the_way() {
    let mut bench = Bench::new(Vec2::new(20.0, 20.0), 0.1).fill(0.0, |at| {
        let of_row = |row: u32| [WATER, ICE, STEAM, ASH, METAL, LAVA, SNOW, BRINE][row as usize % 8];
        let element = of_row(at.y as u32);
        (at.x < 12.0).then_some((element, [293.0, 200.0, 500.0, 293.0, 293.0, 1600.0, 250.0, 293.0][at.y as usize % 8]))
    });
    for x in 12..20 {
        for y in 0..20 {
            bench.solids.insert(IVec2::new(x, y), ROCK, 1000 + 20 * x as u32 + y as u32);
        }
    }
    let (before, stroke) = (bench.total(), Stroke::rectangle(Vec2::ZERO, Vec2::splat(20.0)));
    for kelvin in [3000.0, 320.0, 600.0, 250.0, 20.0, 400.0] {
        for _ in 0..4 {
            let (mut warm, _, record, _) = bench.warm();
            set_under(&mut warm, &stroke, kelvin, record);
            bench.change();
        }
        for i in 0..bench.particles.len() {
            let (is, element) = (bench.kelvin(i), bench.particles.element[i]);
            assert!((is - kelvin).abs() < 0.01, "{element:?} has {is} K of {kelvin}");
        }
        for (cell, element, _) in bench.solids.iter() {
            let is = bench.table.curve(element).temperature(bench.solids.heat(cell));
            assert!((is - kelvin).abs() < 0.01, "rock {element:?} has {is} K of {kelvin}");
        }
        assert_eq!(bench.total(), before, "at {kelvin} K");
    }
    // Under the stroke alone.
    let dab = Stroke::dab(BrushShape::Disc, Vec2::splat(6.0), 2.0);
    let held: Vec<i32> = bench.particles.heat.to_vec();
    let (mut warm, _, record, _) = bench.warm();
    set_under(&mut warm, &dab, 350.0, record);
    for i in 0..bench.particles.len() {
        let is_changed = bench.particles.heat_of(i) != held[i];
        assert_eq!(is_changed, dab.covers(bench.particles.position(i)), "{:?}", bench.particles.position(i));
    }
}

#[test]
fn what_is_set_to_the_temperature_of_the_room_at_rest_has_no_heat() {
    let mut bench = Bench::new(Vec2::new(10.0, 10.0), 0.1).fill(0.0, |_| Some((WATER, ROOM)));
    bench.solids.insert(IVec2::new(3, 3), ROCK, 1000);
    let (mut warm, _, record, _) = bench.warm();
    set_under(&mut warm, &Stroke::rectangle(Vec2::ZERO, Vec2::splat(10.0)), ROOM, record);
    assert!(!bench.particles.has_heat() && bench.solids.heats().is_empty());
}

#[test]
fn what_splits_is_dealt_in_turn() {
    let mut bench = Bench::new(Vec2::new(30.0, 30.0), 0.1).fill(0.0, |_| Some((SNOW, 280.0)));
    let (count, total) = (bench.particles.len(), bench.total());
    for heat in 0..count {
        let molten = bench.table.curve(SNOW).heat(280.0) + (68e6 / QUANTUM) as i32;
        bench.particles.set_heat(heat, molten);
        bench.record.by_hand += i64::from(molten - bench.table.curve(SNOW).heat(280.0));
    }
    bench.change();
    assert_eq!((bench.particles.len(), bench.count(WATER)), (count / 3, count / 3));
    assert_eq!(bench.total(), total, "what goes into the air takes its heat along");
}

#[test]
fn what_splits_into_two_is_equally_warm_and_makes_no_heat() {
    let mut bench = Bench::new(Vec2::new(30.0, 31.0), 0.1).fill(0.0, |_| Some((BRINE, ROOM)));
    let Some(boils) = bench.table.curve(BRINE).above.clone() else { panic!("it stays what it is") };
    let boiled = boils.plateau[1] + 1;
    for i in 0..bench.particles.len() {
        bench.particles.set_heat(i, boiled);
        bench.record.by_hand += i64::from(boiled);
    }
    bench.change();
    assert_eq!((bench.count(STEAM), bench.count(ASH)), (465, 465));
    assert_eq!(bench.total(), 0);
    let all = 0..bench.particles.len();
    let (coldest, hottest) = all.map(|i| bench.kelvin(i)).fold((f32::MAX, 0.0_f32), |(a, b), k| (a.min(k), b.max(k)));
    assert!(hottest - coldest < 0.01 && (coldest - 375.0).abs() < 0.01, "{coldest} to {hottest} K");
}

#[test]
fn rock_melts_and_lava_sets_only_where_it_is_alone() {
    let mut bench = Bench::new(Vec2::new(10.0, 10.0), 0.1);
    bench.solids.insert(IVec2::new(4, 4), ROCK, 77);
    bench.solids.set_heat(IVec2::new(4, 4), bench.table.curve(ROCK).heat(1430.0) + (950e6 / QUANTUM) as i32);
    let total = bench.total();
    bench.tick();
    assert_eq!((bench.solids.count(), bench.particles.len()), (0, 1));
    assert_eq!((bench.particles.id[0], bench.particles.element[0]), (77, LAVA));
    assert_eq!(bench.total(), total);
    // Cold lava, one alone and two in one cell.
    let [cold, _] = bench.table.curve(LAVA).range();
    bench.particles.set_heat(0, cold);
    for id in [1, 2] {
        bench.particles.push_warm(id, LAVA, Vec2::new(7.3, 7.2 + 0.2 * id as f32), Vec2::ZERO, cold);
    }
    bench.change();
    assert_eq!((bench.solids.get(IVec2::new(4, 4)), bench.particles.len()), (Some((GLASS, 77)), 2));
    assert_eq!(bench.solids.heat(IVec2::new(4, 4)), cold);
}

#[test]
fn a_gas_gives_its_heat_to_the_air_five_times_as_fast() {
    let mut elements = Bench::new(Vec2::splat(20.0), 0.1).elements.rows().to_vec();
    elements.push(Element {
        category: Category::Gases,
        ..Element { name: "smoke".into(), ..elements[ASH.index()].clone() }
    });
    let smoke = elements.len() as u8 - 1;
    let elements = ElementTable::new(elements);
    let mut bench = Bench { table: HeatTable::new(&elements), elements, ..Bench::new(Vec2::splat(20.0), 0.1) };
    for (id, x) in [(ASH.0, 5.0), (smoke, 15.0)] {
        let heat = bench.table.curve(ElementId(id)).heat(400.0);
        bench.particles.push_warm(id.into(), ElementId(id), Vec2::new(x, 10.0), Vec2::ZERO, heat);
    }
    let start = bench.particles.clone();
    bench.flow(1);
    // Solved for the end of the step, what is warmer than the room by 1 is so by 1/(1 + x) after it.
    let given = [0, 1].map(|i| {
        let left = f64::from(bench.particles.heat_of(i)) / f64::from(start.heat_of(i));
        1.0 / left - 1.0
    });
    assert!((given[1] / given[0] - 5.0).abs() < 1e-3, "{given:?}");
}
