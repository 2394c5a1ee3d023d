//! A document under a stopwatch: does what a session does with it, and notes what that costs.

use std::time::{Duration, Instant};

use espalier_growth::{Observer, Phase};
use espalier_mesh::{RingTable, Style};
use espalier_proto::{Command, Problem};
use espalier_session::{Document, Principal, delta, style_options, whole};

use super::stats::{self, PhaseSeconds, Stats};
use crate::recipe::{Gardener, GrowError};

/// A document and what it has cost so far.
#[derive(Debug)]
pub struct Bench {
    document: Document,
    table: RingTable,
    style: Style,
    /// Whether a client is in step.
    followed: bool,
    sequence: u32,
    started: Instant,
    /// Rows that there were before anything grew: those of a file, and seeds.
    taken: usize,
    /// Memory held before anything grew.
    held_before: Option<u64>,
    phases: Stopwatch,
    delta: Duration,
    delta_bytes: u64,
    steps: u32,
    last_step: Duration,
}

impl Bench {
    /// The clock begins to run.
    pub fn new(document: Document) -> Self {
        Self {
            style: Style::new(style_options(&document.parameters())),
            taken: document.plant().metamer_count(),
            document,
            table: RingTable::new(),
            followed: true,
            sequence: 0,
            started: Instant::now(),
            held_before: stats::resident_memory_bytes(),
            phases: Stopwatch::default(),
            delta: Duration::ZERO,
            delta_bytes: 0,
            steps: 0,
            last_step: Duration::ZERO,
        }
    }

    /// With nobody to make deltas for: what is held and how long it takes are those of growth alone.
    pub fn unfollowed(mut self) -> Self {
        self.followed = false;
        self
    }

    /// The document, to draw.
    pub fn document_mut(&mut self) -> &mut Document {
        &mut self.document
    }

    /// Does a command with all its steps; after each step a client would get a delta.
    pub fn apply(&mut self, command: &Command) -> Result<(), Problem> {
        self.document.begin(&Principal::visitor(), command)?;
        self.follow();
        loop {
            let (began, before) = (Instant::now(), self.document.plant().step());
            let advanced = self.document.advance_observed(&mut self.phases);
            self.phases.stop();
            if !advanced {
                return self.document.take_outcome();
            }
            if self.document.plant().step() != before {
                self.follow();
                self.steps += 1;
                self.last_step = began.elapsed();
            }
        }
    }

    /// The figures up to now.
    pub fn stats(&mut self) -> Stats {
        let seconds_total = self.started.elapsed().as_secs_f64();
        let held = stats::resident_memory_bytes().zip(self.held_before);
        if !self.followed || self.sequence == 0 {
            // Leaves are counted where they are drawn.
            self.table.sync(self.document.portrait(), &self.style, self.sequence);
        }
        let figures = self.document.figures();
        let rows = self.document.plant().metamer_count();
        let taken = self.taken.min(rows);
        // Seeds are rows as well, but nothing that grew.
        let metamers_in = |rows: std::ops::Range<usize>| -> u32 {
            rows.filter(|&row| self.table.parent(row as u32).is_some()).count() as u32
        };
        let tree_memory_bytes = held.map(|(now, before)| now.saturating_sub(before));
        let metamers = f64::from(figures.metamers.max(1));
        let of = |phase: Phase| self.phases.total(phase).as_secs_f64();
        Stats {
            metamers_alive: figures.metamers,
            metamers_taken: metamers_in(0..taken),
            metamers_grown: metamers_in(taken..rows),
            axes: figures.axes,
            leaves: self.table.leaves(),
            steps: self.steps,
            seconds_total,
            seconds_last_step: self.last_step.as_secs_f64(),
            seconds: PhaseSeconds {
                space: of(Phase::Space),
                light: of(Phase::Light),
                vigor: of(Phase::Vigor),
                growth: of(Phase::Growth),
                shedding: of(Phase::Shedding),
                girth: of(Phase::Girth),
                delta: self.delta.as_secs_f64(),
            },
            delta_bytes: self.delta_bytes,
            peak_memory_bytes: stats::peak_memory_bytes(),
            tree_memory_bytes,
            bytes_per_metamer: tree_memory_bytes.map(|bytes| bytes as f64 / metamers),
            seconds_export: None,
            plant_hash: format!("{:016x}", self.document.plant().hash()),
            // After memory has been looked at, for it is not what growth takes.
            join_bytes: self.join_bytes(),
        }
    }

    /// What somebody would get who joins now.
    fn join_bytes(&self) -> u64 {
        if self.followed { whole(&self.table, 0, self.sequence).encode().len() as u64 } else { 0 }
    }

    /// Makes the frame that a client in step would get.
    fn follow(&mut self) {
        let began = Instant::now();
        let options = style_options(&self.document.parameters());
        if options != *self.style.options() {
            self.style = Style::new(options);
        }
        if !self.followed {
            return;
        }
        let sequence = self.sequence + 1;
        let changes = self.table.sync(self.document.portrait(), &self.style, sequence);
        if !changes.is_empty() {
            self.sequence = sequence;
            self.delta_bytes += delta(&self.table, &changes, 0, sequence).encode().len() as u64;
        }
        self.delta += began.elapsed();
    }
}

impl Gardener for Bench {
    fn document(&self) -> &Document {
        &self.document
    }

    fn act(&mut self, command: &Command) -> Result<(), GrowError> {
        Ok(self.apply(command)?)
    }
}

/// Adds up the time spent in each phase of a step.
#[derive(Debug, Default)]
struct Stopwatch {
    totals: Vec<(Phase, Duration)>,
    running: Option<(Phase, Instant)>,
}

impl Stopwatch {
    fn total(&self, phase: Phase) -> Duration {
        self.totals.iter().find(|(known, _)| *known == phase).map_or(Duration::ZERO, |&(_, total)| total)
    }

    fn stop(&mut self) {
        let Some((phase, began)) = self.running.take() else { return };
        match self.totals.iter_mut().find(|(known, _)| *known == phase) {
            Some((_, total)) => *total += began.elapsed(),
            None => self.totals.push((phase, began.elapsed())),
        }
    }
}

impl Observer for Stopwatch {
    fn enter(&mut self, phase: Phase) {
        self.stop();
        self.running = Some((phase, Instant::now()));
    }
}

#[cfg(test)]
mod tests {
    use espalier_proto::{Action, Steps};

    use super::*;

    fn grown(steps: u32) -> Bench {
        let mut bench = Bench::new(Document::new(3));
        bench.apply(&Action::Grow { steps: Steps::nearest(steps), until: None, bud: None }.into()).unwrap();
        bench
    }

    #[test]
    fn what_was_grown_is_counted() {
        let mut bench = grown(12);
        let stats = bench.stats();
        assert_eq!(stats.steps, 12);
        assert!(stats.metamers_alive > 12 && stats.metamers_grown >= stats.metamers_alive);
        assert!(stats.leaves > 0 && stats.axes > 0);
        // A row travels in some bytes, even compressed.
        assert!(stats.delta_bytes > u64::from(stats.metamers_alive), "{}", stats.delta_bytes);
    }

    #[test]
    fn without_deltas_the_same_grows() {
        let mut alone = Bench::new(Document::new(3)).unfollowed();
        alone.apply(&Action::Grow { steps: Steps::nearest(12), until: None, bud: None }.into()).unwrap();
        let (alone, followed) = (alone.stats(), grown(12).stats());
        assert_eq!((alone.delta_bytes, alone.seconds.delta), (0, 0.0));
        assert_eq!(alone.join_bytes, 0);
        assert!(followed.join_bytes > 0 && followed.join_bytes < followed.delta_bytes);
        assert!(followed.delta_bytes > 0 && followed.seconds.delta > 0.0);
        assert_eq!(alone.plant_hash, followed.plant_hash);
        assert_eq!((alone.leaves, alone.metamers_grown), (followed.leaves, followed.metamers_grown));
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_metamer_takes_some_memory() {
        let stats = grown(40).stats();
        let (all, each) = (stats.tree_memory_bytes.unwrap(), stats.bytes_per_metamer.unwrap());
        assert!(all > 0 && each > 0.0 && each * f64::from(stats.metamers_alive) <= 1.01 * all as f64);
    }

    #[test]
    fn every_phase_takes_its_time() {
        let stats = grown(20).stats();
        let seconds = &stats.seconds;
        let phases =
            [seconds.space, seconds.light, seconds.vigor, seconds.growth, seconds.shedding, seconds.girth];
        assert!(phases.iter().all(|&seconds| seconds > 0.0), "{seconds:?}");
        let sum: f64 = phases.iter().sum::<f64>() + seconds.delta;
        assert!(sum <= stats.seconds_total, "{sum} of {}", stats.seconds_total);
        assert!(stats.seconds_last_step > 0.0 && stats.seconds_last_step < stats.seconds_total);
    }

    #[test]
    fn going_back_in_time_is_no_step() {
        let mut bench = grown(5);
        let hash = bench.stats().plant_hash;
        bench.apply(&Action::Ungrow { steps: Steps::nearest(2) }.into()).unwrap();
        assert_eq!(bench.stats().steps, 5);
        assert_ne!(bench.stats().plant_hash, hash);
        bench.apply(&Action::Redo {}.into()).unwrap();
        assert_eq!(bench.stats().plant_hash, hash);
    }

    #[test]
    fn a_refused_action_changes_nothing() {
        let mut bench = Bench::new(Document::new(1));
        let hash = bench.stats().plant_hash;
        assert!(bench.apply(&Action::Undo {}.into()).is_err());
        assert_eq!(bench.stats().plant_hash, hash);
    }
}
