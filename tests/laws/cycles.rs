//! Cycles of files: sets in which each file depends on each other one, directly or through others.

use crate::program::Dependency;
use std::{
    collections::{BTreeMap, BTreeSet, VecDeque},
    fmt::{self, Display, Formatter},
};

/// Files that a file depends on, with one line at which it does.
type Graph<'a> = BTreeMap<&'a str, BTreeMap<&'a str, usize>>;

/// A set of files that depend on each other.
#[derive(Debug, PartialEq)]
pub struct Cycle {
    pub files: Vec<String>,
    /// One way round, with the line of each step.
    pub way: String,
}

impl Display for Cycle {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} files: {}", self.files.len(), self.way)
    }
}

/// All cycles of more than one file.
pub fn cycles(dependencies: &[Dependency]) -> Vec<Cycle> {
    let mut graph = Graph::new();
    for dependency in dependencies {
        graph.entry(&dependency.from).or_default().entry(&dependency.to).or_insert(dependency.line);
    }
    let mut known: BTreeSet<&str> = BTreeSet::new();
    let mut found = Vec::new();
    for &file in graph.keys() {
        if known.contains(file) {
            continue;
        }
        let Some(way) = way(&graph, file, file) else { continue };
        let files: Vec<_> = graph.keys().copied().filter(|other| meet(&graph, file, other)).collect();
        known.extend(files.iter().copied());
        let steps: Vec<_> = way.windows(2).map(|step| format!("{}:{} → ", step[0], graph[step[0]][step[1]])).collect();
        let files = files.into_iter().map(str::to_owned).collect();
        found.push(Cycle { files, way: steps.concat() + file });
    }
    found
}

fn meet(graph: &Graph<'_>, a: &str, b: &str) -> bool {
    a == b || way(graph, a, b).is_some() && way(graph, b, a).is_some()
}

/// The shortest way from one file to another, both included; at least one step.
fn way<'a>(graph: &Graph<'a>, from: &'a str, to: &str) -> Option<Vec<&'a str>> {
    let mut before: BTreeMap<&str, &str> = BTreeMap::new();
    let mut queue = VecDeque::from([from]);
    while let Some(file) = queue.pop_front() {
        for &next in graph.get(file).into_iter().flat_map(BTreeMap::keys) {
            if next == to {
                let mut way = vec![next, file];
                while let Some(&last) = before.get(way[way.len() - 1]) {
                    way.push(last);
                }
                way.reverse();
                return Some(way);
            }
            if next != from && !before.contains_key(next) {
                before.insert(next, file);
                queue.push_back(next);
            }
        }
    }
    None
}

#[test]
fn cycles_are_found_apart_with_a_way_round() {
    let dependency = |text: &str| {
        let parts: Vec<_> = text.split(' ').collect();
        Dependency { from: parts[0].to_owned(), to: parts[1].to_owned(), line: parts[2].parse().unwrap(), test: false }
    };
    let dependencies = ["a b 1", "b c 2", "c a 3", "c d 4", "d e 5", "e d 6", "x a 7"].map(dependency);
    let found = cycles(&dependencies);
    let ways: Vec<_> = found.iter().map(|cycle| &*cycle.way).collect();
    assert_eq!(ways, ["a:1 → b:2 → c:3 → a", "d:5 → e:6 → d"]);
    assert_eq!(found[0].files, ["a", "b", "c"]);
    assert!(cycles(&dependencies[2..5]).is_empty());
}
