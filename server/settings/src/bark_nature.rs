//! How bark comes to its colours and its scale: for every client and every export.

use serde::Serialize;
use ts_rs::TS;

use crate::looks::BarkKind;

/// Radius in internodes of the thinnest limb whose bark has a scale of its own.
pub const THINNEST_BARK: f32 = 0.1;
/// Squares of bark around a limb of [`THINNEST_BARK`], of twice that radius, of four times, and so on: bark coarsens as
/// a limb thickens, and then there is more of it.
pub const BARK_SQUARES: [u8; 7] = [1, 1, 1, 2, 4, 6, 9];
/// Radii in internodes over which a twig comes to the colour of bark.
pub const BARK_BEGINS: [f32; 2] = [0.05, 0.24];
/// Radii in internodes over which a limb comes to the colour of a trunk.
pub const LIMB_ENDS: [f32; 2] = [0.25, 0.8];

/// A colour that comes from a bark's tint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct Mixture {
    /// What the tint is multiplied by.
    pub brightness: f32,
    /// What is mixed with it, linear.
    pub other: [f32; 3],
    /// How much of that.
    pub share: f32,
}

impl Mixture {
    /// The linear colour for a linear tint.
    pub fn of(&self, tint: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|i| tint[i] * self.brightness * (1.0 - self.share) + self.other[i] * self.share)
    }
}

/// The colours beside a bark's tint, which is that of a trunk's ridges.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, TS)]
pub struct BarkNature {
    /// Of what lies in the furrows.
    pub second: Mixture,
    /// Of what grows or shows on top.
    pub third: Mixture,
    /// Of twigs, before they have bark.
    pub young: Mixture,
    /// What limbs have for the tint.
    pub limb: Mixture,
}

impl BarkKind {
    /// Where this kind has its colours from.
    pub fn nature(self) -> BarkNature {
        let mixture = |brightness, other, share| Mixture { brightness, other, share };
        let same = mixture(1.0, [0.0; 3], 0.0);
        let nature = |second, third, young, limb| BarkNature { second, third, young, limb };
        match self {
            Self::Smooth => nature(
                mixture(0.8, [0.1, 0.12, 0.05], 0.6),
                mixture(1.12, [0.42, 0.44, 0.36], 0.3),
                mixture(0.7, [0.13, 0.095, 0.06], 0.5),
                same,
            ),
            Self::Furrowed => nature(
                mixture(0.34, [0.045, 0.032, 0.021], 0.5),
                mixture(1.0, [0.24, 0.28, 0.16], 0.6),
                mixture(0.75, [0.085, 0.07, 0.036], 0.55),
                same,
            ),
            Self::Plated => nature(
                mixture(1.05, [0.36, 0.14, 0.06], 0.55),
                mixture(0.24, [0.035, 0.022, 0.015], 0.5),
                mixture(0.9, [0.2, 0.115, 0.055], 0.5),
                // Fox-red where the plates came off.
                mixture(1.1, [0.37, 0.155, 0.07], 0.6),
            ),
            Self::Papery => nature(
                mixture(0.02, [0.02, 0.017, 0.015], 0.8),
                mixture(0.9, [0.55, 0.33, 0.2], 0.75),
                mixture(0.05, [0.085, 0.042, 0.03], 0.9),
                same,
            ),
            Self::Flaking => nature(
                mixture(1.4, [0.58, 0.51, 0.31], 0.7),
                mixture(0.75, [0.2, 0.175, 0.135], 0.7),
                mixture(0.8, [0.11, 0.09, 0.045], 0.5),
                mixture(1.2, [0.5, 0.45, 0.28], 0.35),
            ),
            Self::Banded => nature(
                mixture(1.7, [0.28, 0.17, 0.1], 0.55),
                mixture(0.25, [0.025, 0.014, 0.012], 0.4),
                mixture(0.9, [0.11, 0.05, 0.035], 0.5),
                same,
            ),
            Self::Stringy => nature(
                mixture(0.45, [0.13, 0.045, 0.022], 0.55),
                mixture(1.25, [0.36, 0.33, 0.28], 0.5),
                mixture(0.7, [0.1, 0.075, 0.035], 0.6),
                same,
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mixture_lies_between_the_tint_and_the_other_colour() {
        let mixture = Mixture { brightness: 0.5, other: [1.0, 0.0, 0.2], share: 0.25 };
        assert_eq!(mixture.of([0.4, 0.8, 0.0]), [0.4, 0.3, 0.05]);
        let tint = [0.3, 0.2, 0.1];
        assert_eq!(BarkKind::Smooth.nature().limb.of(tint), tint);
    }
}
