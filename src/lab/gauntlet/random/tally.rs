//! What came of many worlds: the worst of each rule, and what failed. Tallies of shards add up to that of all worlds.

use crate::{
    lab::{
        cases::Shard,
        gauntlet::{
            judged::Found,
            rule::{Measured, Rule},
        },
        markdown,
    },
    sim::numbers::figure,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Width of the document, characters.
const WIDTH: usize = 118;

/// What came of the worlds of a seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// The seed.
    pub seed: u64,
    /// Worlds that were asked for, of all shards.
    pub count: u64,
    /// Qualities that worlds begin at.
    pub qualities: Vec<String>,
    /// Which part of them this is, if it is not all.
    pub shard: Option<Shard>,
    /// Worlds that were judged.
    pub worlds: u64,
    /// Scenes that were refused, as they should be.
    pub refused: u64,
    /// What came of each rule, in their order.
    pub rules: Vec<RuleTally>,
    /// Worlds that broke a rule, by their index.
    pub failures: Vec<Failure>,
}

/// What came of a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RuleTally {
    /// The rule.
    pub rule: Rule,
    /// Worlds that it was judged in.
    pub judged: u64,
    /// Worlds that broke it where the method is known to: [`Rule::is_beyond_plain`].
    pub known: u64,
    /// Other worlds that broke it.
    pub failed: u64,
    /// Worlds that it does not apply to, by the reason.
    pub waived: BTreeMap<String, u64>,
    /// What came nearest to the bound, or went furthest beyond it, but for what is known.
    pub worst: Option<Worst>,
}

/// The worst of a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Index of the world.
    pub world: u64,
    /// The quality that it begins at.
    pub quality: String,
    /// What was measured in it.
    pub measured: Measured,
}

/// A world that broke rules.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// Index of the world.
    pub world: u64,
    /// The quality that it begins at.
    pub quality: String,
    /// The rules that it broke, gravest first, and what was measured as a multiple of what is allowed.
    pub rules: Vec<(Rule, f64)>,
    /// What is broken, a line for each of them.
    pub broken: Vec<String>,
    /// The scene file that it is kept as.
    pub file: String,
}

impl Tally {
    /// Of no world yet.
    pub fn new(seed: u64, count: u64, qualities: Vec<String>, shard: Option<Shard>) -> Self {
        let of = |rule| RuleTally { rule, judged: 0, known: 0, failed: 0, waived: BTreeMap::new(), worst: None };
        let rules = Rule::ALL.map(of).into();
        Self { seed, count, qualities, shard, worlds: 0, refused: 0, rules, failures: Vec::new() }
    }

    /// Adds what came of a world.
    pub fn add(&mut self, world: u64, quality: &str, found: &Found, failure: Option<Failure>) {
        let Found::Judged { findings, .. } = found else {
            self.refused += 1;
            return;
        };
        self.worlds += 1;
        for finding in findings {
            let tally = &mut self.rules[finding.rule as usize];
            match &finding.measured {
                Ok(measured) => {
                    tally.judged += 1;
                    if measured.is_broken() && found.excuses(finding.rule) {
                        tally.known += 1;
                        continue;
                    }
                    tally.failed += u64::from(measured.is_broken());
                    tally.offer(Worst { world, quality: quality.to_owned(), measured: measured.clone() });
                }
                Err(why) => *tally.waived.entry((*why).to_owned()).or_default() += 1,
            }
        }
        self.failures.extend(failure);
    }

    /// The tally of all shards together.
    ///
    /// # Errors
    /// If they are not the shards of one run, each once: a line that says what is wrong and what is allowed.
    pub fn merge(parts: Vec<Self>) -> Result<Self, String> {
        Shard::check_complete(parts.iter().map(|part| part.shard))?;
        let mut parts = parts.into_iter();
        let Some(mut all) = parts.next() else { return Err("no tallies; allowed: those of all shards".into()) };
        for part in parts {
            if (part.seed, part.count, &part.qualities) != (all.seed, all.count, &all.qualities) {
                return Err(format!(
                    "worlds of seed {} ({}) beside those of seed {} ({}); allowed: shards of one run",
                    part.seed, part.count, all.seed, all.count
                ));
            }
            all.worlds += part.worlds;
            all.refused += part.refused;
            for (all, part) in all.rules.iter_mut().zip(part.rules) {
                all.judged += part.judged;
                all.known += part.known;
                all.failed += part.failed;
                part.waived.into_iter().for_each(|(why, count)| *all.waived.entry(why).or_default() += count);
                part.worst.into_iter().for_each(|worst| all.offer(worst));
            }
            all.failures.extend(part.failures);
        }
        all.failures.sort_by_key(|failure| failure.world);
        all.shard = None;
        Ok(all)
    }

    /// How many worlds came out how, in a line.
    pub fn summary(&self) -> String {
        let Self { seed, count, worlds, refused, failures, shard, .. } = self;
        let part = shard.map_or_else(String::new, |shard| format!(", shard {shard}"));
        format!("{count} worlds of seed {seed}{part}: {worlds} judged, {refused} refused, {} failed", failures.len())
    }

    /// The worst of each rule, as an aligned table in Markdown.
    pub fn table(&self) -> String {
        let lines = self.rules.iter().map(|tally| {
            let waived = tally.waived.values().sum::<u64>();
            let (worst, allowed, at) = tally.worst.as_ref().map_or_else(Default::default, |worst| {
                let Measured { value, bound, tick, .. } = worst.measured;
                let at = format!("{}/{} tick {tick}, {}", self.seed, worst.world, worst.quality);
                (figure(value), figure(bound), if value > 0.0 { at } else { String::new() })
            });
            let (rule, value) = (tally.rule.name(), tally.rule.value());
            let RuleTally { judged, known, failed, .. } = tally;
            format!("{rule} | {value} | {judged} | {waived} | {known} | {failed} | {worst} | {allowed} | {at}")
        });
        let headings =
            "rule | measured | >judged | >not | >known | >failed | >worst | >allowed there | in (seed/world)";
        markdown::rows(headings, lines)
    }

    /// What failed, a line for each world.
    pub fn failed(&self) -> Vec<String> {
        let line = |Failure { world, quality, broken, file, .. }: &Failure| {
            format!("{}/{world} at {quality}: {} ({file})", self.seed, broken.join("; "))
        };
        self.failures.iter().map(line).collect()
    }

    /// What a rule allows, and why it was not judged where it was not.
    pub fn notes(&self) -> Vec<String> {
        let note = |tally: &RuleTally| {
            let waived: Vec<String> = tally.waived.iter().map(|(why, count)| format!("{why} {count}")).collect();
            let waived = if waived.is_empty() { String::new() } else { format!(" Not judged: {}.", waived.join(", ")) };
            format!("- **{}**: {}.{waived}", tally.rule.name(), tally.rule.bound())
        };
        self.rules.iter().map(note).collect()
    }

    /// The whole as a document: the command that made it, the table, the rules.
    pub fn document(&self, command: &str, processor: &str) -> String {
        let head = format!(
            "`{command}` writes this file ({processor}). A world is made of seed and index alone; the worst of each rule is \
             what came nearest to what is allowed in its world, or went furthest beyond it. *Known* is what breaks a rule that \
             plain PBF, without the pressure predictor, does not hold: at `classic`, or where the effect is off."
        );
        let item = |text: &String| markdown::fill(text, WIDTH).replace('\n', "\n  ") + "\n";
        let notes: String = self.notes().iter().map(item).collect();
        let failed: String = self.failed().iter().map(|line| item(&format!("- {line}"))).collect();
        let failed = if failed.is_empty() { "None.\n".to_owned() } else { failed };
        let (head, table) = (markdown::fill(&head, WIDTH), self.table());
        format!(
            "# The random gauntlet\n\n{head}\n\n{}.\n\n## The worst of each rule\n\n{table}\n## What is allowed\n\n{notes}\n\
             ## Worlds that failed\n\n{failed}",
            self.summary()
        )
    }

    /// What to say if a world failed: how many, and the files.
    pub fn failure(&self) -> Option<String> {
        /// Files that are named in a line.
        const NAMED: usize = 5;
        let first = self.failures.first()?;
        let files: Vec<&str> = self.failures.iter().take(NAMED).map(|failure| failure.file.as_str()).collect();
        let more = self.failures.len().saturating_sub(NAMED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        Some(format!(
            "{} of {} worlds broke a rule, the first {}/{}: {}; kept as {}{more}",
            self.failures.len(),
            self.worlds,
            self.seed,
            first.world,
            first.broken.join("; "),
            files.join(", ")
        ))
    }
}

impl RuleTally {
    /// Keeps the worse; of two that are as bad the first.
    fn offer(&mut self, other: Worst) {
        let is_worse = |worst: &Worst| {
            let (one, new) = (worst.measured.share(), other.measured.share());
            new > one || new == one && other.world < worst.world
        };
        if self.worst.as_ref().is_none_or(is_worse) {
            self.worst = Some(other);
        }
    }
}
