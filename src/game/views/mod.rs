//! What the picture can show: the table of views, and what two of them need: the map of the limiters, and what burns.

pub mod fire;
pub mod strain;
pub mod table;
