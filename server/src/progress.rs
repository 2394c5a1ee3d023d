//! How far long work on the command line is: on standard error, where it is a terminal that a person looks at.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// How often something turns while nothing is known.
const TURN: Duration = Duration::from_millis(100);

/// A bar that is gone from the terminal when it is dropped.
#[derive(Debug)]
pub struct Bar(ProgressBar);

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Bar {
    /// Counts things up to so many.
    pub fn of(all: usize, what: &'static str) -> Self {
        Self::styled(all as u64, "{bar:30} {pos} of {len} {msg}, {eta} left", what)
    }

    /// Counts bytes; how many there are is told with each report.
    pub fn of_bytes(what: &'static str) -> Self {
        Self::styled(0, "{bar:30} {bytes} of {total_bytes} {msg}", what)
    }

    /// Says at which stage something is, and counts the bytes of it; how many there will be nobody knows.
    pub fn counting(stage: &'static str) -> Self {
        let style = ProgressStyle::with_template("{spinner} {msg}: {bytes}, {elapsed}");
        let bar = ProgressBar::no_length().with_message(stage);
        let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        bar.enable_steady_tick(TURN);
        Self(bar)
    }

    /// The next stage has begun.
    pub fn stage(&self, stage: &'static str) {
        self.0.set_message(stage);
    }

    /// So many bytes more are there.
    pub fn count(&self, bytes: usize) {
        self.0.inc(bytes as u64);
    }

    /// The stage, and the bytes so far.
    #[cfg(test)]
    pub fn told(&self) -> (String, u64) {
        (self.0.message(), self.0.position())
    }

    /// Says what is done that takes nobody knows how long.
    pub fn turning(what: &'static str) -> Self {
        let bar = ProgressBar::new_spinner().with_message(what);
        bar.enable_steady_tick(TURN);
        Self(bar)
    }

    fn styled(all: u64, template: &str, what: &'static str) -> Self {
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        Self(ProgressBar::new(all).with_style(style).with_message(what))
    }

    /// Does something that prints, with the bar out of its way.
    pub fn aside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.0.suspend(print)
    }

    /// One more is done.
    pub fn step(&self) {
        self.0.inc(1);
    }

    /// So many of so many are done.
    pub fn report(&self, done: u64, all: u64) {
        self.0.set_length(all);
        self.0.set_position(done);
    }
}
