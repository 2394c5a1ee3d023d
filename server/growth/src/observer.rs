//! Someone who watches a step from outside, with a clock the simulation must not have.

/// The parts of a step, in the order of TreeSketch §3.2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Markers are sown, removed, and associated with buds.
    Space,
    /// Light is read at every node.
    Light,
    /// Vigor is distributed (Borchert-Honda).
    Vigor,
    /// Branches that do not pay are shed.
    Shedding,
    /// Shoots grow and cast their shadows.
    Growth,
    /// Girth follows.
    Girth,
}

/// Receives each phase as it begins.
pub trait Observer {
    /// A phase begins; the one before has ended.
    fn enter(&mut self, phase: Phase);
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn enter(&mut self, _: Phase) {}
}
