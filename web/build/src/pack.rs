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
const SCRIPTS: [&str; 6] = ["page.js", "sound.js", "storage.js", "style.css", "worker.js", "worklet.js"];
/// Smaller files are not worth a compressed copy, bytes.
const WORTH_COMPRESSING: usize = 1024;
/// Most that brotli may look back: 2 to this many bytes.
const BROTLI_WINDOW: i32 = 24;
/// Largest module, bytes: a phone compiles it before anything is seen.
const MODULE_LIMIT: usize = 17_000_000;
/// Largest module compressed by brotli, bytes: what a visit downloads.
const BROTLI_LIMIT: usize = 5_000_000;
/// What in the module's script comes before its first size of memory, pages.
const PAGES: &str = "WebAssembly.Memory({initial:";

/// Writes `dist/` anew, with copies compressed by brotli and gzip if `compressed`.
///
/// # Errors
/// If a file can't be read or written, or a compressed page would be too large.
pub fn pack(bound: &Bound, sound: &Path, places: &Places, compressed: bool) -> Result<(), Fault> {
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
    add("sound.wasm", read(sound)?);
    for name in SCRIPTS {
        add(name, read(&page.join(name))?);
    }
    for name in PAGE {
        files.insert(name.to_owned(), read(&page.join(name))?);
    }
    let index = fs::read_to_string(page.join("index.html")).map_err(|error| Fault::file(&page, error))?;
    let build = format!("{:016x}", hash(&(&index, &files)));
    let values = [
        ("bytes", len_of("powder-master.wasm", &names, &files).to_string()),
        ("pages", pages(&read(&bound.script)?)?.to_string()),
        ("build", build.clone()),
    ];
    files.insert("index.html".to_owned(), fill_in(index, &names, &values).into_bytes());
    let sizes: BTreeMap<&String, usize> = files.iter().map(|(name, bytes)| (name, bytes.len())).collect();
    let list = serde_json::to_vec_pretty(&serde_json::json!({ "build": build, "names": names, "bytes": sizes }))
        .map_err(|error| Fault::failed(error.to_string()))?;
    files.insert("files.json".to_owned(), list);

    if places.dist.exists() {
        fs::remove_dir_all(&places.dist).map_err(|error| Fault::file(&places.dist, error))?;
    }
    fs::create_dir_all(&places.dist).map_err(|error| Fault::file(&places.dist, error))?;
    for (name, bytes) in &files {
        let small = write(&places.dist.join(name), bytes, compressed)?;
        if let (Some(small), true) = (small, names.get("powder-master.wasm") == Some(name)) {
            eprintln!("{:.2} MB with brotli", small as f64 / 1e6);
            check_size(bytes.len(), small)?;
        }
    }
    Ok(())
}

/// Whether a module of so many bytes, and of so many with brotli, is small enough for a page.
fn check_size(module: usize, brotli: usize) -> Result<(), Fault> {
    for (what, size, limit) in [("the module", module, MODULE_LIMIT), ("the module with brotli", brotli, BROTLI_LIMIT)]
    {
        if size > limit {
            let [size, limit] = [size, limit].map(|bytes| bytes as f64 / 1e6);
            return Err(Fault::failed(format!("{what} is too large for a page: {size:.2} MB, at most {limit:.2}")));
        }
    }
    Ok(())
}

/// The first size of the module's memory, as its script has it.
fn pages(script: &[u8]) -> Result<u32, Fault> {
    let script = String::from_utf8_lossy(script);
    let number =
        script.split_once(PAGES).and_then(|(_, rest)| rest.split(|letter: char| !letter.is_ascii_digit()).next());
    number
        .and_then(|number| number.parse().ok())
        .ok_or_else(|| Fault::failed("the module's script does not say how much memory it begins with"))
}

/// `name.js` as `name-0123456789abcdef.js`.
fn with_hash(name: &str, bytes: &[u8]) -> String {
    let hash = hash(&bytes);
    match name.rsplit_once('.') {
        Some((stem, ending)) => format!("{stem}-{hash:016x}.{ending}"),
        None => format!("{name}-{hash:016x}"),
    }
}

fn hash(of: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}

fn len_of(name: &str, names: &BTreeMap<String, String>, files: &BTreeMap<String, Vec<u8>>) -> usize {
    names.get(name).and_then(|name| files.get(name)).map_or(0, Vec::len)
}

/// Puts the names with their hashes, and other values, where the page has `{{name}}`.
fn fill_in(mut page: String, names: &BTreeMap<String, String>, values: &[(&str, String)]) -> String {
    let names = names.iter().map(|(name, hashed)| (name.as_str(), hashed));
    for (name, value) in names.chain(values.iter().map(|(name, value)| (*name, value))) {
        page = page.replace(&format!("{{{{{name}}}}}"), value);
    }
    page
}

/// Writes a file and, if it is worth it, its compressed copies; how many bytes are left with brotli.
fn write(path: &Path, bytes: &[u8], compressed: bool) -> Result<Option<usize>, Fault> {
    let put = |ending: &str, bytes: &[u8]| {
        let mut path = path.as_os_str().to_owned();
        path.push(ending);
        fs::write(&path, bytes).map_err(|error| Fault::file(path.as_ref(), error))
    };
    put("", bytes)?;
    if !compressed || bytes.len() < WORTH_COMPRESSING {
        return Ok(None);
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
    put(".br", &small)?;
    Ok(Some(small.len()))
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
    fn the_page_gets_names_and_values() {
        let names = BTreeMap::from([("powder-master.wasm".to_owned(), "powder-master-1.wasm".to_owned())]);
        let page = "{{powder-master.wasm}} {{bytes}} {{other}}".to_owned();
        assert_eq!(fill_in(page, &names, &[("bytes", "7".to_owned())]), "powder-master-1.wasm 7 {{other}}");
    }

    #[test]
    fn a_module_that_grew_too_large_is_no_page() {
        assert!(check_size(MODULE_LIMIT, BROTLI_LIMIT).is_ok());
        for (sizes, says) in [((17_010_000, 1), "the module is"), ((1, 5_010_000), "with brotli")] {
            let fault = check_size(sizes.0, sizes.1).expect_err("too large").to_string();
            assert!(fault.contains(says) && fault.contains(".01 MB") && fault.lines().count() == 1, "{fault}");
        }
    }

    #[test]
    fn the_first_size_of_memory_is_in_the_script() {
        assert_eq!(pages(b"memory || new WebAssembly.Memory({initial:69,maximum:9})").expect("is there"), 69);
        assert!(pages(b"new WebAssembly.Memory()").is_err());
    }
}
