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
    fs::create_dir_all(&places.work).map_err(|error| Fault::file(&places.work, error))?;
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name("powder-master").typescript(false);
    bindgen.remove_name_section(true).remove_producers_section(true).omit_default_module_path(true);
    bindgen
        .web(true)
        .and_then(|bindgen| bindgen.generate(&places.work))
        .map_err(|error| Fault::failed(format!("wasm-bindgen: {error:#}")))?;
    Ok(Bound { wasm: places.work.join("powder-master_bg.wasm"), script: places.work.join("powder-master.js") })
}
