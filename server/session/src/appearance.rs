//! Changes of looks in range.

use espalier_proto::Problem;
use espalier_settings::{Appearance, AppearancePatch};

/// Fields of an appearance, all in range: those to change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct AppearanceChange(AppearancePatch);

impl AppearanceChange {
    /// Checks every range; a problem names section and field.
    pub(crate) fn parse(patch: &AppearancePatch) -> Result<Self, Problem> {
        // What a patch does not set is as in the appearance it is laid over, which is in range.
        Appearance::default().patched(patch).check().map_err(|error| error.within("appearance"))?;
        Ok(Self(*patch))
    }

    /// The looks of a tree as a whole, all but what surrounds it and the wind.
    pub(crate) fn of_tree(looks: &Appearance) -> AppearancePatch {
        AppearancePatch { background: None, wind: None, ..(*looks).into() }
    }

    /// An appearance with these fields put in.
    pub(crate) fn applied_to(&self, now: &Appearance) -> Appearance {
        now.patched(&self.0)
    }
}
