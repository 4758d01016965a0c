//! Numbers in scene files: literals or expressions, and the ranges that they must keep to.

use crate::scene::{
    error::{SceneError, choices},
    expression::{Expression, Fault},
};
use glam::DVec2;
use serde::{
    Deserialize, Deserializer,
    de::{Error, Visitor},
};
use std::{collections::BTreeMap, fmt};

/// A number in a scene file: `1.5`, or an expression over the scene's parameters and the spacing `d`: `"4 * columns * d"`.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Number {
    Literal(f64),
    Expression(Expression),
}

/// Two numbers, x and y: `(1, "2 * d")`.
pub(super) type Pair = (Number, Number);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberVisitor;
        impl Visitor<'_> for NumberVisitor {
            type Value = Number;
            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("a number or an expression in quotes")
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Number, E> {
                Ok(Number::Literal(value))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Number, E> {
                Ok(Number::Literal(value as f64))
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Number, E> {
                Ok(Number::Literal(value as f64))
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
                Expression::parse(text).map(Number::Expression).map_err(E::custom)
            }
        }
        deserializer.deserialize_any(NumberVisitor)
    }
}

/// The values that a number may have, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Whether it must be a whole number.
    pub integer: bool,
}

impl Range {
    pub(super) const fn real(min: f64, max: f64) -> Self {
        Self { min, max, integer: false }
    }

    pub(super) const fn whole(min: f64, max: f64) -> Self {
        Self { min, max, integer: true }
    }

    /// The number that `text` is, if it is in the range, otherwise what is wrong with it and what is allowed.
    pub(super) fn read(self, text: &str) -> Result<f64, String> {
        let number = text.trim().parse().map_err(|_| format!("`{text}` isn't a number; allowed: {self}"))?;
        self.check(number)
    }

    /// `value` if it is in the range, otherwise what is wrong with it and what is allowed.
    pub(crate) fn check(self, value: f64) -> Result<f64, String> {
        let fault = if !value.is_finite() {
            "isn't finite"
        } else if value < self.min || value > self.max {
            "is out of range"
        } else if self.integer && value.fract() != 0.0 {
            "isn't a whole number"
        } else {
            return Ok(value);
        };
        Err(format!("{value} {fault}; allowed: {self}"))
    }
}

impl fmt::Display for Range {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.integer { "a whole number from " } else { "" };
        write!(formatter, "{kind}{} to {}", self.min, self.max)
    }
}

/// Gives the numbers of one scene file their values.
pub(super) struct Evaluator<'a> {
    /// Name of the file in errors.
    pub(super) file: &'a str,
    /// Values of the names that expressions may use.
    pub(super) names: BTreeMap<String, f64>,
}

impl Evaluator<'_> {
    /// The error for `field`.
    pub(super) fn fault(&self, field: impl fmt::Display, what: impl fmt::Display) -> SceneError {
        SceneError::value(self.file, field, what)
    }

    /// The value of `number`, which stands in `field` and must lie in `range`.
    pub(super) fn number(&self, field: impl fmt::Display, number: &Number, range: Range) -> Result<f64, SceneError> {
        let value = match number {
            Number::Literal(value) => Ok(*value),
            Number::Expression(expression) => expression.evaluate(|name| self.names.get(name).copied()),
        };
        let value = value.map_err(|fault| match &fault {
            Fault::DivisionByZero => fault.to_string(),
            Fault::NotFinite => format!("{fault}; allowed: {range}"),
            Fault::UnknownName(name) => format!("{fault}; {}", choices(name, self.names.keys().map(String::as_str))),
        });
        value.and_then(|value| range.check(value)).map_err(|what| self.fault(field, what))
    }

    /// The values of both numbers, each in `range`.
    pub(super) fn pair(&self, field: impl fmt::Display, pair: &Pair, range: Range) -> Result<DVec2, SceneError> {
        let x = self.number(format_args!("{field}.x"), &pair.0, range)?;
        let y = self.number(format_args!("{field}.y"), &pair.1, range)?;
        Ok(DVec2::new(x, y))
    }
}
