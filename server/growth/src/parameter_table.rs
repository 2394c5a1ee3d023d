//! Where growth looks its parameters up: once for the scene, and for each axis.

use espalier_plant::AxisId;

use crate::parameters::Parameters;

/// The parameters in force.
///
/// All axes share one set today. Growth asks per axis nevertheless, so that branches can have their own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterTable {
    shared: Parameters,
}

impl ParameterTable {
    /// The same parameters for every axis.
    pub fn new(shared: Parameters) -> Self {
        Self { shared }
    }

    /// Those of the scene: light, markers, girth.
    pub fn scene(&self) -> &Parameters {
        &self.shared
    }

    /// The farthest any bud perceives.
    pub(crate) fn farthest_perception(&self) -> f32 {
        self.shared.perception_radius()
    }

    /// Those with the widest perception angle of all.
    pub(crate) fn widest_perception(&self) -> &Parameters {
        &self.shared
    }

    /// Those of one axis: everything about its buds and shoots.
    pub fn of(&self, _axis: AxisId) -> &Parameters {
        &self.shared
    }
}
