//! What files say about their plants.

use espalier_growth::Obstacle;
use espalier_settings::ParameterValues;
use serde_json::{Value, json};

use crate::ExportError;

/// What a file says about its plants, and what it has to know of them.
#[derive(Clone, Debug)]
pub struct About<'a> {
    /// The program and its version.
    pub program: &'a str,
    /// The version of the simulation that grew them.
    pub simulation: u32,
    /// The name of the species, if it is known.
    pub species: Option<&'a str>,
    /// The seed of all randomness, if it is known.
    pub seed: Option<u32>,
    /// The parameters in force; the length of an internode makes metres.
    pub parameters: &'a ParameterValues,
    /// What stands around them and takes the wind away.
    pub obstacles: &'a [Obstacle],
    /// Who made them.
    pub author: Option<&'a str>,
    /// Under which licence they may be used.
    pub licence: Option<&'a str>,
}

impl About<'_> {
    /// Metres of an internode.
    pub(crate) fn scale(&self) -> Result<f32, ExportError> {
        let scale = self.parameters.internode_length;
        if scale.is_finite() && scale > 0.0 { Ok(scale) } else { Err(ExportError::Scale(scale)) }
    }

    /// Everything that is known, as JSON.
    pub(crate) fn extras(&self) -> Value {
        let Self { simulation, species, seed, parameters, author, licence, .. } = self;
        let all = json!({
            "simulation": simulation,
            "species": species,
            "seed": seed,
            "metres_per_internode": parameters.internode_length,
            "parameters": parameters,
            "author": author,
            "licence": licence,
        });
        let Value::Object(mut all) = all else { return all };
        all.retain(|_, value| !value.is_null());
        Value::Object(all)
    }

    /// Author and licence in one line, if one of them is known.
    pub(crate) fn copyright(&self) -> Option<String> {
        let said: Vec<&str> = [self.author, self.licence].into_iter().flatten().collect();
        (!said.is_empty()).then(|| said.join(", "))
    }
}
