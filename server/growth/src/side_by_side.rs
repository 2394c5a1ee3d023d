//! Work that several threads can do, and the choice whether they do.
//!
//! A second thread is worth something only while a processor is free for it: where it is kept waiting amid a piece of
//! work, everybody waits for it. That cannot be known, but measured, with a clock that whoever runs the simulation
//! [hands over](use_clock). What comes out is the same either way, and the measurements are no part of a simulation.

mod pace;

use std::{
    sync::{Mutex, OnceLock, PoisonError},
    time::Duration,
};

use rayon::prelude::*;

use self::pace::{Pace, Way};

type Clock = fn() -> Duration;

/// Fewer pieces are not worth another thread.
const LEAST_PIECES: usize = if cfg!(test) { 2 } else { 8 };

static CLOCK: OnceLock<Clock> = OnceLock::new();

/// Hands over a clock for the whole process: the time since some moment, always the same one. With it the simulation
/// finds out whether more threads than one are worth it; without, all threads of the pool do what is large. The first
/// that is handed over counts. Plants do not depend on it.
pub fn use_clock(clock: fn() -> Duration) {
    // A clock is there already: any one will do.
    let _ = CLOCK.set(clock);
}

#[cfg(not(test))]
fn clock() -> Option<Clock> {
    CLOCK.get().copied()
}

#[cfg(test)]
use tests::clock;

/// One kind of work, with what has been measured of it in this process.
pub(crate) struct Work {
    /// Fewer items are not worth another thread, nor a look at the clock.
    least: usize,
    pace: Mutex<Pace>,
}

impl Work {
    /// Work that is worth sharing from this many items on.
    pub(crate) const fn new(least: usize) -> Self {
        Self { least: if cfg!(test) { 4 } else { least }, pace: Mutex::new(Pace::new()) }
    }

    /// Begins a run with so many items.
    pub(crate) fn begin(&self, items: usize) -> Run<'_> {
        let has_threads = rayon::current_num_threads() > 1 || cfg!(test);
        if items < self.least || !has_threads {
            return Run { work: self, items, way: Way::Alone, began: None };
        }
        let Some(clock) = clock() else {
            return Run { work: self, items, way: Way::Shared, began: None };
        };
        let way = self.with_pace(|pace| pace.choose(items));
        #[cfg(test)]
        tests::chosen(way);
        Run { work: self, items, way, began: Some((clock, clock())) }
    }

    /// A run that has one piece after another.
    pub(crate) fn each<P: Send, R: Send>(
        &self,
        items: usize,
        pieces: impl Iterator<Item = P>,
        work: impl Fn(P) -> R + Send + Sync,
    ) -> Vec<R> {
        let run = self.begin(items);
        let results = run.each(pieces, work);
        run.end();
        results
    }

    /// A run that has two parts.
    pub(crate) fn both<A: Send, B: Send>(
        &self,
        items: usize,
        one: impl FnOnce() -> A + Send,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        let run = self.begin(items);
        let results = run.both(one, other);
        run.end();
        results
    }

    fn with_pace<T>(&self, with: impl FnOnce(&mut Pace) -> T) -> T {
        with(&mut self.pace.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Work that has begun.
#[must_use = "it is measured when it ends"]
pub(crate) struct Run<'a> {
    work: &'a Work,
    items: usize,
    way: Way,
    /// A clock, and when it began by that, if it is measured.
    began: Option<(Clock, Duration)>,
}

impl Run<'_> {
    /// Whether several threads work.
    pub(crate) fn is_shared(&self) -> bool {
        self.way == Way::Shared
    }

    /// What comes of pieces of work, in their order. Small pieces are best: the last is waited for.
    pub(crate) fn each<P: Send, R: Send>(
        &self,
        pieces: impl Iterator<Item = P>,
        work: impl Fn(P) -> R + Send + Sync,
    ) -> Vec<R> {
        match self.way {
            Way::Alone => pieces.map(work).collect(),
            Way::Shared => {
                let pieces: Vec<P> = pieces.collect();
                if pieces.len() < LEAST_PIECES {
                    return pieces.into_iter().map(work).collect();
                }
                pieces.into_par_iter().with_max_len(1).map(work).collect()
            }
        }
    }

    /// What comes of two parts.
    pub(crate) fn both<A: Send, B: Send>(
        &self,
        one: impl FnOnce() -> A + Send,
        other: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        match self.way {
            Way::Alone => (one(), other()),
            Way::Shared => rayon::join(one, other),
        }
    }

    /// Sorts values no two of which are equal.
    pub(crate) fn sort<T: Ord + Send>(&self, values: &mut [T]) {
        match self.way {
            Way::Alone => values.sort_unstable(),
            Way::Shared => values.par_sort_unstable(),
        }
    }

    /// Ends it.
    pub(crate) fn end(self) {
        if let Some((clock, began)) = self.began {
            let took = clock().saturating_sub(began).as_nanos() as f64;
            self.work.with_pace(|pace| pace.took(self.items, self.way, took));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::{NoObserver, ParameterValues, Parameters, Simulation, StepInput};

    thread_local! {
        /// Where this is set, this thread has a clock that goes by fits and starts.
        static MOMENT: Cell<Option<u64>> = const { Cell::new(None) };
        /// Runs of this thread that were chosen to go alone, and those that were shared.
        static CHOSEN: Cell<(u32, u32)> = const { Cell::new((0, 0)) };
    }

    /// Each thread has a clock of its own here, or none.
    pub(super) fn clock() -> Option<Clock> {
        MOMENT.get().map(|_| fits_and_starts as Clock)
    }

    pub(super) fn chosen(way: Way) {
        let (alone, shared) = CHOSEN.get();
        CHOSEN.set(match way {
            Way::Alone => (alone + 1, shared),
            Way::Shared => (alone, shared + 1),
        });
    }

    fn fits_and_starts() -> Duration {
        let moment = MOMENT.get().unwrap_or_default();
        let leap = moment.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 44;
        MOMENT.set(Some(moment + leap + 1));
        Duration::from_nanos(moment)
    }

    #[test]
    fn both_ways_give_the_same_in_the_same_order() {
        let work = Work::new(0);
        let ways = [Way::Alone, Way::Shared].map(|way| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("a pool");
            pool.install(|| {
                let run = Run { work: &work, items: 100, way, began: None };
                let pieces: Vec<usize> = (0..100).collect();
                let sums = run.each(pieces.chunks(7), |piece| piece.iter().sum::<usize>());
                let mut numbers: Vec<u64> = (0..10_000).map(|n| n * 7919 % 10_007).collect();
                run.sort(&mut numbers);
                assert!(numbers.is_sorted());
                (sums, run.both(|| 1, || "two"))
            })
        });
        assert_eq!(ways[0], ways[1]);
        assert_eq!((ways[0].0.len(), ways[0].0[1], ways[0].1), (15, 70, (1, "two")));
    }

    #[test]
    fn what_is_small_has_no_need_of_a_clock() {
        let work = Work::new(4);
        MOMENT.set(Some(1));
        for (items, is_measured) in [(3, false), (4, true)] {
            let run = work.begin(items);
            assert_eq!(run.began.is_some(), is_measured, "{items}");
            assert!(!run.is_shared(), "the first time it goes alone");
            run.end();
        }
        MOMENT.set(None);
        assert!(work.begin(4).is_shared(), "without a clock what is large is shared");
    }

    /// What grows in fourteen steps from one seed and in some more after going back, and which ways it went.
    fn grown(moment: Option<u64>) -> (u64, (u32, u32)) {
        MOMENT.set(moment);
        CHOSEN.set((0, 0));
        let values = ParameterValues { shedding_threshold: 0.1, ..ParameterValues::default() };
        let mut simulation = Simulation::new(1, Parameters::new(values).expect("in range"));
        let input = StepInput { autonomous: true, ..StepInput::default() };
        let step = |simulation: &mut Simulation, times| {
            (0..times).for_each(|_| drop(simulation.step(&input, &mut NoObserver)));
        };
        step(&mut simulation, 14);
        simulation.go_to(9);
        step(&mut simulation, 6);
        MOMENT.set(None);
        (simulation.plant().hash(), CHOSEN.get())
    }

    #[test]
    fn plants_do_not_depend_on_the_way() {
        let expected = grown(None).0;
        let mut ways = (0, 0);
        for threads in [1, 2, 8] {
            for moment in [1, 1 << 20, 1 << 40] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
                let (hash, (alone, shared)) = pool.install(|| grown(Some(moment)));
                assert_eq!(hash, expected, "{threads} threads, from {moment}");
                ways = (ways.0 + alone, ways.1 + shared);
            }
        }
        assert!(ways.0 > 50 && ways.1 > 50, "alone and shared {ways:?}");
    }
}
