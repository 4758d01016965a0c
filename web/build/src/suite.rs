//! The tests of the libraries as modules, under node.

use crate::{Places, bind, compile, fault::Fault, tool};
use std::process::Command;

/// The packages whose libraries are tested.
const PACKAGES: [&str; 2] = ["powder-kernel", "powder-master"];

/// Builds the tests and runs those whose name has `name` in it.
pub fn test(name: &str, places: &Places) -> Result<(), Fault> {
    if !tool::exists("node") {
        return Err(Fault::missing("the program `node`, which runs the tests", "get Node.js 20 or newer"));
    }
    for package in PACKAGES {
        let module = compile::compile_suite(package, places)?;
        bind::bind_suite(&module, package, places)?;
    }
    eprintln!("running the tests");
    let mut node = Command::new("node");
    tool::run(node.arg(places.root.join("tests/web/suite.mjs")).arg(&places.suite).arg(name).args(PACKAGES))
        .map_err(|_| Fault::failed("not all tests of the module are good (see above)"))
}
