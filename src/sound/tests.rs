//! The sound as a whole: what it must be whatever the controls say.

use crate::{CEILING, Controls, Synthesiser, math::decay, noise::Chance};

/// Controls that are silent but for some.
fn only(change: impl Fn(&mut Controls)) -> Controls {
    let mut controls = Controls::SILENT;
    change(&mut controls);
    controls
}

/// Each sound by itself, at a level.
fn sounds(level: f32) -> [(&'static str, Controls); 8] {
    [
        ("splash", only(|c| (c.splash_level, c.splash_rate) = (level, 200.0))),
        ("stream", only(|c| c.stream_level = level)),
        ("wind", only(|c| c.wind_level = level)),
        ("hiss", only(|c| c.hiss_level = level)),
        ("clatter", only(|c| c.clatter_level = level)),
        ("fire", only(|c| (c.fire_level, c.fire_crackle) = (level, 30.0))),
        ("boil", only(|c| (c.boil_level, c.boil_rate) = (level, 80.0))),
        ("blast", only(|c| c.blast_level = level)),
    ]
}

fn render(synthesiser: &mut Synthesiser, controls: &Controls, seconds: f32) -> Vec<f32> {
    let mut out = vec![0.0; 2 * (seconds * 48_000.0) as usize];
    synthesiser.render(controls, &mut out);
    out
}

/// Effective values of the left and the right.
fn loudness(frames: &[f32]) -> [f32; 2] {
    let mean = |side: usize| {
        let squares: f64 = frames.iter().skip(side).step_by(2).map(|x| f64::from(*x) * f64::from(*x)).sum();
        (squares / (frames.len() / 2) as f64).sqrt() as f32
    };
    [mean(0), mean(1)]
}

fn both([left, right]: [f32; 2]) -> f32 {
    left.hypot(right)
}

/// Controls anywhere within their ranges, some at the ends.
fn any(chance: &mut Chance) -> Controls {
    let mut values = [0.0; Controls::ALL.len()];
    for (value, control) in values.iter_mut().zip(Controls::ALL) {
        let share = (1.4 * chance.unit() - 0.2).clamp(0.0, 1.0);
        *value = control.min + share * (control.max - control.min);
    }
    Controls::from_array(values)
}

#[test]
fn a_level_is_what_it_says() {
    for level in [0.02, 0.1] {
        // Of single knocks the level is that of each.
        for (name, controls) in sounds(level).into_iter().filter(|(name, _)| *name != "clatter") {
            let heard = both(loudness(&render(&mut Synthesiser::default(), &controls, 4.0)[96_000..]));
            let decibels = 20.0 * (heard / level).log10();
            assert!(decibels.abs() < 5.0, "{name} of level {level} has one of {heard} ({decibels:+.1} dB)");
        }
    }
}

#[test]
fn what_has_a_higher_level_is_louder() {
    for ((name, faint), (_, loud)) in sounds(0.03).into_iter().zip(sounds(0.12)) {
        let [faint, loud] =
            [faint, loud].map(|controls| both(loudness(&render(&mut Synthesiser::default(), &controls, 3.0))));
        assert!(loud > 2.0 * faint, "{name}: {loud} is not much louder than {faint}");
    }
}

#[test]
fn a_pan_turned_over_turns_the_sides_over() {
    let panned = |pan: f32| {
        only(|c| {
            [c.splash_pan, c.stream_pan, c.wind_pan, c.hiss_pan, c.clatter_pan, c.fire_pan, c.boil_pan, c.blast_pan] =
                [pan; 8];
        })
    };
    for (name, controls) in sounds(0.1) {
        let at = |pan: f32| {
            let levels = controls.to_array();
            let mut all = panned(pan).to_array();
            for ((value, level), control) in all.iter_mut().zip(levels).zip(Controls::ALL) {
                *value = if control.name.ends_with("_pan") { *value } else { level };
            }
            loudness(&render(&mut Synthesiser::default(), &Controls::from_array(all), 3.0))
        };
        let ([left, right], [other_left, other_right]) = (at(-0.8), at(0.8));
        assert!(left > 1.5 * right, "{name}: {left} on the left, {right} on the right");
        assert!((left / other_right - 1.0).abs() < 0.15, "{name}: {left} and {other_right}");
        assert!((right / other_left - 1.0).abs() < 0.35, "{name}: {right} and {other_left}");
    }
}

#[test]
fn nothing_is_above_the_ceiling_whatever_the_controls_are() {
    let mut chance = Chance::new(77);
    let mut synthesiser = Synthesiser::default();
    let (mut peak, mut frames) = (0.0_f32, vec![0.0; 1600]);
    for k in 0..3000 {
        let mut controls = any(&mut chance);
        if k % 7 == 0 {
            controls.splash_level = f32::NAN;
            controls.wind_pitch = f32::INFINITY;
            controls.blast_pan = f32::NEG_INFINITY;
            controls.gain = 1e30;
        }
        synthesiser.render(&controls, &mut frames);
        assert!(frames.iter().all(|sample| sample.is_finite()));
        peak = frames.iter().fold(peak, |peak, sample| peak.max(sample.abs()));
    }
    assert!(peak <= CEILING, "{peak}");
    assert!(peak > 0.85, "nothing was loud enough to be limited: {peak}");
}

/// A click is energy far above a sound's own pitches, in the moment of a step.
#[test]
fn a_step_of_a_control_is_no_click() {
    let steepest = |frames: &[f32]| frames.windows(3).map(|w| (w[2] - w[0]).abs()).fold(0.0_f32, f32::max);
    for (name, controls) in sounds(0.1).into_iter().filter(|(name, _)| ["stream", "wind", "hiss"].contains(name)) {
        let mut other = controls;
        (other.stream_pitch, other.wind_pitch, other.hiss_pitch) = (900.0, 500.0, 4000.0);
        [other.stream_pan, other.wind_pan, other.hiss_pan] = [-0.9; 3];
        let mut muted = controls;
        muted.gain = 0.0;
        for to in [other, muted, Controls::SILENT] {
            let mut synthesiser = Synthesiser::default();
            // The sound moves faster than a control does: what it does of itself in a second before and after.
            let before = steepest(&render(&mut synthesiser, &controls, 2.0)[96_000..]);
            let step = steepest(&render(&mut synthesiser, &to, 0.1));
            let after = steepest(&render(&mut synthesiser, &to, 2.0));
            assert!(step <= 1.15 * before.max(after), "{name}: {step} at the step, {before} before, {after} after");
        }
    }
}

#[test]
fn it_is_silent_two_seconds_after_the_last_sound() {
    let mut chance = Chance::new(3);
    for _ in 0..20 {
        let mut synthesiser = Synthesiser::default();
        render(&mut synthesiser, &any(&mut chance), 1.0);
        let mut still = any(&mut chance);
        for (name, level) in Controls::ALL.iter().zip(still.to_array()).map(|(control, value)| (control.name, value)) {
            assert!(level.is_finite(), "{name}");
        }
        for field in [
            &mut still.splash_level,
            &mut still.stream_level,
            &mut still.wind_level,
            &mut still.hiss_level,
            &mut still.clatter_level,
            &mut still.fire_level,
            &mut still.boil_level,
            &mut still.blast_level,
        ] {
            *field = 0.0;
        }
        render(&mut synthesiser, &still, 2.0);
        assert!(synthesiser.is_quiet());
        assert!(render(&mut synthesiser, &still, 0.5).iter().all(|sample| *sample == 0.0));
    }
}

#[test]
fn nothing_sounds_without_a_cause() {
    let mut synthesiser = Synthesiser::default();
    assert!(render(&mut synthesiser, &Controls::SILENT, 1.0).iter().all(|sample| *sample == 0.0));
}

#[test]
fn it_makes_no_difference_in_what_pieces_it_is_asked_for() {
    let mut chance = Chance::new(11);
    let controls = any(&mut chance);
    let whole = render(&mut Synthesiser::default(), &controls, 0.5);
    let (mut synthesiser, mut pieces) = (Synthesiser::default(), vec![0.0; whole.len()]);
    let mut start = 0;
    while start < pieces.len() {
        let end = (start + 2 * (1 + (300.0 * chance.unit()) as usize)).min(pieces.len());
        synthesiser.render(&controls, &mut pieces[start..end]);
        start = end;
    }
    assert_eq!(whole, pieces);
}

#[test]
fn every_sample_rate_is_as_loud() {
    for (name, controls) in sounds(0.1).into_iter().filter(|(name, _)| *name != "clatter") {
        let at = |rate: u32| {
            let mut out = vec![0.0; 8 * rate as usize];
            Synthesiser::new(rate).render(&controls, &mut out);
            both(loudness(&out))
        };
        let [low, high] = [at(44_100), at(96_000)];
        let decibels = 20.0 * (low / high).log10();
        assert!(decibels.abs() < 2.0, "{name}: {decibels:.1} dB");
    }
}

#[test]
fn controls_keep_their_places() {
    let mut values = [0.0; Controls::ALL.len()];
    for (k, value) in values.iter_mut().enumerate() {
        *value = decay(k as f32);
    }
    assert_eq!(Controls::from_array(values).to_array(), values);
    assert!(Controls::SILENT.is_silent());
    assert_eq!(Controls::SILENT.within(), Controls::SILENT, "silence is within all ranges");
    assert!(values.len() <= 24);
}
