//! The table of what readings say. The plot, the numbers of the panel and the columns of a table follow from it.

use crate::lab::gauges::{
    set::{LineReading, Reading},
    spot::{AirReading, SpotReading},
};

/// A row of the table.
pub struct Quantity {
    /// What it is called.
    pub name: &'static str,
    /// Its unit on the screen.
    pub unit: &'static str,
    /// Its column in a table, with the unit.
    pub column: &'static str,
    /// What it means.
    pub about: &'static str,
    /// Whether it can be plotted: there is a line for it in the panel.
    pub plotted: bool,
    /// Its value in a reading, if that has it.
    pub of: Of,
}

/// How a value is found.
pub enum Of {
    /// In the reading of a gauge at a place.
    Spot(fn(&SpotReading) -> Option<f64>),
    /// In that of a line.
    Line(fn(&LineReading) -> Option<f64>),
}

impl Quantity {
    /// Its value in a reading.
    pub fn value(&self, reading: &Reading) -> Option<f64> {
        let value = match (&self.of, reading) {
            (Of::Spot(of), Reading::Spot(reading)) => of(reading),
            (Of::Line(of), Reading::Line(reading)) => of(reading),
            _ => None,
        };
        value.filter(|value| value.is_finite())
    }

    /// Whether readings of such a gauge have it.
    pub fn is_of(&self, reading: &Reading) -> bool {
        matches!((&self.of, reading), (Of::Spot(_), Reading::Spot(_)) | (Of::Line(_), Reading::Line(_)))
    }
}

impl PartialEq for Quantity {
    fn eq(&self, other: &Self) -> bool {
        self.column == other.column
    }
}

/// All of them, in the order of menu and columns.
pub static QUANTITIES: [Quantity; 15] = [
    spot("speed", "m/s", "speed_m_per_s", "mean speed of the matter around it", true, |spot| some(spot.speed)),
    spot("velocity x", "m/s", "velocity_x_m_per_s", "its mean velocity to the right", false, |spot| {
        some(spot.velocity.map(|velocity| velocity.x))
    }),
    spot("velocity y", "m/s", "velocity_y_m_per_s", "its mean velocity upwards", false, |spot| {
        some(spot.velocity.map(|velocity| velocity.y))
    }),
    spot("pressure", "Pa", "pressure_pa", "pressure of the liquid, over that of the surroundings", true, |spot| {
        some(spot.pressure)
    }),
    spot("density", "kg/m²", "density_kg_per_m2", "mass of matter in the room that is open to it", true, |spot| {
        some(spot.density)
    }),
    spot("temperature", "°C", "temperature_c", "mean temperature of the matter around it", true, |spot| {
        some(spot.temperature)
    }),
    spot("particles", "", "particles", "particles within its radius", false, |spot| Some(f64::from(spot.count))),
    spot("air pressure", "Pa", "air_pressure_pa", "pressure of the air, over that of the surroundings", true, |spot| {
        of_air(spot, |air| air.pressure)
    }),
    spot("air speed", "m/s", "air_speed_m_per_s", "speed of the air", true, |spot| {
        of_air(spot, |air| air.velocity.length())
    }),
    spot("air velocity x", "m/s", "air_velocity_x_m_per_s", "velocity of the air to the right", false, |spot| {
        of_air(spot, |air| air.velocity.x)
    }),
    spot("air velocity y", "m/s", "air_velocity_y_m_per_s", "velocity of the air upwards", false, |spot| {
        of_air(spot, |air| air.velocity.y)
    }),
    spot("air temperature", "°C", "air_temperature_c", "temperature of the air", true, |spot| {
        of_air(spot, |air| air.temperature)
    }),
    line(
        "flow",
        "m²/s",
        "flow_m2_per_s",
        "what flows through a line, to its right, for each metre of depth",
        true,
        |line| Some(line.flow),
    ),
    line("mean flow", "m²/s", "mean_flow_m2_per_s", "the mean of that since it is counted", true, |line| line.mean),
    line(
        "crossed",
        "",
        "crossed",
        "particles that crossed to the right, less those that crossed back",
        false,
        |line| Some(line.crossed as f64),
    ),
];

const fn spot(
    name: &'static str,
    unit: &'static str,
    column: &'static str,
    about: &'static str,
    plotted: bool,
    of: fn(&SpotReading) -> Option<f64>,
) -> Quantity {
    Quantity { name, unit, column, about, plotted, of: Of::Spot(of) }
}

const fn line(
    name: &'static str,
    unit: &'static str,
    column: &'static str,
    about: &'static str,
    plotted: bool,
    of: fn(&LineReading) -> Option<f64>,
) -> Quantity {
    Quantity { name, unit, column, about, plotted, of: Of::Line(of) }
}

fn some(value: Option<f32>) -> Option<f64> {
    value.map(f64::from)
}

fn of_air(spot: &SpotReading, of: fn(&AirReading) -> f32) -> Option<f64> {
    some(spot.air.as_ref().map(of))
}

/// The one that has a column.
pub fn of_column(column: &str) -> Option<&'static Quantity> {
    QUANTITIES.iter().find(|quantity| quantity.column == column)
}
