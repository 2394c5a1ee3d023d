//! What drawing needs to know beyond the plant.

use espalier_plant::Girth;

use crate::{dyes::RowDyes, radius_code::RadiusCodes};

/// The most leaves a node can bear: they are counted in four bits.
pub const MAX_LEAVES_PER_NODE: u8 = 15;

/// The values a [`Style`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StyleOptions {
    /// n of da Vinci's rule d^n = Σ d_i^n.
    pub girth_exponent: f32,
    /// Diameter of the thinnest twigs in internodes, d_e.
    pub twig_diameter: f32,
    /// Leaves on each node that bears leaves, at most [`MAX_LEAVES_PER_NODE`].
    pub leaves_per_node: u8,
    /// Middle length of a leaf in internodes.
    pub leaf_size: f32,
}

impl Default for StyleOptions {
    fn default() -> Self {
        Self { girth_exponent: 2.5, twig_diameter: 0.1, leaves_per_node: 3, leaf_size: 0.7 }
    }
}

/// How thick wood is, how many leaves it bears, and which branches have colours of their own.
#[derive(Clone, Debug)]
pub struct Style {
    options: StyleOptions,
    girth: Girth,
    radius_codes: RadiusCodes,
    dyes: RowDyes,
}

impl Style {
    /// Prepares the tables of radii.
    pub fn new(options: StyleOptions) -> Self {
        let girth = Girth::new(options.girth_exponent, options.twig_diameter);
        let radius_codes = RadiusCodes::new(&girth);
        let leaves_per_node = options.leaves_per_node.min(MAX_LEAVES_PER_NODE);
        Self {
            options: StyleOptions { leaves_per_node, ..options },
            girth,
            radius_codes,
            dyes: RowDyes::default(),
        }
    }

    /// The same with these colours of branches.
    pub fn dyed(self, dyes: RowDyes) -> Self {
        Self { dyes, ..self }
    }

    /// The colours that branches have of their own.
    pub fn dyes(&self) -> &RowDyes {
        &self.dyes
    }

    /// The values it was made from.
    pub fn options(&self) -> &StyleOptions {
        &self.options
    }

    /// Turns tips into radii.
    pub fn girth(&self) -> &Girth {
        &self.girth
    }

    /// The code of the radius of a metamer that carries so many tips.
    pub fn radius_code(&self, tips: u32) -> u16 {
        self.radius_codes.of_tips(&self.girth, tips)
    }
}

impl Default for Style {
    fn default() -> Self {
        Self::new(StyleOptions::default())
    }
}
