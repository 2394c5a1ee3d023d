//! Probabilities that are learned while bits go by, from what was usual in other sessions onwards.

use std::sync::LazyLock;

use super::{bits::Contexts, field::Field, range_coder::WHOLE};

/// What was usual: a line for each field in the order of [`Field::ALL`], a letter for each of its contexts.
pub const PRIORS: &str = include_str!("../../priors.txt");

/// What a line of [`PRIORS`] is written in, besides [`UNSEEN`]: the letter in the middle, of number 31, is for bits that
/// are 0 as often as 1.
pub const LETTERS: &[u8; 63] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+";
/// The letter of a context that hardly was seen.
pub const UNSEEN: u8 = b'.';
/// Of 65,536 bits in a context, so many are 0, for the letters from number 31 on; for those before it, at the same
/// distance, so many are 1.
pub const LEVELS: [u16; 32] = [
    32768, 37138, 41355, 45287, 48839, 51954, 54617, 56846, 58677, 60159, 61343, 62281, 63018, 63593, 64040,
    64386, 64653, 64858, 65017, 65138, 65231, 65303, 65357, 65399, 65431, 65456, 65475, 65489, 65500, 65509,
    65515, 65520,
];

/// A context that was seen before counts as if so many bits had gone by.
pub const SEEN_BEFORE: u8 = 14;
/// A probability goes on moving as if no more bits had gone by.
pub const MOST_SEEN: u8 = 60;

/// All contexts as a frame begins with them.
static USUAL: LazyLock<(Contexts, Vec<Model>)> = LazyLock::new(|| {
    let contexts = Contexts::new();
    let letters: Vec<u8> = PRIORS.lines().flat_map(str::bytes).collect();
    assert_eq!(letters.len(), contexts.count, "priors.txt has a letter for each context");
    let models = letters.into_iter().map(Model::usual).collect();
    (contexts, models)
});

/// Where the contexts of each field begin.
pub(super) fn contexts() -> &'static Contexts {
    &USUAL.0
}

/// How likely a bit is 0, and how much was seen of it.
#[derive(Clone, Copy, Debug)]
struct Model {
    /// In so many cases of 65,536.
    zero: u16,
    seen: u8,
}

impl Model {
    fn usual(letter: u8) -> Self {
        let Some(at) = LETTERS.iter().position(|&other| other == letter) else {
            return Self { zero: LEVELS[0], seen: 0 };
        };
        let middle = LEVELS.len() - 1;
        let zero = if at >= middle { LEVELS[at - middle] } else { 0u16.wrapping_sub(LEVELS[middle - at]) };
        Self { zero, seen: SEEN_BEFORE }
    }

    /// In cases of [`WHOLE`], never impossible and never certain.
    fn zero(self) -> u32 {
        ((u32::from(self.zero) * WHOLE) >> 16).max(1)
    }

    /// Moves by 1/(seen + 1.5) of the way towards what has come.
    fn learn(&mut self, bit: bool) {
        let share = (2 << 16) / (2 * u32::from(self.seen) + 3);
        let zero = u32::from(self.zero);
        self.zero =
            if bit { zero - ((zero * share) >> 16) } else { zero + (((65_536 - zero) * share) >> 16) } as u16;
        self.seen = (self.seen + 1).min(MOST_SEEN);
    }
}

/// The models of one frame.
#[derive(Clone, Debug)]
pub(super) struct Models(Vec<Model>);

impl Models {
    pub(super) fn usual() -> Self {
        Self(USUAL.1.clone())
    }

    /// In how many cases of [`WHOLE`] the next bit in a context is 0.
    pub(super) fn zero(&self, context: usize) -> u32 {
        self.0[context].zero()
    }

    pub(super) fn learn(&mut self, context: usize, bit: bool) {
        self.0[context].learn(bit);
    }
}

/// How often each context saw each bit: what [`PRIORS`] is made from.
#[derive(Clone, Debug)]
pub struct Tally(pub(super) Vec<[u64; 2]>);

impl Default for Tally {
    fn default() -> Self {
        Self(vec![[0; 2]; Contexts::new().count])
    }
}

impl Tally {
    /// Contexts that saw fewer bits say nothing.
    const LEAST: u64 = 4;

    /// Adds what another has counted.
    pub fn add(&mut self, other: &Self) {
        for (mine, others) in self.0.iter_mut().zip(&other.0) {
            mine.iter_mut().zip(others).for_each(|(mine, others)| *mine += others);
        }
    }

    /// What to write into `proto/priors.txt`.
    pub fn priors(&self) -> String {
        let mut counts = self.0.iter();
        let mut lines = String::new();
        for field in Field::ALL {
            let letters = counts.by_ref().take(field.contexts());
            lines.extend(letters.map(|&[zeros, ones]| Self::letter(zeros, ones)));
            lines.push('\n');
        }
        lines
    }

    fn letter(zeros: u64, ones: u64) -> char {
        if zeros + ones < Self::LEAST {
            return UNSEEN.into();
        }
        let middle = LEVELS.len() - 1;
        // A little of each, so that what never came is not impossible.
        let share = |count: u64| (65_536.0 * (count as f64 + 0.4) / ((zeros + ones) as f64 + 0.8)) as u32;
        let nearest = |share: u32| {
            let distance = |level: usize| share.abs_diff(u32::from(LEVELS[level]));
            (0..LEVELS.len()).min_by_key(|&level| distance(level)).unwrap_or(0)
        };
        let at = if zeros >= ones { middle + nearest(share(zeros)) } else { middle - nearest(share(ones)) };
        LETTERS[at].into()
    }
}
