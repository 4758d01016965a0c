//! Fuzz targets: one for each reader of bytes from outside (docs/fuzzing.md).

#[path = "../../tests/support/readers.rs"]
pub mod readers;

pub use libfuzzer_sys;

/// The reader called `name`.
pub fn reader(name: &str) -> fn(&[u8]) {
    let found = readers::READERS.into_iter().find(|(of, _)| *of == name);
    found.map_or_else(|| panic!("no reader `{name}`"), |(_, read)| read)
}

/// A target that feeds the reader of a name.
#[macro_export]
macro_rules! target {
    ($name:literal) => {
        use $crate::libfuzzer_sys;
        libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
            static READ: std::sync::OnceLock<fn(&[u8])> = std::sync::OnceLock::new();
            READ.get_or_init(|| $crate::reader($name))(bytes);
        });
    };
}
