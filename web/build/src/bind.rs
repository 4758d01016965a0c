//! Module → module and the JavaScript that belongs to it.

use crate::{Places, fault::Fault};
use std::{
    fs,
    path::{Path, PathBuf},
};
use wasm_bindgen_cli_support::Bindgen;

/// A module and its script.
pub struct Bound {
    /// The module.
    pub wasm: PathBuf,
    /// Its script.
    pub script: PathBuf,
}

/// Writes the script that takes the module into a page.
pub fn bind(module: &Path, places: &Places) -> Result<Bound, Fault> {
    eprintln!("binding it to JavaScript");
    let mut bindgen = Bindgen::new();
    bindgen.remove_name_section(true).remove_producers_section(true);
    write(bindgen.input_path(module), &places.work, "powder-master")
}

/// Writes the script that takes a module of tests into node; both are called `name`.
pub fn bind_suite(module: &Path, name: &str, places: &Places) -> Result<(), Fault> {
    let bound = write(Bindgen::new().input_path(module), &places.suite, name)?;
    // Node takes a script for a module by its ending.
    let script = bound.script.with_extension("mjs");
    fs::rename(&bound.script, &script).map_err(|error| Fault::file(&script, error))
}

fn write(bindgen: &mut Bindgen, folder: &Path, name: &str) -> Result<Bound, Fault> {
    fs::create_dir_all(folder).map_err(|error| Fault::file(folder, error))?;
    bindgen
        .out_name(name)
        .typescript(false)
        .omit_default_module_path(true)
        .web(true)
        .and_then(|bindgen| bindgen.generate(folder))
        .map_err(|error| Fault::failed(format!("wasm-bindgen: {error:#}")))?;
    Ok(Bound { wasm: folder.join(format!("{name}_bg.wasm")), script: folder.join(format!("{name}.js")) })
}
