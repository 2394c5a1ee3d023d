//! The extended Borchert-Honda model (Pałubicki et al. 2009 §4.2; TreeSketch §3.2 "Shoot growth").
//!
//! Light flows down: each bud puts in Q = bL^κ. Vigor flows up: v = α·Q at the base, and at each node the main
//! axis gets λQ_m against (1−λ)Q_l for the laterals, which share theirs in proportion to Q.

use espalier_settings::VigorModel;

use crate::parameters::Parameters;

/// Steps of Q = 1. Sums of whole numbers are exact, so the order in which branches are added does not matter.
pub(crate) const UNIT: f64 = (1u64 << 32) as f64;

/// A bud's input in steps of 1/[`UNIT`].
#[inline]
pub(crate) fn quantised(input: f32) -> u64 {
    (f64::from(input) * UNIT) as i64 as u64
}

/// Internodes that an enabled bud adds, the most vigorous of all having `greatest`.
///
/// n = ⌊v / v_max · n_max⌋ (TreeSketch §3.2). Under the priority model vigor counts as it is, n = ⌊v⌋ (Pałubicki
/// et al. 2009): it concentrates at every order of branching, and relative to the greatest the trunk's would
/// always lose. There too the best bud adds one internode at least, so that the brush works in the shade.
pub(crate) fn shoot_length(vigor: f64, greatest: f64, parameters: &Parameters) -> u32 {
    let longest = f64::from(parameters.max_shoot_length);
    let length = match parameters.vigor_model {
        VigorModel::BorchertHonda => vigor / greatest * longest,
        VigorModel::Priority => vigor / greatest.min(1.0),
    };
    length.min(longest) as u32
}

/// Light that flows down into one node, in steps of 1/[`UNIT`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    /// From what continues the metamer: its successor or its axis' bud.
    pub main: u64,
    /// From the laterals at its node.
    pub lateral: u64,
}

impl Sums {
    /// Light from everything above.
    pub(crate) fn light(self) -> u64 {
        self.main + self.lateral
    }
}

/// How one node splits its vigor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    main: f64,
    /// Vigor for each unit of λ-weighted light.
    rate: f64,
    lambda: f64,
}

impl Split {
    /// The split of so much vigor, at a node that gets so much light, under this apical control λ.
    #[inline]
    pub(crate) fn new(vigor: f64, sums: Sums, lambda: f64) -> Self {
        let (main, laterals) = (sums.main as i64 as f64, sums.lateral as i64 as f64);
        let all = lambda * main + (1.0 - lambda) * laterals;
        let rate = if all > 0.0 { vigor / all } else { 0.0 };
        Self { main, rate, lambda }
    }

    /// Vigor that goes on along the axis.
    #[inline]
    pub(crate) fn to_main(self) -> f64 {
        self.rate * self.lambda * self.main
    }

    /// Vigor that goes to a lateral that brings so much light.
    #[inline]
    pub(crate) fn to_lateral(self, light: u64) -> f64 {
        self.rate * (1.0 - self.lambda) * light as i64 as f64
    }
}
