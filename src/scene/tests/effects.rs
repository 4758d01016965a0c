//! The tables of passes and effects.

use crate::scene::{
    effects::{Effect, EffectRow},
    passes::Pass,
};

/// The table of docs/effects.md.
fn document() -> String {
    let code = |words: &[&str]| words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
    let or_dash = |text: String| if text.is_empty() { "–".to_owned() } else { text };
    let mut text = "| effect | what it does | passes | needs | runs in `auto` while | `off` means | \
                    `on` is another world while | parameters |\n|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for effect in Effect::ALL {
        let EffectRow { name, meaning, passes, part_of, needs, when, parameters, off, another, .. } = effect.row();
        let names: Vec<&str> = passes.iter().map(|pass| pass.name()).collect();
        let passes = part_of.map_or_else(|| code(&names), |pass| format!("a part of `{}`", pass.name()));
        let needs: Vec<&str> = needs.iter().map(|effect| effect.name()).collect();
        let parameters = parameters.iter().map(|name| match name.split_once(' ') {
            Some((name, rest)) => format!("`{name}` {rest}"),
            None => format!("`{name}`"),
        });
        let cells = [
            format!("`{name}`"),
            (*meaning).to_owned(),
            passes,
            or_dash(code(&needs)),
            (*when).to_owned(),
            (*off).to_owned(),
            or_dash((*another).to_owned()),
            or_dash(parameters.collect::<Vec<_>>().join(", ")),
        ];
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}

#[test]
fn the_document_has_the_table() {
    let table = document();
    assert!(include_str!("../../../docs/effects.md").contains(&table), "docs/effects.md does not have\n{table}");
}

#[test]
fn the_names_of_effects_are_those_of_the_files() {
    for effect in Effect::ALL {
        assert_eq!(format!("\"{}\"", effect.name()), serde_json::to_string(&effect).unwrap());
        let row = effect.row();
        assert!(row.passes.is_empty() == row.part_of.is_some(), "{}: where is its work?", row.name);
    }
}

#[test]
fn no_pass_belongs_to_two_effects() {
    for pass in Pass::ALL {
        let owners = Effect::ALL.iter().filter(|effect| effect.row().passes.contains(&pass)).count();
        assert_eq!(usize::from(Effect::of(pass).is_some()), owners, "{}", pass.name());
    }
}
