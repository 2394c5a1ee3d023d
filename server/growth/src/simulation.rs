//! A scene and what grows it, kept in step with each other.

use std::collections::BTreeMap;

use espalier_plant::Plant;
use glam::Vec3;

use crate::{
    brush::StrokeId,
    generator::{Generator, StepOutcome},
    growth::Growth,
    guide::Guide,
    lasso::Envelope,
    markers::Marker,
    observer::Observer,
    parameters::Parameters,
    scene::{DEFAULT_METAMER_BUDGET, Scene},
    state::SimulationState,
};

/// A scene that grows. Whatever changes the scene from outside comes through here, so that the generator follows.
#[derive(Clone, Debug)]
pub struct Simulation<G = Growth> {
    pub(crate) scene: Scene,
    pub(crate) generator: G,
}

impl Simulation {
    /// A seedling: one seed at the origin.
    pub fn new(seed: u32, parameters: Parameters) -> Self {
        let state = SimulationState {
            seed,
            parameters,
            markers: Vec::new(),
            guides: BTreeMap::new(),
            enclosures: Vec::new(),
            obstacles: Vec::new(),
            metamer_budget: DEFAULT_METAMER_BUDGET,
            tick: 0,
        };
        Self::from_state(Plant::new(Vec3::ZERO), state)
    }

    /// Takes a plant up again.
    pub fn from_state(plant: Plant, mut state: SimulationState) -> Self {
        let obstacles = std::mem::take(&mut state.obstacles);
        let scene = Scene::new(plant, obstacles, state.metamer_budget, &state.parameters);
        let generator = Growth::from_state(&scene, state);
        Self { scene, generator }
    }

    /// The same scene, grown by this and more.
    pub fn grown_by<G>(self, more: impl FnOnce(Growth) -> G) -> Simulation<G> {
        Simulation { scene: self.scene, generator: more(self.generator) }
    }
}

impl<G: Generator> Simulation<G> {
    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The plant.
    pub fn plant(&self) -> &Plant {
        &self.scene.plant
    }

    /// What grows the scene.
    pub fn generator(&self) -> &G {
        &self.generator
    }

    /// The same, to be changed.
    pub fn generator_mut(&mut self) -> &mut G {
        &mut self.generator
    }

    /// One step. A step in which nothing grows or is shed leaves no trace.
    pub fn step(&mut self, input: &G::Input, observer: &mut impl Observer) -> StepOutcome {
        self.generator.step(&mut self.scene, input, observer)
    }

    /// Sets how many metamers the scene may hold.
    pub fn set_metamer_budget(&mut self, budget: u32) {
        self.scene.set_metamer_budget(budget);
    }

    /// Whether the last step had to stop at the budget.
    pub fn is_out_of_budget(&self) -> bool {
        self.scene.is_out_of_budget()
    }
}

/// What concerns growth, by itself or among other generators.
impl<G: Generator + AsRef<Growth> + AsMut<Growth>> Simulation<G> {
    /// What [`Simulation::from_state`] needs beside the plant.
    pub fn state(&self) -> SimulationState {
        let growth = self.generator.as_ref();
        SimulationState {
            seed: growth.seed,
            parameters: growth.parameters().clone(),
            markers: growth.markers().to_vec(),
            guides: growth.guides.clone(),
            enclosures: growth.enclosures.clone(),
            obstacles: self.scene.obstacles().to_vec(),
            metamer_budget: self.scene.metamer_budget,
            tick: growth.tick,
        }
    }

    /// Seed of all randomness.
    pub fn seed(&self) -> u32 {
        self.generator.as_ref().seed
    }

    /// The parameters in force.
    pub fn parameters(&self) -> &Parameters {
        self.generator.as_ref().parameters()
    }

    /// Markers of brush and lasso still alive.
    pub fn markers(&self) -> &[Marker] {
        self.generator.as_ref().markers()
    }

    /// Changes the parameters; growth from here on uses them.
    pub fn set_parameters(&mut self, parameters: Parameters) {
        self.generator.as_mut().set_parameters(&mut self.scene, parameters);
    }

    /// Forgets what guided growth so far: markers and strokes. Time travel and stroke ends call for it.
    pub fn drop_guidance(&mut self) {
        self.generator.as_mut().drop_guidance();
    }

    /// Lets growth fill an envelope: limbs lead through it, and markers are laid as growth comes near, above ground. One
    /// that would take more metamers than the scene has room for is made flatter.
    pub fn enclose(&mut self, envelope: &Envelope) {
        self.generator.as_mut().enclose(&self.scene, envelope);
    }

    /// Forgets the markers of envelopes, for nothing grows into them any more.
    pub fn drop_envelopes(&mut self) {
        self.generator.as_mut().drop_envelopes();
    }

    /// What guides growth along a stroke.
    pub fn guide(&self, stroke: StrokeId) -> Option<&Guide> {
        self.generator.as_ref().guide(stroke)
    }

    /// Forgets the path of one stroke.
    pub fn end_stroke(&mut self, stroke: StrokeId) {
        self.generator.as_mut().end_stroke(stroke);
    }

    /// Whether there is anything for a bud to grow towards: markers, path ahead of a leader, or a stroke that waits for
    /// one.
    pub fn has_guidance(&self) -> bool {
        self.generator.as_ref().has_guidance(&self.scene)
    }

    /// Writes light and vigor of the present into the plant's appearance, for whoever draws it. Growth itself has
    /// no use for it, and steps are many.
    pub fn show(&mut self) {
        self.generator.as_mut().show(&mut self.scene);
    }
}
