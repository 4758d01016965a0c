//! Runs a library's tests in a module, for `tests/web/suite.mjs`; the kernel includes this file, too. Rust's own runner
//! catches panics and writes to standard output: a module can do neither.

extern crate test;

use std::panic;
use test::{ShouldPanic, TestDescAndFn, TestFn};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(js_namespace = powderSuite)]
extern "C" {
    /// Tells how many tests there are, and gets the number of one that nobody has begun; past the last if there is none.
    fn next(tests: usize) -> usize;

    /// Tells which test is next, why to leave it out if it is to be, and with which words it must panic if it must; gets
    /// whether to run it.
    fn begin(name: &str, ignored: Option<String>, panics: Option<String>) -> bool;

    /// Tells what a panic says. Nothing runs after it.
    fn panicked(message: &str);

    /// Tells that the test came to its end, and what was wrong if something was.
    fn end(fault: Option<String>);
}

/// Runs tests as long as there are any that no other instance has begun.
pub(crate) fn run(tests: &[&TestDescAndFn]) {
    panic::set_hook(Box::new(|panic| panicked(&panic.to_string())));
    while let Some(TestDescAndFn { desc, testfn }) = tests.get(next(tests.len())) {
        let ignored = desc.ignore.then(|| desc.ignore_message.unwrap_or("no reason given").to_owned());
        let panics = match desc.should_panic {
            ShouldPanic::No => None,
            ShouldPanic::Yes => Some(String::new()),
            ShouldPanic::YesWithMessage(message) => Some(message.to_owned()),
        };
        if begin(desc.name.as_slice(), ignored, panics) {
            end(match testfn {
                TestFn::StaticTestFn(test) => test().err(),
                _ => Some("not a plain test".to_owned()),
            });
        }
    }
}
