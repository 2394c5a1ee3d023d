//! What grows a scene: growth does, and grammars and design graphs can.

use espalier_plant::{MetamerId, TimeShift};

use crate::{brush::StrokeId, observer::Observer, scene::Scene};

/// Something that grows the plants of a [`Scene`] step by step.
///
/// It reads light, free space and obstacles from the scene, changes the plants in
/// [one recorded step](Scene::record_growth) at a time, and keeps whatever else it needs itself. Equal scenes, states
/// and inputs give equal steps, bit for bit, on any number of threads. One step takes no longer than a person may wait,
/// for a session lets others have their turn between steps only.
pub trait Generator {
    /// What guides one step.
    type Input;

    /// Grows the scene by one step. One in which nothing happens leaves no trace on the timeline.
    fn step(&mut self, scene: &mut Scene, input: &Self::Input, observer: &mut impl Observer) -> StepOutcome;

    /// Brings what is kept about the scene up to date after somebody else has changed it.
    fn follow(&mut self, scene: &Scene, change: &Change);
}

/// What has happened to a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Wood was cut, moved, grafted, sown or grown by another generator, or obstacles stand otherwise.
    Edited,
    /// The plants went to another time.
    Travelled(TimeShift),
}

/// What a step brought about.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StepOutcome {
    /// Metamers added.
    pub metamers_grown: u32,
    /// Buds that had markers to grow towards.
    pub buds_enabled: u32,
    /// Whose the metamers are where several strokes guided the step, or some of them grew by themselves beside a stroke;
    /// otherwise empty.
    pub shares: Vec<Share>,
}

/// Metamers born one after the other, from the first to that of the next share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// The first of them.
    pub first: MetamerId,
    /// The stroke that drew them; none for what grew by itself.
    pub stroke: Option<StrokeId>,
}
