//! Figures as text that Prometheus and others read (version 0.0.4 of the format): a line of help, a line of type, a line for
//! each value. The format is smaller than any library for it, and all figures are read where they already stand.

use std::fmt::{Display, Write};

/// What a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It only rises, until the server starts anew.
    Counter,
    /// It rises and falls.
    Gauge,
}

/// Figures that are being written.
#[derive(Debug, Default)]
pub struct Figures(String);

/// A figure whose values are being written.
#[derive(Debug)]
pub struct Figure<'a> {
    text: &'a mut String,
    name: &'static str,
}

impl Figures {
    /// Begins a figure of this name, which no other has.
    pub fn figure(&mut self, kind: Kind, name: &'static str, help: &str) -> Figure<'_> {
        let kind = match kind {
            Kind::Counter => "counter",
            Kind::Gauge => "gauge",
        };
        // Writing to a text does not fail.
        let _ = writeln!(self.0, "# HELP {name} {}\n# TYPE {name} {kind}", escaped(help, false));
        Figure { text: &mut self.0, name }
    }

    /// A figure with one value.
    pub fn one(&mut self, kind: Kind, name: &'static str, help: &str, value: impl Display) {
        self.figure(kind, name, help).value(&[], value);
    }

    /// All of it.
    pub fn into_text(self) -> String {
        self.0
    }
}

impl Figure<'_> {
    /// A value, with what it is of.
    pub fn value(&mut self, of: &[(&str, &str)], value: impl Display) -> &mut Self {
        let labels: Vec<_> =
            of.iter().map(|(name, text)| format!("{name}=\"{}\"", escaped(text, true))).collect();
        let _ = match labels.is_empty() {
            true => writeln!(self.text, "{} {value}", self.name),
            false => writeln!(self.text, "{}{{{}}} {value}", self.name, labels.join(",")),
        };
        self
    }
}

fn escaped(text: &str, is_quoted: bool) -> String {
    let text = text.replace('\\', "\\\\").replace('\n', "\\n");
    if is_quoted { text.replace('"', "\\\"") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_written_as_prometheus_reads_them() {
        let mut figures = Figures::default();
        figures.one(Kind::Gauge, "espalier_sockets", "Sockets that are open.", 3);
        let mut slices = figures.figure(Kind::Counter, "espalier_slices_total", "Slices of work.");
        slices.value(&[("class", "drawing")], 5).value(&[("class", "a \"b\" \\ c\n")], 0.25);
        assert_eq!(
            figures.into_text(),
            "# HELP espalier_sockets Sockets that are open.\n\
             # TYPE espalier_sockets gauge\n\
             espalier_sockets 3\n\
             # HELP espalier_slices_total Slices of work.\n\
             # TYPE espalier_slices_total counter\n\
             espalier_slices_total{class=\"drawing\"} 5\n\
             espalier_slices_total{class=\"a \\\"b\\\" \\\\ c\\n\"} 0.25\n"
        );
    }
}
