//! A random scene file, in parts, so that what fails can be told from what only stands beside it.

/// A scene of which every entry can be left out but spacing, size and preset.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Scene {
    /// What stands above the scene, a comment.
    pub head: String,
    /// Particle spacing, m.
    pub spacing: String,
    /// Size of the box.
    pub size: String,
    /// Name of the preset.
    pub preset: &'static str,
    /// What can be left out.
    pub lists: [Entries; 9],
}

/// A field of the scene and its entries.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Entries {
    /// Name of the field. A part without a name holds whole fields.
    pub name: &'static str,
    /// What the entries stand in.
    pub brackets: [&'static str; 2],
    /// The entries.
    pub entries: Vec<String>,
}

impl Entries {
    /// A list, `[…]`.
    pub fn list(name: &'static str, entries: Vec<String>) -> Self {
        Self { name, brackets: ["[", "]"], entries }
    }

    /// Fields of a field, `(…)`.
    pub fn fields(name: &'static str, entries: Vec<String>) -> Self {
        Self { name, brackets: ["(", ")"], entries }
    }

    fn text(&self, first: Option<String>) -> String {
        let Self { name, brackets: [open, close], entries } = self;
        let entries: Vec<String> = first.into_iter().chain(entries.iter().cloned()).collect();
        match (entries.as_slice(), name.is_empty()) {
            ([], _) => String::new(),
            (fields, true) => fields.iter().map(|field| format!("    {field},\n")).collect(),
            (_, false) if *open == "[" => format!("    {name}: [\n        {},\n    ],\n", entries.join(",\n        ")),
            (_, false) => format!("    {name}: {open}{}{close},\n", entries.join(", ")),
        }
    }
}

impl Scene {
    /// The text of its file.
    pub fn text(&self) -> String {
        let Self { head, spacing, size, preset, lists } = self;
        let lists: String = (lists.iter())
            .map(|list| list.text((list.name == "quality").then(|| format!("preset: {preset}"))))
            .collect();
        format!("{head}(\n    title: \"Random\",\n    spacing: {spacing},\n    size: {size},\n{lists})\n")
    }
}

/// All scenes with one entry less, last entries first.
pub(super) fn smaller(scene: &Scene) -> impl Iterator<Item = Scene> + use<> {
    let scene = scene.clone();
    let counts: Vec<usize> = scene.lists.iter().map(|list| list.entries.len()).collect();
    let entries = counts.into_iter().enumerate().flat_map(|(list, count)| (0..count).rev().map(move |k| (list, k)));
    entries.map(move |(list, entry)| {
        let mut smaller = scene.clone();
        smaller.lists[list].entries.remove(entry);
        smaller
    })
}
