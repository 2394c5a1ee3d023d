//! What is kept of a simulation.

use std::collections::BTreeMap;

use crate::{
    brush::StrokeId, enclosure::Enclosure, guide::Guide, markers::Marker, obstacles::Obstacle,
    parameters::Parameters,
};

/// Everything the next step of growth depends on beside the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationState {
    /// Seed of all randomness.
    pub seed: u32,
    /// The parameters.
    pub parameters: Parameters,
    /// Markers of brush and lasso still alive.
    pub markers: Vec<Marker>,
    /// Paths of strokes in progress.
    pub guides: BTreeMap<StrokeId, Guide>,
    /// Envelopes being grown into.
    pub enclosures: Vec<Enclosure>,
    /// What stands in the way.
    pub obstacles: Vec<Obstacle>,
    /// Metamers the scene may hold.
    pub metamer_budget: u32,
    /// Steps ever begun, those included in which nothing grew: the age of markers and the key of their sowing.
    pub tick: u32,
}
