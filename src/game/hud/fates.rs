//! What becomes of an element, and by what: for its card.

use crate::{
    game::{
        language::{grouped, spoken},
        tools::spaced,
    },
    kernel::{
        element::{Element, ElementTable, ElementTouch},
        heat::units::CELSIUS,
    },
};
use tr::tr;

/// What happens to an element and what it becomes then, as a card says it.
pub fn fates(elements: &ElementTable, element: &Element) -> Vec<(String, String)> {
    let degrees = |kelvin: f32| format!("{} °C", grouped((kelvin - CELSIUS).round()));
    let mut fates = Vec::new();
    for change in &element.changes {
        let when = match (change.above, change.below) {
            (Some(above), _) => tr!("above {}", degrees(above)),
            (None, below) => tr!("below {}", degrees(below.unwrap_or_default())),
        };
        fates.push((when, listed(&change.into)));
    }
    if let Some(decay) = &element.decays {
        let when = match decay.above {
            Some(above) => tr!("burns from {}", degrees(above)),
            None => tr!("in some {} s", decay.seconds),
        };
        fates.push((when, listed(&decay.into)));
    }
    if let Some(breaks) = &element.breaks {
        fates.push((tr!("burst"), spoken(&spaced(&breaks.into))));
    }
    // A row that says what becomes of two stands with one of them.
    for (_, other) in elements.iter() {
        let ElementTouch { with, into: (first, second), .. } =
            match (touch_of(element, &other.name), touch_of(other, &element.name)) {
                (Some(own), _) => own,
                (None, Some(touch)) => ElementTouch {
                    with: other.name.clone(),
                    into: (touch.into.1.clone(), touch.into.0.clone()),
                    ..touch
                },
                (None, None) => continue,
            };
        let with = spoken(&spaced(&with));
        fates.push((tr!("with {}", with), listed(&[first, second])));
    }
    fates
}

fn touch_of(element: &Element, with: &str) -> Option<ElementTouch> {
    element.touches.iter().find(|touch| touch.with == with).cloned()
}

/// Names, each once.
fn listed(names: &[String]) -> String {
    let mut each: Vec<String> = Vec::new();
    for name in names.iter().map(|name| spoken(&spaced(name))) {
        if !each.contains(&name) {
            each.push(name);
        }
    }
    each.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::elements;

    #[test]
    fn a_card_tells_what_becomes_of_an_element_by_heat_fire_pressure_and_touch() {
        let table = elements().expect("the elements");
        let of = |name: &str| {
            let id = table.find(name).expect(name);
            fates(&table, table.get(id))
        };
        let told = |when: &str, what: &str| (when.to_owned(), what.to_owned());
        let water = of("water");
        assert_eq!(water[..2], [told("below 0 °C", "ice"), told("above 100 °C", "steam")]);
        // A row of salt's, and one of acid's that names what becomes of the other first.
        assert!(water.contains(&told("with salt", "brine")), "{water:?}");
        assert!(of("metal").contains(&told("with acid", "hydrogen, brine")));
        assert!(of("acid").contains(&told("with metal", "brine, hydrogen")));
        assert_eq!(of("ember").last(), Some(&told("burns from 227 °C", "fire, ash")));
        assert_eq!(of("smoke"), [told("in some 6 s", "air")]);
        assert!(of("glass").contains(&told("burst", "sand")));
        assert_eq!(of("mercury"), []);
    }
}
