//! Which rules the simulation grows by.

/// Version of the simulation's arithmetic: it rises when the same commands would give another plant.
pub const SIMULATION_VERSION: u32 = 5;

/// The version that is at work: [`SIMULATION_VERSION`], but in a test that has asked for the next one.
pub fn simulation_version() -> u32 {
    SIMULATION_VERSION + u32::from(is_next())
}

/// Goes into every random draw, so that other rules draw otherwise.
pub(crate) fn salt() -> u64 {
    if is_next() { 0x6a09_e667_f3bc_c908 } else { 0 }
}

#[cfg(not(feature = "next-simulation"))]
const fn is_next() -> bool {
    false
}

#[cfg(feature = "next-simulation")]
pub use self::next::{is_next, use_next_simulation};

/// A simulation that is still to come, for tests of upgrading: one process has the old rules and the new ones.
#[cfg(feature = "next-simulation")]
mod next {
    use core::sync::atomic::{AtomicBool, Ordering};

    static IS_NEXT: AtomicBool = AtomicBool::new(false);

    /// Whether the next simulation is at work.
    pub fn is_next() -> bool {
        IS_NEXT.load(Ordering::Relaxed)
    }

    /// From now on everything in this process grows by the next simulation, or by the present one again.
    pub fn use_next_simulation(is_next: bool) {
        IS_NEXT.store(is_next, Ordering::Relaxed);
    }
}
