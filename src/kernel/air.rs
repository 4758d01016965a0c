//! The air grid.
