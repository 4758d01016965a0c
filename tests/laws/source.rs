//! What one file says: the items it defines, the names it imports and the paths it mentions. Read from its tokens, so
//! that comments and strings count for nothing and what stands in macros counts.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{HashMap, HashSet};

/// Words before the name of an item.
const DEFINES: [&str; 8] = ["struct", "enum", "union", "trait", "type", "fn", "const", "static"];

/// A path of at least two names, or one that an import brings in.
#[derive(Clone, Debug, PartialEq)]
pub struct Mention {
    /// Names, as written: `["super", "grid", "Grid"]`. A glob ends with `*`.
    pub path: Vec<String>,
    /// Inline modules around it, outermost first.
    pub inside: Vec<String>,
    pub line: usize,
}

/// One name that a `use` brings in.
#[derive(Clone, Debug)]
pub struct Import {
    /// The name in this file; `*` of a glob.
    pub name: String,
    /// Whether it stands there for others: `pub use`.
    pub public: bool,
    pub mention: Mention,
}

/// A file, read.
#[derive(Debug, Default)]
pub struct Source {
    /// Names of the items that it defines itself, modules excepted.
    pub items: HashSet<String>,
    pub imports: Vec<Import>,
    pub mentions: Vec<Mention>,
    /// How often each name occurs outside `use`.
    pub idents: HashMap<String, usize>,
}

impl Source {
    /// Reads the text of a file; the fault if it is no Rust.
    pub fn read(text: &str) -> Result<Self, String> {
        let tokens: TokenStream = text.parse().map_err(|fault| format!("{fault}"))?;
        let mut source = Self::default();
        source.walk(tokens, &mut Vec::new(), true);
        Ok(source)
    }

    /// Reads tokens; `top` are those of the file itself, of no body.
    fn walk(&mut self, tokens: TokenStream, inside: &mut Vec<String>, top: bool) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            at += match (word(&tokens, at).as_deref(), tokens.get(at + 1)) {
                (Some("use"), Some(next)) if !is_punct(next, '<') => self.read_use(&tokens, at, inside),
                (Some("mod"), Some(TokenTree::Ident(name))) => {
                    if let Some(TokenTree::Group(body)) = tokens.get(at + 2) {
                        inside.push(name.to_string());
                        self.walk(body.stream(), inside, false);
                        inside.pop();
                    }
                    3
                }
                (Some(keyword), Some(TokenTree::Ident(name))) if top && DEFINES.contains(&keyword) => {
                    self.items.insert(name.to_string());
                    1
                }
                (Some(_), _) => self.read_path(&tokens, at, inside),
                (None, _) => {
                    if let TokenTree::Group(group) = &tokens[at] {
                        self.walk(group.stream(), inside, false);
                    }
                    1
                }
            };
        }
    }

    /// Reads `use …;` and returns how many tokens it has.
    fn read_use(&mut self, tokens: &[TokenTree], at: usize, inside: &[String]) -> usize {
        let end = (at..tokens.len()).find(|&k| is_punct(&tokens[k], ';')).unwrap_or(tokens.len());
        let is_pub = |k: Option<usize>| k.is_some_and(|k| word(tokens, k).as_deref() == Some("pub"));
        let restricted = matches!(at.checked_sub(1).map(|k| &tokens[k]), Some(TokenTree::Group(_)));
        let public = is_pub(at.checked_sub(1)) || restricted && is_pub(at.checked_sub(2));
        let line = tokens[at].span().start().line;
        read_tree(&tokens[at + 1..end], &[], &mut |path, name, leaf| {
            let mention = Mention { path, inside: inside.to_vec(), line: leaf.unwrap_or(line) };
            self.imports.push(Import { name, public, mention });
        });
        end + 1 - at
    }

    /// Reads a name or a path and returns how many tokens it has.
    fn read_path(&mut self, tokens: &[TokenTree], at: usize, inside: &[String]) -> usize {
        let mut path: Vec<String> = word(tokens, at).into_iter().collect();
        let mut end = at + 1;
        while joins(tokens, end)
            && let Some(name) = word(tokens, end + 2)
        {
            path.push(name);
            end += 3;
        }
        let before = at.checked_sub(1).map(|k| &tokens[k]);
        let goes_on = before
            .is_some_and(|token| is_punct(token, '.') || is_punct(token, ':') && at >= 2 && joins(tokens, at - 2));
        for name in &path {
            *self.idents.entry(name.clone()).or_default() += 1;
        }
        if path.len() > 1 && !goes_on {
            let line = tokens[at].span().start().line;
            self.mentions.push(Mention { path, inside: inside.to_vec(), line });
        }
        end - at
    }
}

/// Calls `leaf` with path, name and line of each name that a tree of imports brings in.
fn read_tree(tokens: &[TokenTree], before: &[String], leaf: &mut impl FnMut(Vec<String>, String, Option<usize>)) {
    for tree in tokens.split(|token| is_punct(token, ',')).filter(|tree| !tree.is_empty()) {
        let mut path = before.to_vec();
        let (mut name, mut line) = (None, None);
        for (k, token) in tree.iter().enumerate() {
            match token {
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    read_tree(&inner, &path, leaf);
                    path.clear();
                    break;
                }
                TokenTree::Ident(_) if k > 0 && word(tree, k - 1).as_deref() == Some("as") => name = word(tree, k),
                TokenTree::Ident(ident) if *ident != "as" => path.push(ident.to_string()),
                TokenTree::Punct(punct) if punct.as_char() == '*' => path.push("*".to_owned()),
                _ => continue,
            }
            line = Some(token.span().start().line);
        }
        // `use a::{self, b}` brings in `a` itself.
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        if let Some(last) = path.last().cloned() {
            leaf(path, name.unwrap_or(last), line);
        }
    }
}

fn word(tokens: &[TokenTree], at: usize) -> Option<String> {
    match tokens.get(at)? {
        TokenTree::Ident(ident) => Some(ident.to_string()),
        _ => None,
    }
}

fn is_punct(token: &TokenTree, char: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == char)
}

/// Whether `::` stands at `at`.
fn joins(tokens: &[TokenTree], at: usize) -> bool {
    matches!(tokens.get(at..at + 2), Some([first, second]) if is_punct(first, ':') && is_punct(second, ':'))
}

#[test]
fn imports_are_read_name_by_name_with_their_lines() {
    let source =
        Source::read("use crate::{\n a::{B, c::{self, D as E}},\n f::*,\n};\npub(crate) use super::g;").unwrap();
    let found: Vec<_> = source
        .imports
        .iter()
        .map(|import| (import.mention.path.join("::"), &*import.name, import.public, import.mention.line))
        .collect();
    assert_eq!(
        found,
        [
            ("crate::a::B".to_owned(), "B", false, 2),
            ("crate::a::c".to_owned(), "c", false, 2),
            ("crate::a::c::D".to_owned(), "E", false, 2),
            ("crate::f::*".to_owned(), "*", false, 3),
            ("super::g".to_owned(), "g", true, 5),
        ]
    );
}

#[test]
fn paths_are_read_from_code_and_macros_but_not_from_comments_and_strings() {
    let text = "/// crate::no::No\nfn f(x: &crate::a::B) -> c::D {\n assert!(g::<u8>(\"crate::no::No\"), x.h(super::i::J));\n}\n// crate::no";
    let source = Source::read(text).unwrap();
    let found: Vec<_> = source.mentions.iter().map(|mention| (mention.path.join("::"), mention.line)).collect();
    assert_eq!(found, [("crate::a::B".to_owned(), 2), ("c::D".to_owned(), 2), ("super::i::J".to_owned(), 3)]);
    assert!(source.items.contains("f") && source.items.len() == 1);
}

#[test]
fn what_stands_in_an_inline_module_is_known_to() {
    let source = Source::read("mod a { mod tests { use super::B; const C: u8 = 0; } }\nmod d;\nstruct E;").unwrap();
    assert_eq!(source.imports[0].mention.inside, ["a", "tests"]);
    assert!(!source.items.contains("C") && source.items.contains("E"));
}
