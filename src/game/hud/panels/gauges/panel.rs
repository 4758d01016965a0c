//! The panel of the gauges: what to plot, the plot, what each gauge reads now, and the table for other programs.

use crate::{
    game::{
        actions::{Action, PanelId},
        gauges::desk::{GaugeDesk, Shown},
        hud::{
            gauges::{badge, colour},
            panels::gauges::plot::{self, now},
            style::{self, weak},
            widgets::{icon_button, name},
            window::{PanelWindow, scroll},
        },
        icons,
        input::bindings::{Bindings, CTRL, Group},
        language::{grouped, spoken},
        orders::{Order, Orders},
        panels::{Panel, Panels},
        tools::spaced,
    },
    kernel::{element::ElementId, units::TICKS_PER_SECOND},
    lab::gauges::{
        place::Place,
        quantity::{Of, QUANTITIES, Quantity},
        set::{Gauge, Gauges, MOST, Reading, flow},
    },
    sim::{
        numbers::figure,
        state::{Clock, Setup},
    },
};
use bevy::prelude::{App, KeyCode, Res, ResMut, Result};
use bevy_egui::egui::{Align2, Color32, RichText, Sense, Ui, vec2};
use glam::Vec2;
use tr::tr;

/// Width of the panel's contents, points.
const WIDTH: f32 = 372.0;
/// Height of the plot, points.
const PLOT: f32 = 158.0;
/// Elements of a line's flow that are named.
const NAMED: usize = 3;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("gauges"),
    title: "Gauges",
    icon: icons::trace,
    keys: &[(KeyCode::KeyG, CTRL)],
    group: Group::Look,
    help: "gauges: what they read, as a plot and as CSV",
    in_bar: true,
    in_list: Some("Gauges: measure and plot"),
    stays: true,
};

/// Adds the panel.
pub fn plugin(app: &mut App) {
    Panels::add(app, PANEL, show);
}

/// Shows the panel.
fn show(
    mut window: PanelWindow,
    (gauges, mut desk): (Res<Gauges>, ResMut<GaugeDesk>),
    (setup, clock, bindings): (Res<Setup>, Res<Clock>, Res<Bindings>),
    mut orders: ResMut<Orders>,
) -> Result {
    let mut pressed = Vec::new();
    window.show(&PANEL, (Align2::LEFT_TOP, vec2(14.0, 84.0)), |ui| {
        let screen = ui.ctx().content_rect();
        scroll(ui, 250.0, |ui| {
            ui.set_width(WIDTH.min(screen.width() - 60.0));
            ui.spacing_mut().item_spacing = vec2(6.0, 6.0);
            if gauges.is_empty() {
                ui.label(weak(how(&bindings)));
            } else {
                desk.shown = chips(ui, &gauges, desk.shown);
                let size = vec2(ui.available_width(), PLOT);
                plot::show(ui, size, &gauges, desk.shown.0, clock.tick, desk.selected);
                for gauge in gauges.iter() {
                    row(ui, gauge, (&setup, clock.tick), &mut desk, &mut pressed);
                }
            }
            ui.add_space(2.0);
            buttons(ui, &gauges, (&bindings, &mut pressed));
        });
    })?;
    orders.extend(pressed);
    Ok(())
}

/// How gauges are set.
fn how(bindings: &Bindings) -> String {
    let [spot, line] = [Action::Gauge, Action::GaugeLine].map(|action| bindings.key(action));
    tr!(
        "{spot} sets a gauge under the pointer: speed, pressure, density, temperature. {line}, and {line} again elsewhere, \
         measures the flow through a line. A click on a mark finds it here, the right button takes it away. A drag of the mark, or \
         of an end of a line, moves it.",
        spot,
        line
    )
}

/// What there is to plot of these gauges; which of it is chosen now.
fn chips(ui: &mut Ui, gauges: &Gauges, shown: Shown) -> Shown {
    let has = |quantity: &Quantity| gauges.iter().any(|gauge| is_of(quantity, gauge));
    let offered = || QUANTITIES.iter().filter(|quantity| quantity.plotted && has(quantity));
    // What no gauge measures any more is not shown.
    let mut chosen = if has(shown.0) { shown } else { offered().next().map_or(shown, Shown) };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        ui.spacing_mut().button_padding = vec2(7.0, 2.0);
        for quantity in offered() {
            let called = spoken(quantity.name);
            let response = ui.selectable_label(quantity == chosen.0, called.as_str());
            name(&response, &tr!("plot {}", called), quantity == chosen.0);
            if response.on_hover_text(spoken(quantity.about)).clicked() {
                chosen = Shown(quantity);
            }
        }
        ui.label(weak(chosen.0.unit).small());
    });
    chosen
}

fn is_of(quantity: &Quantity, gauge: &Gauge) -> bool {
    matches!(quantity.of, Of::Line(_)) == matches!(gauge.place, Place::Line { .. })
}

/// A gauge: its number, what it reads now, and a cross that takes it away.
fn row(ui: &mut Ui, gauge: &Gauge, (setup, tick): (&Setup, u64), desk: &mut GaugeDesk, pressed: &mut Vec<Order>) {
    let stands_out = desk.selected == Some(gauge.number);
    let [first, second] = told(gauge, setup, tick);
    ui.horizontal(|ui| {
        let (place, response) = ui.allocate_exact_size(vec2(26.0, 34.0), Sense::click());
        name(&response, &tr!("gauge {}", gauge.number), stands_out);
        badge(ui.painter(), place.center(), gauge.number, stands_out);
        if response.on_hover_text(where_is(gauge)).clicked() {
            desk.selected = if stands_out { None } else { Some(gauge.number) };
        }
        ui.vertical(|ui| {
            ui.set_width(ui.available_width() - 34.0);
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.label(RichText::new(first).color(if stands_out { Color32::WHITE } else { style::TEXT }));
            ui.label(weak(second).small());
        });
        let (place, response) = ui.allocate_exact_size(vec2(22.0, 22.0), Sense::click());
        name(&response, &tr!("take gauge {} away", gauge.number), false);
        let hue = if response.hovered() { colour(gauge.number) } else { style::WEAK };
        icons::draw(ui.painter(), icons::square(place.center(), 11.0), icons::close, hue);
        if response.on_hover_text(tr!("take it away")).clicked() {
            pressed.push(Order::RemoveGauge(gauge.number));
        }
    });
}

/// Where a gauge is.
fn where_is(gauge: &Gauge) -> String {
    let at = |place: Vec2| format!("{:.2}, {:.2}", place.x, place.y);
    match gauge.place {
        Place::Spot { at: centre, radius } => {
            tr!("at {at} m, {radius} m around", at = at(centre), radius = format_args!("{radius:.2}"))
        }
        Place::Line { from, to } => {
            tr!("from {from} to {to} m; the arrow's way is positive", from = at(from), to = at(to))
        }
    }
}

/// What a gauge reads, in two lines.
fn told(gauge: &Gauge, setup: &Setup, tick: u64) -> [String; 2] {
    let value = |column: &str| {
        let quantity = QUANTITIES.iter().find(|quantity| quantity.column == column)?;
        let value = now(gauge, quantity, tick)?;
        Some(format!("{} {}", rounded(value), quantity.unit).trim_end().to_owned())
    };
    match gauge.latest() {
        Some(Reading::Spot(reading)) if reading.density.is_none() => [tr!("in rock"), String::new()],
        Some(Reading::Spot(reading)) => {
            let matter = match reading.count {
                0 => vec![Some(tr!("no matter here"))],
                _ => ["speed_m_per_s", "pressure_pa", "density_kg_per_m2", "temperature_c"].map(&value).into(),
            };
            let air = ["air_speed_m_per_s", "air_pressure_pa", "air_temperature_c"].map(&value);
            let count = tr!("{} particles", grouped(reading.count));
            let air = air.into_iter().flatten().collect::<Vec<_>>().join(", ");
            let air = if air.is_empty() { tr!("no air in this scene") } else { tr!("air: {}", air) };
            [matter.into_iter().flatten().collect::<Vec<_>>().join(" · "), format!("{air} · {count}")]
        }
        Some(Reading::Line(reading)) => {
            let seconds = tick.saturating_sub(gauge.since()) as f64 / f64::from(TICKS_PER_SECOND);
            let flow = tr!("flow {}", value("flow_m2_per_s").unwrap_or_default());
            let mean =
                reading.mean.map(|mean| tr!("mean {} m²/s in {} s", rounded(mean), format_args!("{seconds:.0}")));
            let first = [Some(flow), mean].into_iter().flatten().collect::<Vec<_>>().join(" · ");
            [first, shares(gauge, setup, seconds)]
        }
        None => [tr!("no reading yet"), String::new()],
    }
}

/// A number that does not flicker: to three figures.
fn rounded(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 => grouped(format!("{value:.0}")),
        size if size >= 10.0 => format!("{value:.1}"),
        size if size >= 0.005 => format!("{value:.2}"),
        size if size < 5e-5 => "0".to_owned(),
        _ => figure(value),
    }
}

/// The mean flow of the elements that a line was crossed by most.
fn shares(gauge: &Gauge, setup: &Setup, seconds: f64) -> String {
    let ticks = seconds * f64::from(TICKS_PER_SECOND);
    let mut crossed: Vec<(ElementId, i64)> =
        setup.elements().iter().map(|(id, _)| (id, gauge.crossed(id)[0])).filter(|(_, net)| *net != 0).collect();
    crossed.sort_by_key(|(_, net)| -net.abs());
    let named = crossed.iter().take(NAMED).map(|(id, net)| {
        let mean = flow(setup, *net) / ticks.max(1.0);
        format!("{} {}", spoken(&spaced(&setup.elements().get(*id).name)), rounded(mean))
    });
    let named: Vec<String> = named.collect();
    if named.is_empty() { tr!("nothing crossed it yet") } else { tr!("mean of {}", named.join(", ")) }
}

/// What is done with all of them.
fn buttons(ui: &mut Ui, gauges: &Gauges, (bindings, pressed): (&Bindings, &mut Vec<Order>)) {
    ui.horizontal(|ui| {
        if gauges.iter().count() < MOST {
            let set = icon_button(ui, (icons::plus, &bindings.help(Action::Gauge)), &tr!("Set one"), false);
            if set.on_hover_text(tr!("in the middle of what is seen; by key, under the pointer")).clicked() {
                pressed.push(Order::Act(Action::Gauge));
            }
        }
        if !gauges.is_empty() {
            let save = icon_button(ui, (icons::save, &tr!("save the readings as CSV")), &tr!("Save CSV"), false);
            if save.on_hover_text(tr!("the readings of the last five minutes, for other programs")).clicked() {
                pressed.push(Order::SaveReadings);
            }
            let clear = icon_button(ui, (icons::close, &tr!("take all gauges away")), &tr!("All away"), false);
            if clear.clicked() {
                pressed.extend(gauges.iter().map(|gauge| Order::RemoveGauge(gauge.number)));
            }
        }
    });
}
