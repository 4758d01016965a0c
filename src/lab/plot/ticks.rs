//! Where axes are marked.

use crate::lab::plot::chart::Scale;

/// A marked place on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Place, in the unit of the axis.
    pub place: f64,
    /// What stands beside it; nothing at minor marks.
    pub label: Option<String>,
}

/// Marks of an axis between two places; labels at about `wanted` of them at most.
pub(super) fn ticks(scale: Scale, low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    match scale {
        Scale::Linear => linear(low, high, wanted),
        Scale::Logarithmic => logarithmic(low, high, wanted),
    }
}

/// Multiples of 1, 2 or 5 times a power of ten; each fifth (or fourth) of them is minor.
fn linear(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let rough = (high - low) / wanted.max(1) as f64;
    let power = 10_f64.powf(rough.log10().floor());
    let digit = [1.0, 2.0, 5.0, 10.0].into_iter().find(|digit| digit * power >= rough * 0.999).unwrap_or(10.0);
    let parts = if digit == 2.0 { 4 } else { 5 };
    let minor = digit * power / f64::from(parts);
    let (first, last) = ((low / minor - 1e-6).ceil() as i64, (high / minor + 1e-6).floor() as i64);
    (first..=last)
        .map(|k| {
            let label = (k % i64::from(parts) == 0).then(|| number(k as f64 * minor));
            Tick { place: k as f64 * minor, label }
        })
        .collect()
}

/// Powers of ten, and the digits between them: with labels where there is room.
fn logarithmic(low: f64, high: f64, wanted: usize) -> Vec<Tick> {
    let decades = high - low;
    let every = (decades / wanted.max(1) as f64).ceil().max(1.0) as i64;
    let labelled: &[u32] = match decades {
        _ if decades < 1.2 => &[1, 2, 3, 5, 7],
        _ if decades < 3.2 && 3.0 * decades <= wanted as f64 + 2.0 => &[1, 2, 5],
        _ => &[1],
    };
    let mut ticks = Vec::new();
    for power in low.floor() as i64..=high.floor() as i64 {
        for digit in 1..=9_u32 {
            let place = power as f64 + f64::from(digit).log10();
            if (low - 1e-9..=high + 1e-9).contains(&place) {
                let labelled = labelled.contains(&digit) && (every == 1 || power % every == 0);
                ticks.push(Tick { place, label: labelled.then(|| decimal(digit, power)) });
            }
        }
    }
    ticks
}

/// `digit · 10^power`.
fn decimal(digit: u32, power: i64) -> String {
    if (-4..7).contains(&power) {
        let decimals = usize::try_from(-power).unwrap_or(0);
        grouped(&format!("{:.decimals$}", f64::from(digit) * 10_f64.powi(power as i32)))
    } else if power < 0 {
        format!("{digit}e−{}", -power)
    } else {
        format!("{digit}e{power}")
    }
}

/// A number as short as it can be said.
fn number(value: f64) -> String {
    let rounded = format!("{:.6}", value);
    let short = rounded.trim_end_matches('0').trim_end_matches('.');
    match value.abs() {
        size if size < 1e-9 => "0".to_owned(),
        size if !(1e-4..1e7).contains(&size) => format!("{value:.1e}").replace('-', "−"),
        _ => grouped(short).replace('-', "−"),
    }
}

/// Commas between the thousands.
fn grouped(number: &str) -> String {
    let (sign, digits) = number.strip_prefix('-').map_or(("", number), |digits| ("-", digits));
    let (whole, rest) = digits.find('.').map_or((digits, ""), |point| digits.split_at(point));
    let mut text = sign.to_owned();
    for (k, digit) in whole.chars().enumerate() {
        if k > 0 && (whole.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, low: f64, high: f64, wanted: usize) -> Vec<String> {
        ticks(scale, low, high, wanted).into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn linear_axes_are_marked_at_round_numbers() {
        assert_eq!(labels(Scale::Linear, 0.0, 1.0, 5), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(labels(Scale::Linear, -1.3, 1.1, 5), ["−1", "−0.5", "0", "0.5", "1"]);
        assert_eq!(labels(Scale::Linear, 0.0, 4100.0, 4), ["0", "2,000", "4,000"]);
    }

    #[test]
    fn logarithmic_axes_are_marked_at_powers_of_ten_with_all_digits_between() {
        assert_eq!(labels(Scale::Logarithmic, 3.0, 6.1, 4), ["1,000", "10,000", "100,000", "1,000,000"]);
        assert_eq!(labels(Scale::Logarithmic, -2.0, 0.0, 4), ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]);
        assert_eq!(labels(Scale::Logarithmic, -9.0, 3.0, 4), ["1e−9", "1e−6", "0.001", "1", "1,000"]);
        assert_eq!(labels(Scale::Logarithmic, 0.25, 0.75, 5), ["2", "3", "5"]);
        assert_eq!(ticks(Scale::Logarithmic, 0.0, 1.0, 5).len(), 10);
    }
}
