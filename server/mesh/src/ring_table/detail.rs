//! How much of the plant a table shows.

/// Light that changed by less is not shown: every shadow moves a little in every step, and nobody sees it.
const LIGHT_STEP: u8 = 8;
/// The same for vigor, of 16 levels in the high four bits.
const VIGOR_STEP: u8 = 2 << 4;
/// The same while the plant changes all the time.
const COARSE_LIGHT_STEP: u8 = 32;
const COARSE_VIGOR_STEP: u8 = 5 << 4;
/// Codes of radii that differ by less are not shown then; each is a hundredth more than the one before.
pub(super) const COARSE_RADIUS: u16 = 6;

/// How much of what older wood looks like is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Where it is, and whether it lives.
    Form,
    /// What differs by much as well.
    Coarse,
    /// All that can be seen.
    Whole,
}

impl Detail {
    /// By how much light and vigor differ at least where they are shown.
    pub(super) fn steps(self) -> (u8, u8) {
        match self {
            Self::Form | Self::Coarse => (COARSE_LIGHT_STEP, COARSE_VIGOR_STEP),
            Self::Whole => (LIGHT_STEP, VIGOR_STEP),
        }
    }
}
