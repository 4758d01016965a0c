//! Module, script and page → `dist/`, with compressed copies.
//!
//! What changes with the game has its hash in its name, so a browser may keep it for ever; `files.json` lists all.

use crate::{Places, bind::Bound, fault::Fault};
use flate2::{Compression, write::GzEncoder};
use std::{
    collections::{BTreeMap, hash_map::DefaultHasher},
    fs,
    hash::{Hash, Hasher},
    io::Write,
    path::Path,
};

/// Files of `web/` that are part of the page under their own names.
const PAGE: [&str; 3] = ["icon.svg", "manifest.webmanifest", "service.js"];
/// Files of `web/` whose names get a hash.
const SCRIPTS: [&str; 4] = ["page.js", "storage.js", "style.css", "worker.js"];
/// Smaller files are not worth a compressed copy, bytes.
const WORTH_COMPRESSING: usize = 1024;
/// Most that brotli may look back: 2 to this many bytes.
const BROTLI_WINDOW: i32 = 24;

/// Writes `dist/` anew, with copies compressed by brotli and gzip if `compressed`.
pub fn pack(bound: &Bound, places: &Places, compressed: bool) -> Result<(), Fault> {
    eprintln!("packing dist/");
    let read = |path: &Path| fs::read(path).map_err(|error| Fault::file(path, error));
    let page = places.root.join("web");
    let mut files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    let mut add = |name: &str, bytes: Vec<u8>| {
        let hashed = with_hash(name, &bytes);
        names.insert(name.to_owned(), hashed.clone());
        files.insert(hashed, bytes);
    };
    add("powder-master.wasm", read(&bound.wasm)?);
    add("powder-master.js", read(&bound.script)?);
    for name in SCRIPTS {
        add(name, read(&page.join(name))?);
    }
    for name in PAGE {
        files.insert(name.to_owned(), read(&page.join(name))?);
    }
    let index = fs::read_to_string(page.join("index.html")).map_err(|error| Fault::file(&page, error))?;
    files.insert("index.html".to_owned(), fill_in(index, &names, &files).into_bytes());
    let sizes: BTreeMap<&String, usize> = files.iter().map(|(name, bytes)| (name, bytes.len())).collect();
    let list = serde_json::to_vec_pretty(&serde_json::json!({ "names": names, "bytes": sizes }))
        .map_err(|error| Fault::failed(error.to_string()))?;
    files.insert("files.json".to_owned(), list);

    if places.dist.exists() {
        fs::remove_dir_all(&places.dist).map_err(|error| Fault::file(&places.dist, error))?;
    }
    fs::create_dir_all(&places.dist).map_err(|error| Fault::file(&places.dist, error))?;
    for (name, bytes) in &files {
        write(&places.dist.join(name), bytes, compressed)?;
    }
    Ok(())
}

/// `name.js` as `name-0123456789abcdef.js`.
fn with_hash(name: &str, bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    let hash = hasher.finish();
    match name.rsplit_once('.') {
        Some((stem, ending)) => format!("{stem}-{hash:016x}.{ending}"),
        None => format!("{name}-{hash:016x}"),
    }
}

/// Puts the names with their hashes, and the module's size, where the page has `{{name}}` and `{{bytes}}`.
fn fill_in(mut page: String, names: &BTreeMap<String, String>, files: &BTreeMap<String, Vec<u8>>) -> String {
    for (name, hashed) in names {
        page = page.replace(&format!("{{{{{name}}}}}"), hashed);
    }
    let bytes = names.get("powder-master.wasm").and_then(|name| files.get(name)).map_or(0, Vec::len);
    page.replace("{{bytes}}", &bytes.to_string())
}

/// Writes a file and, if it is worth it, its compressed copies.
fn write(path: &Path, bytes: &[u8], compressed: bool) -> Result<(), Fault> {
    let put = |ending: &str, bytes: &[u8]| {
        let mut path = path.as_os_str().to_owned();
        path.push(ending);
        fs::write(&path, bytes).map_err(|error| Fault::file(path.as_ref(), error))
    };
    put("", bytes)?;
    if !compressed || bytes.len() < WORTH_COMPRESSING {
        return Ok(());
    }
    let failed = |error: std::io::Error| Fault::file(path, error);
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    gzip.write_all(bytes).map_err(failed)?;
    put(".gz", &gzip.finish().map_err(failed)?)?;
    let parameters = brotli::enc::BrotliEncoderParams {
        quality: 11,
        lgwin: BROTLI_WINDOW,
        size_hint: bytes.len(),
        ..Default::default()
    };
    let mut small = Vec::new();
    brotli::BrotliCompress(&mut &*bytes, &mut small, &parameters).map_err(failed)?;
    if bytes.len() > 1 << 20 {
        eprintln!("{:.2} MB with brotli", small.len() as f64 / 1e6);
    }
    put(".br", &small)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_change_with_what_is_in_the_file() {
        let (a, b) = (with_hash("page.js", b"a"), with_hash("page.js", b"b"));
        assert!(a != b && a.starts_with("page-") && a.ends_with(".js"), "{a} {b}");
    }

    #[test]
    fn the_page_gets_names_and_size() {
        let names = BTreeMap::from([("powder-master.wasm".to_owned(), "powder-master-1.wasm".to_owned())]);
        let files = BTreeMap::from([("powder-master-1.wasm".to_owned(), vec![0; 7])]);
        let page = fill_in("{{powder-master.wasm}} {{bytes}} {{other}}".to_owned(), &names, &files);
        assert_eq!(page, "powder-master-1.wasm 7 {{other}}");
    }
}
