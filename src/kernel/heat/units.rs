//! What heat is counted in, and the ends of temperature.

/// What heat is counted in, J/m²: two millionths of a degree of a water lump.
pub const QUANTUM: f32 = 8.0;
/// Temperature of the room, K, at which what rests holds no heat.
pub const ROOM: f32 = 293.0;
/// 0 °C, K, to the degree: water freezes at 273 K here.
pub const CELSIUS: f32 = 273.0;
/// Lowest temperature that a tool or a table can ask for, K.
pub const COLDEST: f32 = 1.0;
/// Highest temperature that a tool or a table can ask for, K.
pub const HOTTEST: f32 = 4000.0;
