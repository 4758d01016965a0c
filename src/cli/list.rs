//! `list`: what there is to choose from, one a line, fields separated by tabs.

use crate::{
    cli::{args::Listing, failure::Failure, output},
    kernel::{element::Element, params::Preset},
    lab::gauntlet,
    scene::{
        self, Knob, Tuning,
        effects::{Effect, EffectRow},
    },
};

/// Prints a list on stdout.
pub(super) fn list(what: Listing) -> Result<(), Failure> {
    let lines = match what {
        Listing::Scenes => scene::builtin_names().into_iter().map(scene).collect::<Result<_, _>>()?,
        Listing::Elements => scene::elements()?.iter().map(|(_, row)| element(row)).collect(),
        Listing::Effects => Effect::ALL.map(effect).to_vec(),
        Listing::Qualities => Preset::ALL.map(quality).to_vec(),
        Listing::Cases => gauntlet::CASES.iter().map(|case| format!("{}\t{}", case.name, case.what)).collect(),
    };
    output::print(&lines.into_iter().fold(String::new(), |text: String, line| text + &line + "\n"))
}

fn scene(name: &str) -> Result<String, Failure> {
    let scene = scene::load(name)?;
    let parameters: Vec<String> = (scene.parameters().iter())
        .map(|(name, spec)| format!("{name}={} ({} … {})", spec.default, spec.min, spec.max))
        .collect();
    Ok(format!("{name}\t{}\t{}", scene.description(), parameters.join(", ")))
}

fn element(row: &Element) -> String {
    let [red, green, blue] = row.colour;
    let kind = if row.fixed { "fixed" } else { "movable" };
    let key = row.key.map_or_else(|| "none".to_owned(), String::from);
    let numbers: String = row.numbers().iter().map(|number| format!(" {}={}", number.name, number.value)).collect();
    let Element { name, category, card, .. } = row;
    format!(
        "{name}\t{card}\tcategory={} key={key} {kind} colour=#{red:02x}{green:02x}{blue:02x}{numbers}",
        category.name()
    )
}

fn effect(effect: Effect) -> String {
    let EffectRow { name, meaning, when, off, parameters, .. } = effect.row();
    let stages = effect.place("in");
    let parameters = if parameters.is_empty() { "none".to_owned() } else { parameters.join(", ") };
    format!("{name}\t{meaning}\tstages: {stages}\tauto: runs while {when}\toff: {off}\tparameters: {parameters}")
}

fn quality(preset: Preset) -> String {
    let tuning = Tuning::from(preset.quality());
    let values: String = Knob::of_quality().map(|knob| format!("{}={} ", knob.name, knob.text(&tuning))).collect();
    format!("{}\t{values}predictor={} detail={}", preset.name(), tuning.quality.predictor, preset.detail())
}
