//! Long lists of numbers in text.

use std::{fmt::Display, io::Write};

use crate::ExportError;

/// A list that is being written.
pub(super) struct Array<'a> {
    out: &'a mut dyn Write,
    is_begun: bool,
}

impl<'a> Array<'a> {
    /// Begins one with its type and name.
    pub(super) fn begin(out: &'a mut dyn Write, name: &str) -> Result<Self, ExportError> {
        write!(out, "{name} = [")?;
        Ok(Self { out, is_begun: false })
    }

    /// Begins one that holds at a time.
    pub(super) fn begin_key(out: &'a mut dyn Write, time: usize) -> Result<Self, ExportError> {
        write!(out, "{time}: [")?;
        Ok(Self { out, is_begun: false })
    }

    pub(super) fn put(&mut self, item: impl Display) -> Result<(), ExportError> {
        let between = if self.is_begun { ", " } else { "" };
        self.is_begun = true;
        Ok(write!(self.out, "{between}{item}")?)
    }

    pub(super) fn vector(&mut self, parts: &[f32]) -> Result<(), ExportError> {
        self.put(joined(parts))
    }

    /// Ends it; what is known of the list follows.
    pub(super) fn end(self, suffix: &str) -> Result<(), ExportError> {
        Ok(writeln!(self.out, "]{suffix}")?)
    }
}

/// A vector in parentheses.
pub(super) fn joined(parts: &[f32]) -> String {
    let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
    format!("({})", parts.join(", "))
}
