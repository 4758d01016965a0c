//! All measures of the running world: measured only while they are shown.

use crate::{
    game::hud::style::weak,
    lab::live::measures::{Measured, Measures},
    sim::numbers::figure,
};
use bevy_egui::egui::{self, Ui};
use tr::tr;

/// A line: what, how much, and what that is.
type Line = (String, String, String);

/// Shows them where `open`, and a heading that opens and closes them. Until they were `seen`, what is below the edge of the
/// panel is brought up.
pub fn show(ui: &mut Ui, open: &mut bool, seen: &mut bool, measures: &Measures) {
    let header = egui::CollapsingHeader::new(tr!("All measures")).id_salt("All measures").open(Some(*open));
    let header = header.show(ui, |ui| match measures.latest() {
        Some(measured) => table(ui, measured),
        None => drop(ui.label(weak(tr!("measuring")))),
    });
    if let (Some(body), false, true) = (&header.body_response, *seen, measures.latest().is_some()) {
        body.scroll_to_me(Some(egui::Align::BOTTOM));
        *seen = true;
    }
    *seen &= *open;
    if header.header_response.on_hover_text(tr!("measured once a second while they are shown")).clicked() {
        *open = !*open;
    }
}

fn table(ui: &mut Ui, measured: &Measured) {
    ui.spacing_mut().interact_size.y = 17.0;
    egui::Grid::new("measures").num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
        for (name, value, meaning) in lines(measured) {
            let name = ui.label(weak(name));
            name.union(ui.label(value)).on_hover_text(meaning);
            ui.end_row();
        }
    });
    let cost = figure(measured.cost.as_secs_f64() * 1000.0);
    ui.label(weak(tr!("measuring them takes {cost} ms, once a second", cost)).small());
}

fn lines(measured: &Measured) -> Vec<Line> {
    let percent = |share: f64| format!("{} %", figure(100.0 * share));
    let or_none = |text: Option<String>| text.unwrap_or_else(|| tr!("error" => "none"));
    let signed = |share: f64| if share > 0.0 { format!("+{}", percent(share)) } else { percent(share) };
    let joules = |energy: f64| format!("{} J", figure(energy));
    let [x, y] = measured.momentum.to_array().map(figure);
    let mut lines = vec![
        (
            tr!("solver's residual"),
            or_none(measured.residual.map(percent)),
            tr!("how far above its rest density the solver left the particles that are too dense, on average, by its \
                 own kernel in its last iteration"),
        ),
        (
            tr!("volume error"),
            or_none(measured.volume_error.map(signed)),
            tr!("room that the liquid takes, against the room that its particles stand for"),
        ),
        (tr!("kinetic energy"), joules(measured.kinetic), tr!("of the particles, for each metre of depth")),
        (
            tr!("potential energy"),
            joules(measured.potential),
            tr!("of the particles over the lower left corner, for each metre of depth"),
        ),
        (tr!("momentum"), format!("{x}, {y} kg m/s"), tr!("of the particles along x and y, for each metre of depth")),
    ];
    match measured.air {
        Some(air) => lines.extend([
            (tr!("air mass"), format!("{} kg", figure(air.mass)), tr!("in the box, for each metre of depth")),
            (
                tr!("air mass drift"),
                signed(air.drift),
                tr!("since these lines were opened or the world was put in place; open sides and tools change it, too"),
            ),
            (
                tr!("air divergence"),
                format!("{} 1/s", figure(air.divergence)),
                tr!("root mean square over the open cells: sound and what the scheme leaves"),
            ),
        ]),
        None => lines.push((tr!("air"), tr!("off"), tr!("switched off in this scene"))),
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::live::measures::AirMeasured;
    use glam::DVec2;
    use std::time::Duration;

    #[test]
    fn every_measure_has_a_unit_and_what_is_not_there_is_said() {
        let measured = Measured {
            seen: (60, 0),
            residual: Some(0.0123),
            volume_error: Some(-0.004),
            kinetic: 12.345,
            potential: 6789.0,
            momentum: DVec2::new(1.5, -0.25),
            air: Some(AirMeasured { mass: 96.0, drift: 2e-7, divergence: 0.75 }),
            cost: Duration::from_micros(420),
        };
        let texts = |measured| -> Vec<String> { lines(&measured).into_iter().map(|(_, value, _)| value).collect() };
        let shown = ["1.23 %", "-0.4 %", "12.35 J", "6789 J", "1.5, -0.25 kg m/s", "96 kg", "+2.0e-5 %", "0.75 1/s"];
        assert_eq!(texts(measured), shown);
        let empty = texts(Measured { residual: None, volume_error: None, air: None, ..measured });
        assert_eq!([&empty[0], &empty[1], &empty[5]], ["none", "none", "off"]);
    }
}
