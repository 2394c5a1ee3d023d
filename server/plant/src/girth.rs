//! Girth by da Vinci's rule (TreeSketch §3.3): d^n = Σ d_i^n.
//!
//! All twig tips have the same diameter d_e, so a metamer that carries `t` tips has d^n = t·d_e^n. The plant
//! keeps `t`, a whole number: it can be added to and taken from for ever without an error. A branch that is
//! shed leaves its tips in the count of those below it, for wood once grown stays; pruning takes them off.

/// Turns tips into radii.
#[derive(Clone, Debug)]
pub struct Girth {
    inverse_exponent: f32,
    twig_radius: f32,
    /// Radii of the first few thousand counts: nearly all metamers are twigs.
    table: Vec<f32>,
}

const TABLE_LEN: u32 = 4096;

impl Girth {
    /// `exponent` is n, `twig_diameter` is d_e in internodes.
    pub fn new(exponent: f32, twig_diameter: f32) -> Self {
        let mut girth =
            Self { inverse_exponent: 1.0 / exponent, twig_radius: 0.5 * twig_diameter, table: Vec::new() };
        girth.table = (0..TABLE_LEN).map(|tips| girth.compute(tips)).collect();
        girth
    }

    /// Radius in internodes of a metamer that carries so many tips.
    pub fn radius(&self, tips: u32) -> f32 {
        self.table.get(tips as usize).copied().unwrap_or_else(|| self.compute(tips))
    }

    /// One divided by n.
    pub fn inverse_exponent(&self) -> f32 {
        self.inverse_exponent
    }

    /// Radius of a twig's tip in internodes, half of d_e.
    pub fn twig_radius(&self) -> f32 {
        self.twig_radius
    }

    fn compute(&self, tips: u32) -> f32 {
        self.twig_radius * libm::powf(tips as f32, self.inverse_exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cross_sections_add_up_at_exponent_two() {
        let girth = Girth::new(2.0, 0.1);
        let area = |tips| girth.radius(tips) * girth.radius(tips);
        assert!((area(3) + area(4) - area(7)).abs() < 1e-7);
        assert!((girth.radius(1) - 0.05).abs() < 1e-7);
        assert!((area(5000) + area(6000) - area(11000)).abs() < 1e-3);
    }
}
