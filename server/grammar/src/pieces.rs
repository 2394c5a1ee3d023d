//! What drawing loses: lines that are too short to be internodes of their own, and organs that stand on no wood.

use espalier_plant::organs::MOST_ORGANS;

use crate::{
    derivation::Derivation,
    diagnostic::{Diagnostic, Severity},
    grammar::{Grammar, Rule},
    symbols::{Action, turtle},
    wood::Drawn,
    wording,
};

/// So many lines may be joined without a word.
const FEW: usize = 100;
/// And one of so many.
const PART: usize = 2;

impl Grammar {
    /// A warning, at the axiom, where many lines of a plant are too short to be internodes: what scale would make the
    /// mean line one internode long.
    pub fn tiny_pieces(&self, derivation: &Derivation, drawn: &Drawn) -> Option<Diagnostic> {
        // Where wood lengthens its newest lines are short whatever the scale.
        let lengthens = |rule: &Rule| {
            let draws = turtle(rule.symbol).is_some_and(|row| row.action == Action::Draw);
            draws && rule.successor.iter().any(|module| module.symbol == rule.symbol)
        };
        let is_young = self.rules.iter().any(lengthens);
        if is_young || drawn.joined < FEW || drawn.joined * PART < drawn.lines {
            return None;
        }
        let nodes = &drawn.wood.nodes;
        let length = |node: &espalier_plant::WoodNode| {
            node.parent.map_or(0.0, |parent| f64::from(node.end.distance(nodes[parent as usize].end)))
        };
        let mean = nodes.iter().map(length).sum::<f64>() / drawn.lines as f64;
        let scale = two_digits(derivation.program().scale / mean)?;
        let (line, column) = self.axiom_at;
        let values = [
            ("depth", derivation.depth().to_string()),
            ("count", drawn.joined.to_string()),
            ("all", drawn.lines.to_string()),
            ("scale", scale),
        ];
        Some(Diagnostic::new(Severity::Warning, (line, column, 0), wording::TINY_PIECES, values.into()))
    }
}

impl Grammar {
    /// A warning, at the axiom, where organs are not drawn because no wood bears them, or as many are there as can be.
    pub fn lost_organs(&self, derivation: &Derivation, drawn: &Drawn) -> Option<Diagnostic> {
        let (line, column) = self.axiom_at;
        let values = [
            ("depth", derivation.depth().to_string()),
            ("count", drawn.unborne.to_string()),
            ("most", MOST_ORGANS.to_string()),
        ];
        let warning =
            || Diagnostic::new(Severity::Warning, (line, column, 0), wording::LOST_ORGANS, values.into());
        (drawn.unborne > 0).then(warning)
    }
}

/// A number above 0 with its first two digits, as people write it.
fn two_digits(value: f64) -> Option<String> {
    if !value.is_finite() || value <= 0.0 {
        return None;
    }
    let unit = libm::pow(10.0, libm::floor(libm::log10(value)) - 1.0);
    let rounded = libm::round(value / unit) * unit;
    let decimals = (-libm::floor(libm::log10(unit))).clamp(0.0, 12.0) as usize;
    let text = format!("{rounded:.decimals$}");
    Some(if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_short_numbers() {
        let written = |value| two_digits(value).unwrap_or_default();
        let found = [1.0, 12.3, 0.0347, 4567.0, 0.5, 99.9, 1e-9].map(written);
        assert_eq!(found, ["1", "12", "0.035", "4600", "0.5", "100", "0.000000001"]);
        assert_eq!(two_digits(f64::INFINITY), None);
    }
}
