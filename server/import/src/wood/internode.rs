//! How long an internode is in a file that does not say so.

use espalier_settings::{Kind, ParameterValues};
use glam::DVec3;

use super::{WoodOptions, pieces::Piece};

/// By how much an internode is longer than it must be for all wood to lie within reach.
const SPARE: f64 = 1.001;

/// Between which lengths the parameter lies, in metres.
pub(super) fn range() -> [f32; 2] {
    let row = ParameterValues::ROWS.iter().find(|row| row.name == "internode_length");
    match row.map(|row| row.kind) {
        Some(Kind::Number { least, most, .. }) => [least, most],
        _ => [ParameterValues::default().internode_length; 2],
    }
}

/// The median of the lengths of all pieces, of an even number the longer one in the middle, to four digits: where axes
/// are chains of internodes that is theirs. It is within the range of the parameter, and longer where the wood would
/// else lie out of reach or become too many nodes. Where no piece has a length, the parameter's default.
pub(super) fn length(pieces: &[Piece], origin: DVec3, options: &WoodOptions) -> f32 {
    let [least, most] = range();
    let each = |piece: &Piece| piece.length(pieces).filter(|length| length.is_finite() && *length > 0.0);
    let mut lengths: Vec<f64> = pieces.iter().filter_map(each).collect();
    let middle = lengths.len() / 2;
    if lengths.is_empty() {
        return ParameterValues::default().internode_length;
    }
    let (_, &mut median, _) = lengths.select_nth_unstable_by(middle, f64::total_cmp);
    // What was written is a number.
    let median: f64 = format!("{median:.3e}").parse().unwrap_or(median);
    let places = pieces.iter().flat_map(|piece| piece.start.into_iter().chain([piece.end]));
    let far = places.map(|place| (place - origin).abs().max_element()).filter(|far| far.is_finite());
    let far = far.fold(0.0, f64::max);
    let mut length = median.max(SPARE * far / f64::from(options.extent)).clamp(least.into(), most.into());
    let count = |length: f64| -> f64 {
        let parts =
            |piece: &Piece| if piece.is_whole { 1.0 } else { each(piece).map_or(0.0, |of| cut(of / length)) };
        pieces.iter().map(parts).sum()
    };
    while length < f64::from(most) && count(length) > options.nodes as f64 {
        length = (2.0 * length).min(most.into());
    }
    length as f32
}

/// Into how many nodes a piece of so many internodes is cut.
pub(super) fn cut(internodes: f64) -> f64 {
    internodes.round().max(1.0)
}
