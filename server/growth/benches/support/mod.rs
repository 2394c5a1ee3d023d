//! What benches hand to the simulation, as the server does.

use std::{
    sync::LazyLock,
    time::{Duration, Instant},
};

/// Time since this was first asked.
pub fn passed() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGUN.elapsed()
}
