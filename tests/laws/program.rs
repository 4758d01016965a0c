//! All files of the program and which depends on which. Each path in a file is followed to the file that defines the item,
//! through modules and re-exports.

use crate::source::{Mention, Source};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

/// A module: its crate's name and the names below it.
type Module = Vec<String>;

/// One file names an item of another.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Dependency {
    pub from: String,
    pub to: String,
    pub line: usize,
    /// Whether it is only the tests in the file that do.
    pub test: bool,
}

/// The files.
pub struct Program {
    modules: BTreeMap<Module, (String, Source)>,
}

impl Program {
    /// Reads all files below the folder of each crate, which lie below `root`. A folder within another is a crate apart.
    pub fn read(root: &Path, crates: &[(&str, &str)]) -> Self {
        let texts = crates.iter().flat_map(|(_, folder)| {
            files(&root.join(folder)).into_iter().map(|file| {
                let text = fs::read_to_string(&file).unwrap();
                (file.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/"), text)
            })
        });
        Self::of(texts.collect(), crates)
    }

    /// The same of files and their texts.
    pub fn of(texts: BTreeMap<String, String>, crates: &[(&str, &str)]) -> Self {
        let module = |file: &str| {
            let inner = crates.iter().filter(|(_, folder)| file.starts_with(&format!("{folder}/")));
            let (name, folder) = inner.max_by_key(|(_, folder)| folder.len()).expect("it was found in a crate");
            let below = file[folder.len() + 1..].trim_end_matches(".rs");
            let below = below.split('/').filter(|part| !["lib", "mod"].contains(part));
            [*name].into_iter().chain(below).map(str::to_owned).collect()
        };
        let read = |(file, text): (String, String)| {
            let source = Source::read(&text).unwrap_or_else(|fault| panic!("{file}: {fault}"));
            (module(&file), (file, source))
        };
        Self { modules: texts.into_iter().map(read).collect() }
    }

    /// All dependencies, sorted. A file does not depend on what it only re-exports.
    pub fn dependencies(&self) -> Vec<Dependency> {
        let mut dependencies = Vec::new();
        for (module, (from, source)) in &self.modules {
            let own = source.imports.iter().filter(|import| !import.public || source.idents.contains_key(&import.name));
            for mention in own.map(|import| &import.mention).chain(&source.mentions) {
                if let Some(to) = self.resolve(module, mention)
                    && to != from
                {
                    let test = mention.inside.iter().any(|name| name == "tests");
                    dependencies.push(Dependency { from: from.clone(), to: to.to_owned(), line: mention.line, test });
                }
            }
        }
        dependencies.sort();
        dependencies.dedup();
        dependencies
    }

    /// The file that defines what is mentioned in `module`; `None` if it is none of ours.
    fn resolve(&self, module: &Module, mention: &Mention) -> Option<&str> {
        let mut from = module.clone();
        from.extend(mention.inside.iter().cloned());
        self.find(&self.absolute(module, &from, &mention.path, 0)?, 0)
    }

    /// The path from the crate on, as seen `from` a place in the file of `module`.
    fn absolute(&self, module: &Module, from: &[String], path: &[String], depth: usize) -> Option<Module> {
        let (first, rest) = path.split_first()?;
        let join = |base: &[String]| Some([base, rest].concat());
        match first.as_str() {
            "crate" => join(&module[..1]),
            "self" => join(from),
            "super" => {
                let above = &from[..from.len().checked_sub(1)?];
                let on = if rest.first().is_some_and(|next| next == "super") { rest } else { return join(above) };
                self.absolute(module, above, on, depth)
            }
            name => {
                let child = [module.as_slice(), &[name.to_owned()]].concat();
                if self.modules.contains_key(&child) {
                    return join(&child);
                }
                let imports = &self.modules.get(module)?.1.imports;
                let import = imports.iter().find(|import| import.name == name && import.mention.path[0] != name);
                if let Some(import) = import.filter(|_| depth < 9) {
                    let from = [module.as_slice(), &import.mention.inside].concat();
                    return join(&self.absolute(module, &from, &import.mention.path, depth + 1)?);
                }
                self.modules.contains_key(&path[..1]).then(|| path.to_vec())
            }
        }
    }

    /// The file that defines what an absolute path names. A module alone is needed for nothing.
    fn find(&self, path: &[String], depth: usize) -> Option<&str> {
        let length = (1..=path.len()).rev().find(|&length| self.modules.contains_key(&path[..length]))?;
        let (module, item) = (path[..length].to_vec(), path.get(length)?);
        let (file, source) = &self.modules[&module];
        if source.items.contains(item) || item == "*" || depth > 9 {
            return Some(file);
        }
        let Some(import) = source.imports.iter().find(|import| import.name == *item) else { return Some(file) };
        let target = self.absolute(&module, &module, &import.mention.path, 0)?;
        self.find(&[&target, &path[length + 1..]].concat(), depth + 1)
    }
}

/// All Rust files in a folder and below it.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
    found
}

/// Dependencies in a small program, as `from:line to`.
#[cfg(test)]
fn dependencies(texts: &[(&str, &str)]) -> Vec<String> {
    let texts = texts.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect();
    let program = Program::of(texts, &[("top", "src"), ("low", "src/low")]);
    program
        .dependencies()
        .iter()
        .map(|dependency| format!("{}:{} {}", dependency.from, dependency.line, dependency.to))
        .collect()
}

#[test]
fn a_need_leads_to_the_file_that_defines_the_item() {
    let found = dependencies(&[
        ("src/lib.rs", "pub mod a;\npub mod b;"),
        ("src/a/mod.rs", "mod inner;\npub use inner::Thing;"),
        ("src/a/inner.rs", "pub struct Thing;"),
        ("src/b.rs", "use crate::a::{self, Thing};\nfn f() { a::Thing::new(); }\n"),
    ]);
    assert_eq!(found, ["src/b.rs:1 src/a/inner.rs", "src/b.rs:2 src/a/inner.rs"]);
}

#[test]
fn a_child_that_uses_its_parents_item_needs_it_and_a_list_of_modules_needs_nothing() {
    let found = dependencies(&[
        ("src/a/mod.rs", "pub mod inner;\npub use inner::f;\npub struct Own;"),
        ("src/a/inner.rs", "use super::Own;\nmod tests { use super::*; use super::super::Own; }\npub fn f() {}"),
        ("src/c/mod.rs", "pub mod inner;\npub use inner::f;\nfn g() { f(); inner::h(); }"),
        ("src/c/inner.rs", "pub fn f() {}\npub fn h() {}"),
    ]);
    let expected = [
        "src/a/inner.rs:1 src/a/mod.rs",
        "src/a/inner.rs:2 src/a/mod.rs",
        "src/c/mod.rs:2 src/c/inner.rs",
        "src/c/mod.rs:3 src/c/inner.rs",
    ];
    assert_eq!(found, expected);
}

#[test]
fn a_crate_within_another_has_paths_of_its_own() {
    let found = dependencies(&[
        ("src/lib.rs", "pub use low as deep;"),
        ("src/low/lib.rs", ""),
        ("src/low/x.rs", "use crate::y::Y;"),
        ("src/low/y.rs", "pub struct Y;"),
        ("src/z.rs", "use low::y::Y;\nuse std::fmt::Debug;\nuse crate::deep::y::Y;"),
    ]);
    assert_eq!(found, ["src/low/x.rs:1 src/low/y.rs", "src/z.rs:1 src/low/y.rs", "src/z.rs:3 src/low/y.rs"]);
}
