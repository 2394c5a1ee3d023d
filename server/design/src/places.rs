//! Where laterals stand along an axis: as many as the density adds up to, at even shares of it.

use crate::function::Function;

/// Intervals by which a density is added up.
const INTERVALS: usize = 64;
/// Most laterals of one axis.
pub const MOST_LATERALS: usize = 240;

/// The places of an axis' laterals.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    /// How many there are at one place.
    whorl: usize,
    /// How many places.
    count: usize,
    first: f32,
    last: f32,
    /// The density added up from the first place to the last.
    sums: [f32; INTERVALS + 1],
}

impl Places {
    pub(crate) fn of(density: &Function, (first, last): (f32, f32), whorl: usize) -> Self {
        let step = (last - first) / INTERVALS as f32;
        let at = |place: usize| density.at(first + step * place as f32).max(0.0);
        let mut sums = [0.0; INTERVALS + 1];
        for place in 1..=INTERVALS {
            sums[place] = sums[place - 1] + 0.5 * step * (at(place - 1) + at(place));
        }
        let whorl = whorl.max(1);
        let count = (sums[INTERVALS] / whorl as f32 + 0.5) as usize;
        Self { whorl, count: count.min(MOST_LATERALS / whorl), first, last, sums }
    }

    /// How many laterals there are.
    pub(crate) fn laterals(&self) -> usize {
        self.count * self.whorl
    }

    /// The share of the laterals below each lateral, in order.
    pub(crate) fn shares(&self) -> Vec<f32> {
        (0..self.laterals()).map(|lateral| self.share(lateral)).collect()
    }

    /// The share of the laterals below a lateral.
    pub(crate) fn share(&self, lateral: usize) -> f32 {
        (lateral / self.whorl + 1) as f32 / (self.count + 1) as f32
    }

    /// Which place a lateral stands at, and which of those there it is, as a share of a turn.
    pub(crate) fn place(&self, lateral: usize) -> (usize, f32) {
        (lateral / self.whorl, (lateral % self.whorl) as f32 / self.whorl as f32)
    }

    /// Where on the axis a share of its laterals is below.
    pub(crate) fn at(&self, share: f32) -> f32 {
        let wanted = share.clamp(0.0, 1.0) * self.sums[INTERVALS];
        let next = self.sums.partition_point(|&sum| sum < wanted).clamp(1, INTERVALS);
        let (below, above) = (self.sums[next - 1], self.sums[next]);
        let within = if above > below { (wanted - below) / (above - below) } else { 0.0 };
        self.first + (self.last - self.first) * ((next - 1) as f32 + within) / INTERVALS as f32
    }

    /// The share of the laterals below a place of the axis.
    pub(crate) fn share_at(&self, t: f32) -> f32 {
        let total = self.sums[INTERVALS];
        if total <= 0.0 || self.last <= self.first {
            return 0.5;
        }
        let place = ((t - self.first) / (self.last - self.first)).clamp(0.0, 1.0) * INTERVALS as f32;
        let interval = (place as usize).min(INTERVALS - 1);
        let (below, above) = (self.sums[interval], self.sums[interval + 1]);
        (below + (above - below) * (place - interval as f32)) / total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_density_gives_even_places() {
        let places = Places::of(&Function::constant(3.0), (0.0, 1.0), 1);
        let at: Vec<_> = places.shares().into_iter().map(|share| places.at(share)).collect();
        assert_eq!(at, [0.25, 0.5, 0.75]);
    }

    #[test]
    fn more_stand_where_the_density_is_greater() {
        let places = Places::of(&Function::line(0.0, 20.0), (0.0, 1.0), 1);
        let at: Vec<_> = places.shares().into_iter().map(|share| places.at(share)).collect();
        assert_eq!(at.len(), 10);
        assert!(at.iter().filter(|&&t| t > 0.5).count() >= 7, "{at:?}");
        for t in at {
            assert!((places.at(places.share_at(t)) - t).abs() < 1e-4);
        }
    }

    #[test]
    fn a_whorl_stands_at_one_place() {
        let places = Places::of(&Function::constant(7.0), (0.0, 1.0), 3);
        assert_eq!((places.laterals(), places.share(0), places.share(2)), (6, 1.0 / 3.0, 1.0 / 3.0));
        assert_eq!(places.place(4), (1, 1.0 / 3.0));
    }
}
