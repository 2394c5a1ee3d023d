//! One subtree: how its leaves come together at its root.
//!
//! In logarithms u of radii, da Vinci's rule is u = ln Σ exp(n·u_i) / n. It holds at every metamer of a subtree
//! if its exponent n solves g(n) = ln Σ exp(-n·y_i) = 0, where y_i is how much thicker in logarithms the root is
//! than leaf i. g is convex and falls, and by Jensen's inequality its root lies beyond n₀ = ln M / mean(y) for M
//! leaves: Newton's method from there is monotone, and one step suffices for equal leaves.
//!
//! A root that is too thin for every exponent gets the largest, and nothing above is thicker than it. To one that
//! is too thick, as on wood without forks, sizes swell along the way from the smallest.

/// Exponents that are used: with smaller ones forks swell into clubs, with larger ones wood forgets its twigs.
const EXPONENTS: [f64; 2] = [1.0, 8.0];
/// Four iterations are usual.
const MOST_ITERATIONS: u32 = 64;
const TOLERANCE: f64 = 1e-12;

/// What a subtree bears; sizes are logarithms of radii.
pub(super) struct Leaves {
    /// How many leaves are tips of twigs: they are equal, so they are counted.
    pub tips: u32,
    /// Size of those.
    pub twig: f64,
    /// Sizes of the constrained metamers among the leaves.
    pub others: Vec<f64>,
}

/// A solved subtree.
#[derive(Debug)]
pub(super) struct Fit {
    exponent: f64,
    twig: f64,
    /// Weights are powers of ratios to this size, so that they neither overflow nor vanish.
    reference: f64,
    weight_of_tip: f64,
    /// Size of the root, which nothing exceeds even if it is too thin for da Vinci's rule.
    most: f64,
    /// Added along the way to a root that is too thick for it.
    swelling: f64,
}

impl Leaves {
    fn count(&self) -> f64 {
        f64::from(self.tips) + self.others.len() as f64
    }

    fn thickest(&self) -> f64 {
        let twig = if self.tips > 0 { self.twig } else { f64::NEG_INFINITY };
        self.others.iter().copied().fold(twig, f64::max)
    }

    /// Sums over all leaves of exp(n·(size - reference)), and of the same times root - size.
    fn sums(&self, exponent: f64, reference: f64, root: f64) -> [f64; 2] {
        let weight = |size: f64| libm::exp(exponent * (size - reference));
        let tips = f64::from(self.tips) * weight(self.twig);
        let first = [tips, tips * (root - self.twig)];
        self.others.iter().fold(first, |[sum, moment], &size| {
            let weight = weight(size);
            [sum + weight, moment + weight * (root - size)]
        })
    }
}

impl Fit {
    /// A subtree whose root is as thick as its leaves make it.
    pub(super) fn by_exponent(leaves: &Leaves, exponent: f64) -> Self {
        let reference = leaves.thickest().max(leaves.twig);
        let weight_of_tip = libm::exp(exponent * (leaves.twig - reference));
        Self { exponent, twig: leaves.twig, reference, weight_of_tip, most: f64::INFINITY, swelling: 0.0 }
    }

    /// A subtree whose root has a size, which that of no leaf exceeds.
    pub(super) fn to_root(leaves: &Leaves, root: f64) -> Self {
        let [least, most] = EXPONENTS;
        let reference = leaves.thickest();
        let size_at =
            |exponent: f64| reference + libm::log(leaves.sums(exponent, reference, root)[0]) / exponent;
        let count = leaves.count();
        if count <= 1.0 || size_at(least) <= root {
            let swelling = if count > 0.0 { root - size_at(least) } else { 0.0 };
            return Self { most: root, swelling: swelling.max(0.0), ..Self::by_exponent(leaves, least) };
        }
        let exponent = if size_at(most) >= root { most } else { exponent(leaves, reference, root) };
        Self { most: root, ..Self::by_exponent(leaves, exponent) }
    }

    /// Whether sizes depend on the way to the root (see [`super::taper`]).
    pub(super) fn tapers(&self) -> bool {
        self.swelling > 0.0
    }

    /// Size of wood that bears only so many tips, of which ln is given; `rise` is 0 at leaves and 1 at the root.
    pub(super) fn of_tips(&self, log_tips: f32, rise: f32) -> f32 {
        self.placed(self.twig + f64::from(log_tips) / self.exponent, rise)
    }

    /// What a constrained leaf adds to the sums of those below.
    pub(super) fn weight(&self, size: f64) -> f64 {
        libm::exp(self.exponent * (size - self.reference))
    }

    /// Size of wood that bears tips, and constrained leaves of a sum of weights.
    pub(super) fn of_sum(&self, tips: u32, sum: f64, rise: f32) -> f32 {
        let sum = f64::from(tips) * self.weight_of_tip + sum;
        self.placed(self.reference + libm::log(sum) / self.exponent, rise)
    }

    fn placed(&self, size: f64, rise: f32) -> f32 {
        (size + self.swelling * f64::from(rise)).min(self.most) as f32
    }
}

/// The root of g, which lies between the least and the most.
fn exponent(leaves: &Leaves, reference: f64, root: f64) -> f64 {
    let of_tips = f64::from(leaves.tips) * (root - leaves.twig);
    let mean = leaves.others.iter().fold(of_tips, |sum, size| sum + root - size) / leaves.count();
    let [least, most] = EXPONENTS;
    let mut exponent = (libm::log(leaves.count()) / mean).clamp(least, most);
    for _ in 0..MOST_ITERATIONS {
        let [sum, moment] = leaves.sums(exponent, reference, root);
        let value = libm::log(sum) - exponent * (root - reference);
        let step = value * sum / moment;
        exponent = (exponent + step).clamp(least, most);
        if step.abs() <= TOLERANCE * exponent {
            break;
        }
    }
    exponent
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leaves(tips: u32, twig: f64, others: &[f64]) -> Leaves {
        let log = |radius: &f64| libm::log(*radius);
        Leaves { tips, twig: log(&twig), others: others.iter().map(log).collect() }
    }

    #[test]
    fn equal_tips_have_the_exponent_of_the_formula() {
        // ln M / (ln d_b - ln d_e): ln 100 / ln 10.
        let leaves = leaves(100, 0.1, &[]);
        let root = libm::log(1.0);
        assert!((exponent(&leaves, leaves.thickest(), root) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn leaves_of_many_sizes_add_up_to_the_root() {
        for (tips, others, root) in
            [(0, &[0.3, 0.4][..], 0.5), (1, &[1.0], 1.01), (5000, &[2.0, 2.0, 0.1], 2.9), (100_000, &[], 7.0)]
        {
            let leaves = leaves(tips, 0.05, others);
            let n = Fit::to_root(&leaves, libm::log(root)).exponent;
            let power = |radius: f64| libm::pow(radius / root, n);
            let sum = f64::from(tips) * power(0.05) + others.iter().map(|&radius| power(radius)).sum::<f64>();
            assert!((sum - 1.0).abs() < 1e-9, "the sum is {sum} for n = {n}");
        }
        // 3² + 4² = 5²
        let n = Fit::to_root(&leaves(0, 0.05, &[0.3, 0.4]), libm::log(0.5)).exponent;
        assert!((n - 2.0).abs() < 1e-9);
    }

    #[test]
    fn exponents_stay_within_bounds() {
        let root = libm::log;
        let thin = Fit::to_root(&leaves(1000, 0.1, &[]), root(0.11));
        assert_eq!((thin.exponent, thin.tapers()), (8.0, false));
        assert_eq!(thin.of_tips(libm::logf(1000.0), 1.0), root(0.11) as f32);
        let thick = Fit::to_root(&leaves(10, 0.1, &[]), root(3.0));
        assert_eq!((thick.exponent, thick.tapers()), (1.0, true));
        assert!((thick.of_tips(libm::logf(10.0), 1.0) - root(3.0) as f32).abs() < 1e-6);
        assert!((thick.of_tips(libm::logf(10.0), 0.0) - root(1.0) as f32).abs() < 1e-6);
    }

    #[test]
    fn a_leaf_as_thick_as_the_root_leaves_no_room() {
        let fit = Fit::to_root(&leaves(7, 1e-6, &[4.0, 4.0]), libm::log(4.0));
        let size = fit.of_sum(7, fit.weight(libm::log(4.0)), 0.5);
        assert_eq!((size, fit.exponent), (libm::log(4.0) as f32, 8.0));
    }
}
