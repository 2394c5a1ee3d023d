//! Appearances between the wire and the core.

use espalier_growth::appearance::{
    Appearance, AppearanceError, Background, BarkKind, BarkLook, FlowerKind, FlowerLook, FruitKind,
    FruitLook, Ground, LeafKind, LeafLook, Place, Sky,
};
use espalier_proto::{AppearancePatch, Problem, ProblemCode, appearance as wire};

use crate::across::{Across, enums, structs};

enums! {
    LeafKind = wire::LeafKind {
        Ovate, Round, Lanceolate, Lobed, Palmate, Fan, Compound, Needle, Scale,
    }
    Place = wire::Place { Tips, Twigs, Wood }
    FlowerKind = wire::FlowerKind { None, Rosette, Catkin, Panicle }
    FruitKind = wire::FruitKind { None, Round, Cone, Nut, Winged }
    BarkKind = wire::BarkKind { Smooth, Furrowed, Plated, Papery, Flaking, Banded, Stringy }
    Sky = wire::Sky { Meadow, Clear, Overcast, Studio }
    Ground = wire::Ground { Grass, Earth, Sand, Snow, Plain }
}

structs! {
    LeafLook = wire::LeafLook { shape, tint, vigor_shift, season, orientation }
    FlowerLook = wire::FlowerLook { kind, tint, size, share, place, vigor }
    FruitLook = wire::FruitLook { kind, tint, size, share, place, vigor }
    BarkLook = wire::BarkLook { kind, tint, relief, root_flare, collar, smoothing }
    Background = wire::Background { sky, ground, backdrop, sun_azimuth, sun_elevation }
    Appearance = wire::Appearance { leaves, flowers, fruits, bark, background }
}

/// Fields of an appearance, all in range: those to change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AppearanceChange(AppearancePatch);

impl AppearanceChange {
    /// Checks every range; a problem names section and field.
    pub(crate) fn parse(patch: &AppearancePatch) -> Result<Self, Problem> {
        // What a patch does not set is as in the appearance it is laid over, which is in range.
        let over: Appearance = wire::Appearance::default().patched(patch).across();
        within("leaves", over.leaves.check())?;
        within("flowers", over.flowers.check())?;
        within("fruits", over.fruits.check())?;
        within("bark", over.bark.check())?;
        within("background", over.background.check())?;
        Ok(Self(*patch))
    }

    /// The looks of a tree as a whole, all but what surrounds it.
    pub(crate) fn dressing(looks: &Appearance) -> Self {
        Self(AppearancePatch { background: None, ..to_proto(looks).into() })
    }

    /// An appearance with these fields put in.
    pub(crate) fn applied_to(&self, now: &Appearance) -> Appearance {
        to_proto(now).patched(&self.0).across()
    }
}

fn within(section: &str, checked: Result<(), AppearanceError>) -> Result<(), Problem> {
    checked.map_err(|error| {
        let problem = Problem {
            code: ProblemCode::OutOfRange,
            field: Some(error.name.to_owned()),
            message: error.to_string(),
            allowed: Some(error.allowed),
        };
        problem.within(&format!("appearance.{section}"))
    })
}

/// An appearance as it travels.
pub(crate) fn to_proto(appearance: &Appearance) -> wire::Appearance {
    (*appearance).across()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_begin_with_the_same_looks() {
        assert_eq!(to_proto(&Appearance::default()), wire::Appearance::default());
    }
}
