//! What a module is known by from step to step, and the chance that belongs to it.

use espalier_plant::hash::StableHash;

/// What a key or a draw is for.
const AXIOM: u64 = 1;
const PRODUCT: u64 = 2;
const READING: u64 = 3;
const PIECE: u64 = 4;
const DRAW: u64 = 5;

fn hash(purpose: u64, words: [u64; 2]) -> StableHash {
    let mut hash = StableHash::default();
    hash.word(words[0].wrapping_add(purpose << 60));
    hash.word(words[1]);
    hash
}

fn child(mut of: StableHash, number: usize) -> u64 {
    of.word(number as u64);
    of.finish()
}

/// The key of a module of the axiom.
pub(crate) fn axiom(number: usize) -> u64 {
    child(hash(AXIOM, [0, 0]), number)
}

/// The keys of what one module becomes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Products(StableHash);

impl Products {
    /// By a rule, in a step; `pass` counts how often rules have acted on it in that step.
    pub fn of_rule(key: u64, step: u32, pass: u32) -> Self {
        Self(hash(PRODUCT, [key, u64::from(step) << 32 | u64::from(pass)]))
    }

    /// When it is read as other modules.
    pub fn of_reading(key: u64, level: u32) -> Self {
        Self(hash(READING, [key, u64::from(level)]))
    }

    pub fn key(self, number: usize) -> u64 {
        child(self.0, number)
    }
}

/// The key of a piece of an internode that is drawn in several; the first has that of the whole.
pub(crate) fn piece(key: u64, number: usize) -> u64 {
    if number == 0 { key } else { child(hash(PIECE, [key, 0]), number) }
}

/// The numbers that fall to a module in a step, one after another. Those of other modules do not change them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chance {
    seed: u32,
    key: u64,
    step: u32,
    count: u32,
}

/// In place of a step: what is drawn while a word is read is the same in every step.
pub(crate) const WHILE_READING: u32 = u32::MAX;

impl Chance {
    pub fn new(seed: u32, key: u64, step: u32) -> Self {
        Self { seed, key, step, count: 0 }
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        let base = hash(DRAW, [self.key, u64::from(self.seed) | u64::from(self.step) << 32]);
        let bits = child(base, self.count as usize);
        self.count += 1;
        (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Of mean 0 and deviation 1.
    pub fn normal(&mut self) -> f64 {
        let (one, other) = (1.0 - self.unit(), self.unit());
        (-2.0 * libm::log(one)).sqrt() * libm::cos(std::f64::consts::TAU * other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chance_fills_the_unit_interval_evenly() {
        let mut bins = [0u32; 16];
        let (mut sum, mut squares) = (0.0, 0.0);
        for key in 0..4096 {
            let mut chance = Chance::new(1, key, 3);
            bins[(chance.unit() * 16.0) as usize] += 1;
            let normal = chance.normal();
            sum += normal;
            squares += normal * normal;
        }
        // 256 are expected in each; six standard deviations are about 93.
        assert!(bins.iter().all(|n| (163..349).contains(n)), "{bins:?}");
        assert!((sum / 4096.0).abs() < 0.1 && (squares / 4096.0 - 1.0).abs() < 0.15, "{sum} {squares}");
    }

    #[test]
    fn other_keys_steps_and_seeds_draw_otherwise() {
        let draw = |seed, key, step| Chance::new(seed, key, step).unit();
        let first = draw(1, 2, 3);
        assert_eq!(first, draw(1, 2, 3));
        assert!([draw(2, 2, 3), draw(1, 3, 3), draw(1, 2, 4)].iter().all(|other| *other != first));
    }
}
