//! Powder Master: a real-time 2-D sandbox of powders and fluids in moving air.

#![forbid(unsafe_op_in_unsafe_fn)]

pub mod cli;
pub mod kernel;
pub mod lab;
pub mod scene;
pub mod sim;
