//! See `tests/support/readers.rs`.
#![no_main]
powder_master_fuzz::target!("stamp");
