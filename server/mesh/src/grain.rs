//! How finely wood is drawn, from that of the near view to that of a far one.

/// How finely wood is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// How far the flat sides of a tube may lie inside the round one, in internodes.
    pub(crate) chord_error: f32,
    /// Sides of the thickest tubes.
    pub(crate) most_sides: u32,
    /// Axes that begin thinner than so many of the thinnest twigs are left out.
    pub(crate) thinnest: f32,
    /// How far a ring that is left out may lie off the tube between its neighbours, in internodes.
    pub(crate) tolerance: f32,
}

impl Grain {
    /// Of each level of detail, the finest first.
    pub const LEVELS: [Self; 3] = [
        Self { chord_error: 0.01, most_sides: 24, thinnest: 0.0, tolerance: 0.0 },
        Self { chord_error: 0.03, most_sides: 10, thinnest: 1.5, tolerance: 0.03 },
        Self { chord_error: 0.1, most_sides: 5, thinnest: 4.0, tolerance: 0.12 },
    ];
}

impl Default for Grain {
    fn default() -> Self {
        Self::LEVELS[0]
    }
}
