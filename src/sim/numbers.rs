//! Numbers as text.

/// A number with commas between the thousands: `12,345,678`. Decimals of a fraction stay as they are.
pub fn grouped(number: impl ToString) -> String {
    grouped_by(number, ",")
}

/// A number with `sign` between the thousands.
pub fn grouped_by(number: impl ToString, sign: &str) -> String {
    let number = number.to_string();
    let whole = number.find('.').unwrap_or(number.len());
    let mut text = String::with_capacity(number.len() + number.len() / 3);
    for (k, char) in number.chars().enumerate() {
        if (1..whole).contains(&k) && (whole - k).is_multiple_of(3) && !text.ends_with('-') {
            text.push_str(sign);
        }
        text.push(char);
    }
    text
}

/// A number to four figures; a very large or small one with its power of ten.
pub fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if !size.is_finite() => "none".to_owned(),
        size if !(1e-3..1e5).contains(&size) => format!("{value:.1e}"),
        _ => figures(value, 4),
    }
}

/// A number to two figures.
pub fn short(value: f32) -> String {
    figures(f64::from(value), 2)
}

/// A number to so many figures, but at most four decimals.
fn figures(value: f64, figures: i32) -> String {
    let before_the_point = value.abs().log10().floor() as i32;
    trimmed(value, figures.saturating_sub(1).saturating_sub(before_the_point).clamp(0, 4) as usize)
}

/// A number with so many decimals; a dash where there is none.
pub fn fixed(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
}

/// A number with at most so many decimals, and no zeros at the end.
pub fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_grouped() {
        for (number, text) in [("0", "0"), ("999", "999"), ("1000", "1,000"), ("1234567", "1,234,567")] {
            assert_eq!(grouped(number), text);
        }
        for (number, text) in [("-100", "-100"), ("-1000", "-1,000"), ("1234.5678", "1,234.5678"), ("0.125", "0.125")] {
            assert_eq!(grouped(number), text);
        }
    }

    #[test]
    fn figures_have_four_digits_at_most() {
        for (value, text) in [
            (0.0, "0"),
            (9.81, "9.81"),
            (1.66666, "1.667"),
            (-0.012345, "-0.0123"),
            (12345.6, "12346"),
            (2e-7, "2.0e-7"),
            (f64::NAN, "none"),
        ] {
            assert_eq!(figure(value), text);
        }
    }

    #[test]
    fn short_numbers_have_two() {
        for (value, text) in [(0.0, "0"), (12.3, "12"), (1.04, "1"), (3.24, "3.2"), (0.312, "0.31"), (0.05, "0.05")] {
            assert_eq!(short(value), text);
        }
        assert_eq!(short(0.0021), "0.0021");
    }
}
