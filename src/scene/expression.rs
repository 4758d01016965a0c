//! Arithmetic in scene files: `"4 * columns * d"`.
//!
//! `+ − * / ( )`, `min(a, b)`, `max(a, b)`, `sqrt(a)`, numbers and names: only what IEEE 754 rounds the same on every
//! platform, so that a scene has the same bits everywhere. The general libraries bring sines and powers along, which
//! don't have them.
//!
//! An expression is kept as its text and read again for its value. Reading recurses into parentheses and signs,
//! [`DEEPEST`] levels at most.

/// Longest expression, bytes.
const LONGEST: usize = 1000;

/// Most parentheses and signs within each other.
const DEEPEST: usize = 64;

/// What is made of two numbers, or of the first of them.
type Operation = fn(f64, f64) -> f64;

/// The functions, with their number of arguments.
const FUNCTIONS: [(&str, usize, Operation); 3] =
    [("min", 2, f64::min), ("max", 2, f64::max), ("sqrt", 1, |number, _| number.sqrt())];

/// Whether a parameter must not have this name because expressions give it a meaning.
pub(super) fn is_reserved(name: &str) -> bool {
    name == "d" || FUNCTIONS.iter().any(|(function, ..)| *function == name)
}

/// Whether `name` can stand in an expression: a letter or `_`, then letters, digits and `_`.
pub(super) fn is_name(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes.next().is_some_and(starts_name) && bytes.all(continues_name)
}

fn starts_name(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

fn continues_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// A well-formed expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expression(String);

impl Expression {
    /// Checks the text; the error says what is wrong and at which character.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        if text.len() > LONGEST {
            return Err(format!("an expression of {} bytes; at most {LONGEST} are allowed", text.len()));
        }
        let mut reader = Reader { text, at: 0, depth: 0, value_of: &|_| None, fault: None };
        reader.whole().map_err(|what| {
            let column = 1 + text.get(..reader.at).map_or(reader.at, |before| before.chars().count());
            format!("expression \"{text}\", character {column}: {what}")
        })?;
        Ok(Self(text.to_owned()))
    }

    /// The value, with names looked up by `value_of`; an error names what has no finite value.
    pub(super) fn evaluate(&self, value_of: impl Fn(&str) -> Option<f64>) -> Result<f64, Fault> {
        let mut reader = Reader { text: &self.0, at: 0, depth: 0, value_of: &value_of, fault: None };
        // It is well-formed, so that there is a value or a fault.
        let value = reader.whole().unwrap_or(f64::NAN);
        reader.fault.map_or(Ok(value), Err)
    }
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(super) enum Fault {
    #[error("no parameter `{0}`")]
    UnknownName(String),
    #[error("the expression divides by zero")]
    DivisionByZero,
    #[error("the expression has no finite value")]
    NotFinite,
}

/// Recursive descent: `sum = product {(+|-) product}`, `product = factor {(*|/) factor}`,
/// `factor = [+|-] factor | number | name | name(sum, …) | (sum)`. Each returns its value; an error is one of form.
struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    value_of: &'a dyn Fn(&str) -> Option<f64>,
    /// The first thing that has no value. What comes of it is no number.
    fault: Option<Fault>,
}

impl Reader<'_> {
    fn whole(&mut self) -> Result<f64, String> {
        let value = self.sum()?;
        if self.peek().is_some() { Err("expected an operator or the end".to_owned()) } else { Ok(value) }
    }

    fn sum(&mut self) -> Result<f64, String> {
        self.chain([(b'+', |left, right| left + right), (b'-', |left, right| left - right)], Self::product)
    }

    fn product(&mut self) -> Result<f64, String> {
        self.chain([(b'*', |left, right| left * right), (b'/', |left, right| left / right)], Self::factor)
    }

    /// Operands with operators between them, from left to right.
    fn chain(
        &mut self,
        operators: [(u8, Operation); 2],
        operand: fn(&mut Self) -> Result<f64, String>,
    ) -> Result<f64, String> {
        let mut left = operand(self)?;
        while let Some(next) = self.peek()
            && let Some((_, operation)) = operators.into_iter().find(|(byte, _)| *byte == next)
        {
            self.at += 1;
            let right = operand(self)?;
            if next == b'/' && right == 0.0 {
                self.fault.get_or_insert(Fault::DivisionByZero);
            }
            left = self.finite(operation(left, right));
        }
        Ok(left)
    }

    fn factor(&mut self) -> Result<f64, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("nested too deeply; at most {DEEPEST} levels are allowed"));
        }
        let value = match self.peek() {
            Some(sign @ (b'-' | b'+')) => {
                self.at += 1;
                let value = self.factor()?;
                if sign == b'-' { -value } else { value }
            }
            Some(b'(') => {
                self.at += 1;
                let value = self.sum()?;
                self.expect(b')')?;
                value
            }
            Some(byte) if byte.is_ascii_digit() || byte == b'.' => self.number()?,
            Some(byte) if starts_name(byte) => self.name_or_call()?,
            _ => return Err("expected a number, a name, a function or `(`".to_owned()),
        };
        self.depth -= 1;
        Ok(value)
    }

    fn number(&mut self) -> Result<f64, String> {
        let start = self.at;
        while let Some(byte) = self.byte() {
            let exponent_sign = matches!(byte, b'+' | b'-')
                && self.at > start
                && matches!(self.text.as_bytes()[self.at - 1], b'e' | b'E');
            if !(byte.is_ascii_digit() || matches!(byte, b'.' | b'e' | b'E') || exponent_sign) {
                break;
            }
            self.at += 1;
        }
        let digits = &self.text[start..self.at];
        let value = digits.parse().map_err(|_| format!("`{digits}` isn't a number"))?;
        Ok(self.finite(value))
    }

    fn name_or_call(&mut self) -> Result<f64, String> {
        let start = self.at;
        while self.byte().is_some_and(continues_name) {
            self.at += 1;
        }
        let name = &self.text[start..self.at];
        if self.peek() != Some(b'(') {
            let value = (self.value_of)(name).unwrap_or_else(|| {
                self.fault.get_or_insert_with(|| Fault::UnknownName(name.to_owned()));
                f64::NAN
            });
            return Ok(self.finite(value));
        }
        let Some((_, arguments, function)) = FUNCTIONS.into_iter().find(|(function, ..)| *function == name) else {
            return Err(format!("no function `{name}`; allowed: min(a, b), max(a, b), sqrt(a)"));
        };
        self.at += 1;
        let first = self.sum()?;
        let mut second = first;
        if arguments > 1 {
            self.expect(b',')?;
            second = self.sum()?;
        }
        self.expect(b')')?;
        Ok(self.finite(function(first, second)))
    }

    /// Notes a value that is not finite.
    fn finite(&mut self, value: f64) -> f64 {
        if !value.is_finite() {
            self.fault.get_or_insert(Fault::NotFinite);
        }
        value
    }

    fn expect(&mut self, byte: u8) -> Result<(), String> {
        if self.peek() == Some(byte) {
            self.at += 1;
            Ok(())
        } else {
            Err(format!("expected `{}`", char::from(byte)))
        }
    }

    fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// The next byte that isn't white space.
    fn peek(&mut self) -> Option<u8> {
        while self.byte().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
        self.byte()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, Fault> {
        let expression = Expression::parse(text).expect(text);
        expression.evaluate(|name| match name {
            "n" => Some(71.0),
            "d" => Some(0.1),
            _ => None,
        })
    }

    #[test]
    fn values_follow_the_rules_of_arithmetic() {
        for (text, expected) in [
            ("2 + 3 * 4", 14.0),
            ("(2 + 3) * 4", 20.0),
            ("10 - 4 - 3", 3.0),
            ("8 / 4 / 2", 1.0),
            ("-n + 70", -1.0),
            ("--2", 2.0),
            ("+1.5e-1 * 2", 0.3),
            ("min(n, 3) + max(1, sqrt(16))", 7.0),
            ("4 * n * d", 4.0 * 71.0 * 0.1),
            ("1E+2", 100.0),
        ] {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_has_no_value_is_an_error() {
        assert_eq!(value("1 / (n - 71)"), Err(Fault::DivisionByZero));
        assert_eq!(value("sqrt(-1)"), Err(Fault::NotFinite));
        assert_eq!(value("1e308 * 10"), Err(Fault::NotFinite));
        assert_eq!(value("m + 1"), Err(Fault::UnknownName("m".to_owned())));
    }

    #[test]
    fn malformed_text_is_an_error_that_says_where() {
        for (text, expected) in [
            ("", "character 1: expected a number"),
            ("2 +", "character 4: expected a number"),
            ("(1", "character 3: expected `)`"),
            ("1 2", "character 3: expected an operator"),
            ("1.2.3", "isn't a number"),
            ("sin(1)", "no function `sin`"),
            ("min(1)", "expected `,`"),
            ("n ± 1", "character 3: expected an operator"),
            ("e+", "character 3: expected a number"),
        ] {
            let error = Expression::parse(text).expect_err(text);
            assert!(error.contains(expected), "{text}: {error}");
        }
    }

    #[test]
    fn deep_nesting_is_an_error_and_not_a_stack_overflow() {
        for text in
            ["(".repeat(900), "-".repeat(900), "sqrt(".repeat(190), format!("{}1{}", "(".repeat(400), ")".repeat(400))]
        {
            assert!(Expression::parse(&text).expect_err("too deep").contains("nested too deeply"));
        }
        assert!(Expression::parse(&"(".repeat(1_000_000)).expect_err("too long").contains("at most 1000"));
        let wide = format!("1{}", "+1".repeat(499));
        assert_eq!(value(&wide), Ok(500.0));
    }
}
