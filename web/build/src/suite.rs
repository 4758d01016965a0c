//! The library's tests as a module, under node.

use crate::{Places, bind, compile, fault::Fault, tool};
use std::process::Command;

/// Builds the tests and runs those whose name has `name` in it.
pub fn test(name: &str, places: &Places) -> Result<(), Fault> {
    if !tool::exists("node") {
        return Err(Fault::missing("the program `node`, which runs the tests", "get Node.js 20 or newer"));
    }
    let module = compile::compile_suite(places)?;
    bind::bind_suite(&module, places)?;
    eprintln!("running the tests");
    let mut node = Command::new("node");
    tool::run(node.arg(places.root.join("tests/web/suite.mjs")).arg(&places.suite).arg(name))
        .map_err(|_| Fault::failed("not all tests of the module are good (see above)"))
}
