//! RON scene and element files → validated values → the world that they describe.

pub mod blueprint;
