//! How far a scenario is, said on standard error now and then, so that whoever waits knows that something goes on.

use std::{
    io::{self, Write},
    time::Duration,
};

use tokio::time::Instant;

/// It is said no more often than this.
const PAUSE: Duration = Duration::from_secs(5);

/// Counts up to what there will be.
#[derive(Debug)]
pub struct Progress {
    what: &'static str,
    all: u32,
    done: u32,
    told_at: Instant,
}

impl Progress {
    /// Counts so many of these.
    pub fn of(all: u32, what: &'static str) -> Self {
        Self { what, all, done: 0, told_at: Instant::now() }
    }

    /// One more is there.
    pub fn count(&mut self) {
        self.done += 1;
        if self.told_at.elapsed() >= PAUSE {
            self.told_at = Instant::now();
            // Where nobody can read it, nobody waits for it.
            let _ = writeln!(io::stderr(), "{}", self.text());
        }
    }

    fn text(&self) -> String {
        format!("{} of {} {}", self.done, self.all, self.what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_says_how_many_are_done() {
        let mut progress = Progress::of(2000, "sockets are there");
        for _ in 0..7 {
            progress.count();
        }
        assert_eq!(progress.text(), "7 of 2000 sockets are there");
    }
}
