//! Documents of plants that grew elsewhere.

use std::{collections::BTreeMap, sync::Arc};

use espalier_growth::{Parameters, Simulation, SimulationState, transplant};
use espalier_plant::{BrokenPlant, Wood};
use espalier_proto::Problem;
use espalier_settings::{Appearance, OutOfRange, ParameterValues};

use super::{Document, Generators, generators::GeneratorState, history::History};

/// Wood cannot become a document.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransplantError {
    /// A parameter cannot be set.
    #[error("{}", Problem::from(.0.clone()))]
    Parameters(#[from] OutOfRange),
    /// Nodes and axes do not fit together.
    #[error(transparent)]
    Broken(#[from] BrokenPlant),
}

impl Document {
    /// A document of plants made of wood from elsewhere, which grow on by these parameters. Nothing can be undone;
    /// time goes back to the seeds.
    ///
    /// # Errors
    /// Where a parameter is out of range, or the wood does not fit together.
    pub fn transplanted(
        wood: &Wood,
        seed: u32,
        wanted: &ParameterValues,
        looks: Appearance,
    ) -> Result<Self, TransplantError> {
        let parameters = Parameters::new(wanted.clone())?;
        let plant = transplant(wood, &parameters)?;
        let mut document = Self::of(seed, parameters.clone());
        document.steps_begun = plant.step();
        let state = SimulationState {
            seed,
            parameters,
            markers: Vec::new(),
            guides: BTreeMap::new(),
            enclosures: Vec::new(),
            obstacles: Vec::new(),
            metamer_budget: document.simulation.scene().metamer_budget(),
            tick: plant.step(),
        };
        let schedule = Arc::clone(document.schedule());
        document.simulation = Simulation::from_state(plant, state)
            .grown_by(|growth| Generators::new(growth, schedule, GeneratorState::default()));
        document.appearance = Arc::new(looks);
        document.history = History::new(document.setting());
        Ok(document)
    }
}
