//! One line of a CSV kind, with its fields by column name.

use super::error::VectorError;
use super::lines::Line;
use crate::case::{parse_bits, parse_hex};
use crate::names::Named;
use crate::quote::quoted;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// The fields of one line.
#[derive(Debug)]
pub(crate) struct Row<'a> {
    columns: &'static str,
    values: Vec<&'a str>,
    line: Line<'a>,
}

impl<'a> Row<'a> {
    pub(crate) fn new(line: Line<'a>, columns: &'static str) -> Result<Self, VectorError> {
        let values: Vec<_> = line.text.split(',').collect();
        let (expected, found) = (columns.split(',').count(), values.len());
        if expected == found {
            return Ok(Self { columns, values, line });
        }
        let message = format!("a row has {expected} fields ({columns}), not {found}");
        // The first missing column, or the last one if there are too many fields.
        let field = columns.split(',').nth(found.min(expected - 1)).unwrap_or_default();
        Err(line.error(field, message))
    }

    pub(crate) fn error(&self, column: &'static str, message: impl Into<String>) -> VectorError {
        self.line.error(column, message)
    }

    pub(crate) fn line(&self) -> u64 {
        self.line.place.line
    }

    /// The line as it was read.
    pub(crate) fn text(&self) -> String {
        self.line.text.to_owned()
    }

    pub(crate) fn field(&self, column: &'static str) -> Result<&'a str, VectorError> {
        let at = self.columns.split(',').position(|known| known == column);
        at.map(|at| self.values[at]).ok_or_else(|| self.error(column, "not a column of this kind"))
    }

    pub(crate) fn named<T: Named>(&self, column: &'static str) -> Result<T, VectorError> {
        T::from_name(self.field(column)?).map_err(|error| self.error(column, error.to_string()))
    }

    pub(crate) fn number<T: FromStr>(&self, column: &'static str) -> Result<T, VectorError> {
        let text = self.field(column)?;
        decimal(text)
            .ok_or_else(|| self.error(column, format!("{} is not a number in range", quoted(text))))
    }

    pub(crate) fn number_in<T: FromStr + PartialOrd + std::fmt::Display>(
        &self,
        column: &'static str,
        range: RangeInclusive<T>,
    ) -> Result<T, VectorError> {
        let number = self.number(column)?;
        if range.contains(&number) {
            return Ok(number);
        }
        let (low, high) = (range.start(), range.end());
        Err(self.error(column, format!("{number} is not in {low}..={high}")))
    }

    /// A 64-bit digest.
    pub(crate) fn digest(&self, column: &'static str) -> Result<u64, VectorError> {
        let text = self.field(column)?;
        parse_hex(text, 16).ok_or_else(|| {
            self.error(column, format!("{} is not a digest of 16 hex digits", quoted(text)))
        })
    }

    /// A list of binary32 numbers by their bit patterns.
    pub(crate) fn floats(&self, column: &'static str) -> Result<Vec<f32>, VectorError> {
        let words: Vec<_> =
            self.field(column)?.split(' ').filter(|word| !word.is_empty()).collect();
        parse_bits(&words).map_err(|error| self.error(column, error.message))
    }
}

/// A decimal number without a plus sign; `parse` by itself would accept one.
pub(crate) fn decimal<T: FromStr>(text: &str) -> Option<T> {
    text.parse().ok().filter(|_| !text.starts_with('+'))
}
