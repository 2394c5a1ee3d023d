//! Whether one kind of work is quicker on one thread or on several, learnt from how long it took.

/// Which threads work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// The calling thread.
    Alone,
    /// All threads of the pool.
    Shared,
}

impl Way {
    fn other(self) -> Self {
        match self {
            Self::Alone => Self::Shared,
            Self::Shared => Self::Alone,
        }
    }
}

/// Of the time that the better way takes, one part in so many may be lost by trying the other.
const TRYING: f64 = 128.0;
/// The share of the better way's time that a try is thought to cost at least, and that of a way nobody has tried yet: it is
/// tried soon.
const TRY_COSTS: (f64, f64) = (1.0 / 16.0, 1.0 / 32.0);
/// Sharing has to be quicker by this share, for the other threads may have something else to do.
const ADVANTAGE: f64 = 1.0 / 32.0;
/// How much the newest time of a way counts: that of the better one, which is measured often, and that of the other.
const NEWEST: (f64, f64) = (0.25, 0.5);
/// By this share of the difference a way that is not taken is thought to come nearer to the better one each time, so that
/// one bad moment is not held against it for ever.
const FORGIVING: f64 = 1.0 / 32.0;
/// A time that is so many times what was expected counts as that at most: a single one says little.
const SURPRISE: f64 = 2.0;
/// What is lost at one time counts as so many runs at most.
const GREATEST_LOSS: f64 = 8.0;
/// One for each power of two of the number of items.
const SIZES: usize = usize::BITS as usize;

/// Times of one kind of work. It is told durations and knows no clock.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    sizes: [Measured; SIZES],
    /// Nanoseconds that may be lost by trying; less than nothing when a try has cost more than it might.
    credit: f64,
}

/// Nanoseconds for each item, where it has been measured.
#[derive(Clone, Copy, Debug)]
struct Measured {
    alone: Option<f64>,
    shared: Option<f64>,
}

impl Measured {
    const NOTHING: Self = Self { alone: None, shared: None };

    fn of(&self, way: Way) -> Option<f64> {
        match way {
            Way::Alone => self.alone,
            Way::Shared => self.shared,
        }
    }

    fn set(&mut self, way: Way, each: f64) {
        match way {
            Way::Alone => self.alone = Some(each),
            Way::Shared => self.shared = Some(each),
        }
    }

    fn scale(&mut self, by: f64) {
        self.alone = self.alone.map(|each| each * by);
        self.shared = self.shared.map(|each| each * by);
    }

    fn is_nothing(&self) -> bool {
        self.alone.is_none() && self.shared.is_none()
    }

    fn better(&self) -> Way {
        match (self.alone, self.shared) {
            (Some(alone), Some(shared)) if shared < alone * (1.0 - ADVANTAGE) => Way::Shared,
            (None, Some(_)) => Way::Shared,
            _ => Way::Alone,
        }
    }

    /// What a try of the way that is not the better one is thought to cost, in nanoseconds for each item.
    fn costs_of_trying(&self) -> Option<f64> {
        let better = self.better();
        let least = self.of(better)?;
        Some(match self.of(better.other()) {
            Some(other) => (other - least).max(least * TRY_COSTS.0),
            None => least * TRY_COSTS.1,
        })
    }
}

impl Pace {
    pub(super) const fn new() -> Self {
        Self { sizes: [Measured::NOTHING; SIZES], credit: 0.0 }
    }

    /// The way that so many items should go.
    pub(super) fn choose(&self, items: usize) -> Way {
        let known = self.known(items);
        let better = known.better();
        match known.costs_of_trying() {
            Some(costs) if costs * items as f64 <= self.credit => better.other(),
            _ => better,
        }
    }

    /// Takes in that so many items, at least one, took so many nanoseconds this way.
    pub(super) fn took(&mut self, items: usize, way: Way, nanoseconds: f64) {
        let each = nanoseconds / items as f64;
        let mut known = self.known(items);
        let better = known.better();
        if way == better {
            // No more is saved up than one try may cost.
            self.credit = (self.credit + nanoseconds / TRYING).min(nanoseconds);
        } else if let (Some(least), Some(costs)) = (known.of(better), known.costs_of_trying()) {
            self.credit -= (each - least).max(costs).min(least * GREATEST_LOSS) * items as f64;
        }
        let is_first_of_size = self.sizes[size(items)].is_nothing();
        match known.of(way) {
            // Smaller ones have said how the two ways compare; this one says what its size costs.
            Some(before) if is_first_of_size => known.scale((each / before).min(SURPRISE)),
            Some(before) => {
                let newest = if way == better { NEWEST.0 } else { NEWEST.1 };
                known.set(way, before + (each.min(before * SURPRISE) - before) * newest);
            }
            None => known.set(way, each),
        }
        if let (true, Some(now), Some(other)) = (way == better, known.of(way), known.of(way.other())) {
            known.set(way.other(), other + (now - other).min(0.0) * FORGIVING);
        }
        self.sizes[size(items)] = known;
    }

    /// What is known of so many items, or else of the next smaller number of which anything is.
    fn known(&self, items: usize) -> Measured {
        let smaller = self.sizes[..=size(items)].iter().rev();
        smaller.copied().find(|measured| !measured.is_nothing()).unwrap_or(Measured::NOTHING)
    }
}

/// The power of two that a number of items reaches.
fn size(items: usize) -> usize {
    items.max(1).ilog2() as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Items of a run, and nanoseconds that it takes alone.
    const ITEMS: usize = 3000;
    const ALONE: f64 = 1e6;

    /// What runs have taken, as they were chosen.
    #[derive(Clone, Copy, Debug, Default)]
    struct Sum {
        nanoseconds: f64,
        shared: usize,
    }

    /// Goes this often; `shared` says how much longer a run takes on several threads than alone, by its number.
    fn go(pace: &mut Pace, times: usize, shared: impl Fn(usize) -> f64) -> Sum {
        let mut sum = Sum::default();
        for time in 0..times {
            let way = pace.choose(ITEMS);
            let took = match way {
                Way::Alone => ALONE,
                Way::Shared => ALONE * shared(time),
            };
            pace.took(ITEMS, way, took);
            sum.nanoseconds += took;
            sum.shared += usize::from(way == Way::Shared);
        }
        sum
    }

    #[test]
    fn the_first_goes_alone_and_the_quicker_way_is_found() {
        let mut pace = Pace::new();
        assert_eq!(pace.choose(ITEMS), Way::Alone);
        let first = go(&mut pace, 4, |_| 0.6);
        assert_eq!(first.shared, 0, "a way that nobody knows is tried once something may be lost");
        let next = go(&mut pace, 10, |_| 0.6);
        assert!(next.shared >= 6, "{next:?}");
        let later = go(&mut pace, 1000, |_| 0.6);
        assert!(later.shared >= 980, "{later:?}");
        assert!(later.shared < 1000, "now and then the other is tried");
    }

    #[test]
    fn what_is_slower_costs_one_in_a_hundred() {
        for slower in [1.02, 1.05, 1.16, 1.5, 2.0, 4.0, 10.0] {
            let sum = go(&mut Pace::new(), 1000, |_| slower);
            assert!(sum.nanoseconds < 1000.0 * ALONE * 1.015, "{slower}: {sum:?}");
            assert!(sum.shared > 0, "{slower}: it was never tried");
        }
    }

    #[test]
    fn stalls_now_and_then_are_counted() {
        // Quicker but for each fourth, with which it is slower on the whole.
        let sum = go(&mut Pace::new(), 1000, |time| if time % 4 == 0 { 4.0 } else { 0.8 });
        assert!(sum.nanoseconds < 1000.0 * ALONE * 1.03, "{sum:?}");
        let sum = go(&mut Pace::new(), 1000, |time| if time % 40 == 0 { 4.0 } else { 0.6 });
        assert!(sum.nanoseconds < 1000.0 * ALONE * 0.8, "{sum:?}");
    }

    #[test]
    fn a_change_is_noticed() {
        let mut pace = Pace::new();
        go(&mut pace, 200, |_| 0.6);
        let busy = go(&mut pace, 200, |_| 1.4);
        assert!(busy.shared < 12, "{busy:?}");
        go(&mut pace, 300, |_| 0.6);
        let quiet = go(&mut pace, 100, |_| 0.6);
        assert!(quiet.shared > 90, "{quiet:?}");
    }

    #[test]
    fn one_bad_moment_alone_is_forgiven() {
        let mut pace = Pace::new();
        go(&mut pace, 100, |_| 1.1);
        pace.took(ITEMS, Way::Alone, 4.0 * ALONE);
        go(&mut pace, 100, |_| 1.1);
        let later = go(&mut pace, 300, |_| 1.1);
        assert!(later.shared < 60, "{later:?}");
    }

    #[test]
    fn larger_runs_begin_with_what_smaller_ones_have_shown() {
        let mut pace = Pace::new();
        go(&mut pace, 100, |_| 0.6);
        assert_eq!(pace.choose(8 * ITEMS), Way::Shared);
        // Each item of a larger run costs more; the ways compare as before.
        pace.took(8 * ITEMS, Way::Shared, 8.0 * ALONE * 3.0);
        assert_eq!(pace.choose(8 * ITEMS), Way::Shared);
        assert_eq!(pace.choose(ITEMS / 8), Way::Alone, "of smaller ones nothing is known");
    }

    #[test]
    fn one_long_stall_is_not_held_against_sharing_for_ever() {
        let mut pace = Pace::new();
        for _ in 0..100 {
            pace.took(ITEMS, Way::Alone, ALONE);
        }
        pace.took(ITEMS, Way::Shared, 1000.0 * ALONE);
        let after = go(&mut pace, 2000, |_| 0.5);
        assert!(after.shared > 0, "{after:?}");
    }
}
