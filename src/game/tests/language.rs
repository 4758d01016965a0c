//! Every text that a player sees is there in every language. Texts are found where they stand: in the code as what `tr!` is given,
//! in the page's script as what `spoken` is given, and in the tables.

use crate::{
    game::{
        hud::{
            self, style,
            tiles::{Face, tile},
        },
        icons,
        input::bindings::{Bindings, Group},
        language::{Known, Language},
        mixer::dials::DIALS,
        panels::Panels,
        tools::{TOOLS, Tool, spaced},
        views::table::VIEWS,
    },
    lab::{
        exam::exhibits::{EXHIBITS, Exhibit},
        gauntlet::throws::THROWS,
    },
    scene::{self, SceneCategory, challenges::challenges},
};
use bevy::prelude::App;
use bevy_egui::egui;
use proc_macro2::{TokenStream, TokenTree};
use rspolib::POEntry;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// A text as the code has it: in which context, what it says, and what of several.
type Text = (Option<String>, String, Option<String>);

/// Functions that show what they are given, and whether only methods of that name do.
const SHOW: [(&str, bool); 16] = [
    ("label", false),
    ("weak", false),
    ("button", true),
    ("small_button", false),
    ("checkbox", false),
    ("selectable_label", false),
    ("selectable_value", false),
    ("on_hover_text", false),
    ("on_disabled_hover_text", false),
    ("hint_text", false),
    ("heading", false),
    ("say", false),
    ("warn", true),
    ("hint", false),
    ("main_button", false),
    ("menu", false),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// What tells a player something.
const TELL: [&str; 3] = ["src/game", "src/web", "src/cli"];

/// The files of some folders, but for tests.
fn sources(folders: &[&str]) -> Vec<(PathBuf, TokenStream)> {
    fn walk(path: &Path, found: &mut Vec<PathBuf>) {
        if path.is_dir() {
            let entries =
                fs::read_dir(path).expect("the sources are there").map(|entry| entry.expect("as well").path());
            entries.filter(|path| !path.ends_with("tests")).for_each(|path| walk(&path, found));
        } else if path.extension().is_some_and(|kind| kind == "rs") && !path.ends_with("tests.rs") {
            found.push(path.to_owned());
        }
    }
    let mut paths = Vec::new();
    folders.iter().for_each(|folder| walk(&root().join(folder), &mut paths));
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a source can be read");
        // What is behind this is for tests only.
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let tokens = text.parse().unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
        (path, tokens)
    };
    paths.into_iter().map(read).collect()
}

/// What a literal of a string says.
fn value(token: &TokenTree) -> Option<String> {
    let TokenTree::Literal(literal) = token else { return None };
    let text = literal.to_string();
    let inner = text.strip_prefix('"')?.strip_suffix('"')?;
    let mut joined = String::new();
    let mut lines = inner.split("\\\n");
    joined.push_str(lines.next()?);
    lines.for_each(|line| joined.push_str(line.trim_start()));
    ron::from_str(&format!("\"{joined}\"")).ok()
}

/// Calls `each` with the tokens before a group and those in it, for all groups.
fn groups(tokens: TokenStream, each: &mut impl FnMut(&[TokenTree], &[TokenTree])) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (at, token) in tokens.iter().enumerate() {
        if let TokenTree::Group(group) = token {
            let inner: Vec<TokenTree> = group.stream().into_iter().collect();
            each(&tokens[..at], &inner);
            groups(group.stream(), each);
        }
    }
}

fn is(token: Option<&TokenTree>, text: &str) -> bool {
    token.is_some_and(|token| token.to_string() == text)
}

/// Whether what comes before a group makes it what a macro is given.
fn is_macro(before: &[TokenTree], name: &str) -> bool {
    matches!(before, [.., word, mark] if is(Some(word), name) && is(Some(mark), "!"))
}

/// What `tr!` is given in the code: `[context =>] text [| of several]`.
fn of_code() -> BTreeSet<Text> {
    let mut found = BTreeSet::new();
    for (_, tokens) in sources(&TELL) {
        groups(tokens, &mut |before, inner| {
            if !is_macro(before, "tr") {
                return;
            }
            let has_context = is(inner.get(1), "=") && is(inner.get(2), ">");
            let (context, rest) = if has_context { (value(&inner[0]), &inner[3..]) } else { (None, inner) };
            let Some(text) = rest.first().and_then(value) else { return };
            let several = is(rest.get(1), "|").then(|| rest.get(2).and_then(value)).flatten();
            found.insert((context, text, several));
        });
    }
    assert!(found.len() > 300, "{} texts are too few to be all", found.len());
    found
}

/// All literals of the program's code.
fn literals() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (_, tokens) in sources(&["src"]) {
        groups(tokens, &mut |_, inner| found.extend(inner.iter().filter_map(value)));
    }
    found
}

/// What the page says: what its script gives `spoken`, and the parts of it that are marked.
fn of_page() -> Vec<String> {
    let read = |name: &str| fs::read_to_string(root().join("web").join(name)).expect("the page is there");
    let (page, script) = (read("index.html"), read("page.js"));
    let marked = page.split(" data-spoken>").skip(1).filter_map(|rest| rest.split('<').next());
    let said = script.split("game.spoken('").skip(1).filter_map(|rest| rest.split('\'').next());
    let texts: Vec<String> = marked.chain(said).map(str::to_owned).collect();
    assert!(texts.len() > 5, "{texts:?}");
    texts
}

/// What an effect says of why it runs or does not: the texts in pairs with `true` and `false`, and what `verdict` is given.
fn reasons() -> Vec<String> {
    let text = fs::read_to_string(root().join("src/scene/effects.rs")).expect("the table is there");
    let mut found = Vec::new();
    groups(text.parse().expect("it is Rust"), &mut |before, inner| {
        let is_pair = is(inner.first(), "true") || is(inner.first(), "false");
        if is_pair || is(before.last(), "verdict") {
            found.extend(inner.iter().filter_map(value).filter(|text| !text.is_empty()));
        }
    });
    found
}

/// What the tables have.
fn of_tables() -> Vec<String> {
    let mut app = App::new();
    hud::panels::plugin(&mut app);
    let mut texts = Vec::new();
    let bindings = app.world().resource::<Bindings>();
    texts.extend(bindings.iter().map(|binding| binding.help.to_owned()));
    texts.extend(Group::ALL.map(|group| group.title().to_owned()));
    for (panel, _) in app.world().resource::<Panels>().iter() {
        texts.extend([panel.title, panel.help].into_iter().chain(panel.in_list).map(str::to_owned));
    }
    texts.extend(TOOLS.map(|row| row.name.to_owned()));
    texts.extend(VIEWS.map(|view| view.name.to_owned()));
    let marks = VIEWS.iter().flat_map(|view| view.legend).map(|(_, mark)| (*mark).to_owned());
    texts.extend(marks.filter(|mark| has_words(mark)));
    texts.extend(DIALS.iter().flat_map(|dial| [dial.name, dial.help]).map(str::to_owned));
    let elements = scene::elements().expect("the table that comes with the game is valid");
    let all: Vec<Tool> = Tool::all(&elements).collect();
    texts.extend(Tool::groups(&elements, &all).into_iter().map(|(title, _)| title.to_owned()));
    for (_, element) in elements.iter() {
        texts.extend([spaced(&element.name), element.card.clone()]);
    }
    texts.extend(SceneCategory::ALL.map(|category| category.title().to_owned()));
    for name in scene::builtin_names() {
        let scene = scene::load(name).expect("it comes with the game");
        texts.extend([scene.title(), scene.description(), scene.invitation()].map(str::to_owned));
        texts.extend(scene.parameters().values().map(|spec| spec.description.clone()));
    }
    for challenge in challenges().expect("they come with the game") {
        texts.extend([challenge.title().to_owned(), challenge.task.clone()]);
    }
    texts.extend(THROWS.iter().flat_map(|throw| [throw.title, throw.what]).map(str::to_owned));
    texts.extend(EXHIBITS.iter().map(|exhibit| exhibit.drawn.to_owned()));
    texts.extend(EXHIBITS.iter().filter_map(Exhibit::case).map(|case| case.title.to_owned()));
    texts.retain(|text| !text.is_empty());
    texts
}

fn entries(tag: &str) -> Vec<POEntry> {
    let path = root().join(format!("assets/texts/{tag}.po"));
    rspolib::pofile(path.to_str().expect("the path is text")).unwrap_or_else(|fault| panic!("{tag}: {fault}")).entries
}

/// What stands in braces, in the order of the alphabet.
fn places(text: &str) -> Vec<&str> {
    let mut found: Vec<&str> = text.split('{').skip(1).filter_map(|rest| rest.split('}').next()).collect();
    found.sort_unstable();
    found
}

#[test]
fn every_text_is_there_in_every_language_and_none_is_left_over() {
    let mut wanted = of_code();
    let tables = of_tables().into_iter().chain(of_page()).chain(reasons()).chain(["English".to_owned()]);
    wanted.extend(tables.map(|text| (None, text, None)));
    // What code gives `spoken` may stand anywhere.
    let mut known = literals();
    known.extend(VIEWS.map(|view| view.name.to_lowercase()));
    for Known { tag, .. } in Language::all().iter().filter(|known| known.tag != "en") {
        let entries = entries(tag);
        let there: BTreeMap<Text, &POEntry> = entries
            .iter()
            .map(|entry| ((entry.msgctxt.clone(), entry.msgid.clone(), entry.msgid_plural.clone()), entry))
            .collect();
        assert_eq!(there.len(), entries.len(), "{tag}: a text stands twice");
        let missing: Vec<_> = wanted.iter().filter(|text| !there.contains_key(*text)).collect();
        let is_over = |text: &Text| !wanted.contains(text) && text.0.is_none() && !known.contains(&text.1);
        let over: Vec<_> = there.keys().filter(|text| is_over(text)).collect();
        assert!(missing.is_empty() && over.is_empty(), "{tag}: missing {missing:#?}, left over {over:#?}");
        for entry in &entries {
            let said: Vec<&String> = entry.msgstr.iter().chain(&entry.msgstr_plural).collect();
            assert!(!said.is_empty() && said.iter().all(|text| !text.is_empty()), "{}: nothing", entry.msgid);
            for text in said {
                let expected = places(entry.msgid_plural.as_ref().unwrap_or(&entry.msgid));
                assert_eq!(places(text), expected, "{tag}: {:?} and {text:?}", entry.msgid);
            }
        }
    }
}

/// Whether a text has a word in it: three small letters on end.
fn has_words(text: &str) -> bool {
    let letters: Vec<char> = text.chars().collect();
    letters.windows(3).any(|three| three.iter().all(|letter| letter.is_ascii_lowercase()))
}

#[test]
fn nothing_is_shown_that_can_not_be_in_another_language() {
    let mut found = Vec::new();
    for (path, tokens) in sources(&["src/game", "src/web"]) {
        groups(tokens, &mut |before, inner| {
            let [.., way, name] = before else { return };
            let is_method = is(Some(way), ".");
            let shows = SHOW.iter().any(|(show, method)| is(Some(name), show) && (!method || is_method));
            if !shows || is(Some(way), "fn") {
                return;
            }
            let mut texts: Vec<String> = inner.iter().filter_map(value).collect();
            for inner_of in inner.windows(3) {
                if let (true, TokenTree::Group(given)) = (is_macro(&inner_of[..2], "format"), &inner_of[2]) {
                    let bare = |text: String| {
                        // What is in braces is put in, and is text of its own.
                        let parts = text.split('{').map(|part| part.rsplit('}').next().unwrap_or_default());
                        parts.collect::<String>()
                    };
                    texts.extend(given.stream().into_iter().take(1).filter_map(|token| value(&token)).map(bare));
                }
            }
            found.extend(
                texts.into_iter().filter(|text| has_words(text)).map(|text| (path.display().to_string(), text)),
            );
        });
    }
    assert!(found.is_empty(), "in English only: {found:#?}");
}

#[test]
fn no_name_on_a_tile_is_too_small_or_larger_than_the_tile_in_any_language() {
    let context = egui::Context::default();
    style::apply(&context);
    let elements = scene::elements().expect("the table that comes with the game is valid");
    let mut names: Vec<String> = Tool::all(&elements).map(|tool| spaced(tool.name(&elements))).collect();
    names.push("elements".to_owned());
    for Known { tag, .. } in Language::all() {
        let there = if *tag == "en" { Vec::new() } else { entries(tag) };
        let in_it = |name: &String| there.iter().find(|entry| entry.msgid == *name)?.msgstr.clone();
        for name in names.iter().map(|name| in_it(name).unwrap_or_else(|| name.clone())) {
            for (size, unit) in [((37.0, 50.0), 1.0), ((54.0, 50.0), 1.0), ((62.0, 52.0), 1.0), ((60.0, 48.0), 0.8)] {
                for key in ["", "1", "F10"] {
                    let face = Face { icon: (icons::cloud, style::TEXT), label: &name, name: "", key, chosen: false };
                    let mut place = egui::Rect::NOTHING;
                    let output = context.run_ui(egui::RawInput::default(), |ui| {
                        place = tile(ui, size.into(), unit, &face).rect;
                    });
                    let texts = output.shapes.iter().filter_map(|clipped| match &clipped.shape {
                        egui::Shape::Text(text) => Some(text),
                        _ => None,
                    });
                    for text in texts {
                        let said = &text.galley.job.text;
                        let sizes = text.galley.job.sections.iter().map(|section| section.format.font_id.size);
                        let least = sizes.fold(f32::MAX, f32::min);
                        assert!(least >= style::SMALL * unit, "{tag}: {said:?} has {least} points");
                        let rect = text.galley.rect.translate(text.pos.to_vec2());
                        assert!(place.expand(0.5).contains_rect(rect), "{tag}: {said:?} is beyond its tile: {rect:?}");
                    }
                }
            }
        }
    }
}
