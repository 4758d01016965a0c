//! What the picture can show: the table of views, and the map of the limiters that one of them needs.

pub mod strain;
pub mod table;
