//! Arithmetic in scene files: `"4 * columns * d"`.
//!
//! `+ − * / ( )`, `min(a, b)`, `max(a, b)`, `sqrt(a)`, numbers and names: only what IEEE 754 rounds the same on every
//! platform, so that a scene has the same bits everywhere. The general libraries bring sines and powers along, which
//! don't have them.
//!
//! An expression is kept in postfix order, so that evaluating needs a stack of numbers instead of recursion; parsing
//! recurses into parentheses and signs, [`DEEPEST`] levels at most.

/// Longest expression, bytes.
const LONGEST: usize = 1000;

/// Most parentheses and signs within each other.
const DEEPEST: usize = 64;

/// The functions, with their number of arguments.
const FUNCTIONS: [(&str, usize, Step); 3] = [("min", 2, Step::Min), ("max", 2, Step::Max), ("sqrt", 1, Step::Sqrt)];

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

#[derive(Clone, Debug, PartialEq)]
enum Step {
    Number(f64),
    Name(String),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Min,
    Max,
    Sqrt,
}

/// A parsed expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expression {
    steps: Vec<Step>,
}

impl Expression {
    /// Parses the text; the error says what is wrong and at which character.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        if text.len() > LONGEST {
            return Err(format!("an expression of {} bytes; at most {LONGEST} are allowed", text.len()));
        }
        let mut parser = Parser { text, at: 0, depth: 0, steps: Vec::new() };
        parser.sum().and_then(|()| parser.end()).map_err(|what| {
            let column = 1 + text.get(..parser.at).map_or(parser.at, |before| before.chars().count());
            format!("expression \"{text}\", character {column}: {what}")
        })?;
        Ok(Self { steps: parser.steps })
    }

    /// The value, with names looked up by `value_of`; an error names what has no finite value.
    pub(super) fn evaluate(&self, value_of: impl Fn(&str) -> Option<f64>) -> Result<f64, Fault> {
        let mut stack: Vec<f64> = Vec::new();
        for step in &self.steps {
            let result = match step {
                Step::Number(value) => *value,
                Step::Name(name) => value_of(name).ok_or_else(|| Fault::UnknownName(name.clone()))?,
                Step::Negate => -pop(&mut stack),
                Step::Sqrt => pop(&mut stack).sqrt(),
                binary => {
                    let right = pop(&mut stack);
                    let left = pop(&mut stack);
                    match binary {
                        Step::Add => left + right,
                        Step::Subtract => left - right,
                        Step::Multiply => left * right,
                        Step::Divide if right == 0.0 => return Err(Fault::DivisionByZero),
                        Step::Divide => left / right,
                        Step::Min => left.min(right),
                        _ => left.max(right),
                    }
                }
            };
            if !result.is_finite() {
                return Err(Fault::NotFinite);
            }
            stack.push(result);
        }
        Ok(pop(&mut stack))
    }
}

/// The parser leaves an operand for every operator, so the stack never runs dry.
fn pop(stack: &mut Vec<f64>) -> f64 {
    debug_assert!(!stack.is_empty(), "an operator without an operand");
    stack.pop().unwrap_or(f64::NAN)
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Fault {
    UnknownName(String),
    DivisionByZero,
    NotFinite,
}

/// Recursive descent: `sum = product {(+|-) product}`, `product = factor {(*|/) factor}`,
/// `factor = [+|-] factor | number | name | name(sum, …) | (sum)`. Appends the steps in postfix order.
struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    steps: Vec<Step>,
}

impl Parser<'_> {
    fn sum(&mut self) -> Result<(), String> {
        self.product()?;
        loop {
            let step = match self.peek() {
                Some(b'+') => Step::Add,
                Some(b'-') => Step::Subtract,
                _ => return Ok(()),
            };
            self.at += 1;
            self.product()?;
            self.steps.push(step);
        }
    }

    fn product(&mut self) -> Result<(), String> {
        self.factor()?;
        loop {
            let step = match self.peek() {
                Some(b'*') => Step::Multiply,
                Some(b'/') => Step::Divide,
                _ => return Ok(()),
            };
            self.at += 1;
            self.factor()?;
            self.steps.push(step);
        }
    }

    fn factor(&mut self) -> Result<(), String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!("nested too deeply; at most {DEEPEST} levels are allowed"));
        }
        match self.peek() {
            Some(b'-') => {
                self.at += 1;
                self.factor()?;
                self.steps.push(Step::Negate);
            }
            Some(b'+') => {
                self.at += 1;
                self.factor()?;
            }
            Some(b'(') => {
                self.at += 1;
                self.sum()?;
                self.expect(b')')?;
            }
            Some(byte) if byte.is_ascii_digit() || byte == b'.' => self.number()?,
            Some(byte) if starts_name(byte) => self.name_or_call()?,
            _ => return Err("expected a number, a name, a function or `(`".to_owned()),
        }
        self.depth -= 1;
        Ok(())
    }

    fn number(&mut self) -> Result<(), String> {
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
        let value: f64 = digits.parse().map_err(|_| format!("`{digits}` isn't a number"))?;
        self.steps.push(Step::Number(value));
        Ok(())
    }

    fn name_or_call(&mut self) -> Result<(), String> {
        let start = self.at;
        while self.byte().is_some_and(continues_name) {
            self.at += 1;
        }
        let name = &self.text[start..self.at];
        if self.peek() != Some(b'(') {
            self.steps.push(Step::Name(name.to_owned()));
            return Ok(());
        }
        let Some((_, arguments, step)) = FUNCTIONS.iter().find(|(function, ..)| *function == name) else {
            return Err(format!("no function `{name}`; allowed: min(a, b), max(a, b), sqrt(a)"));
        };
        self.at += 1;
        for argument in 0..*arguments {
            if argument > 0 {
                self.expect(b',')?;
            }
            self.sum()?;
        }
        self.expect(b')')?;
        self.steps.push(step.clone());
        Ok(())
    }

    fn expect(&mut self, byte: u8) -> Result<(), String> {
        if self.peek() == Some(byte) {
            self.at += 1;
            Ok(())
        } else {
            Err(format!("expected `{}`", char::from(byte)))
        }
    }

    fn end(&mut self) -> Result<(), String> {
        match self.peek() {
            None => Ok(()),
            Some(_) => Err("expected an operator or the end".to_owned()),
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
