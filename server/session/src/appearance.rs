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

/// Sections of an appearance, all in range: those to change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AppearanceChange {
    /// The leaves.
    pub leaves: Option<LeafLook>,
    /// The flowers.
    pub flowers: Option<FlowerLook>,
    /// The fruits.
    pub fruits: Option<FruitLook>,
    /// The wood.
    pub bark: Option<BarkLook>,
    /// All around.
    pub background: Option<Background>,
}

impl AppearanceChange {
    /// Checks every range; a problem names section and field.
    pub(crate) fn parse(wire: &AppearancePatch) -> Result<Self, Problem> {
        let &AppearancePatch { leaves, flowers, fruits, bark, background } = wire;
        Ok(Self {
            leaves: section("leaves", leaves, LeafLook::check)?,
            flowers: section("flowers", flowers, FlowerLook::check)?,
            fruits: section("fruits", fruits, FruitLook::check)?,
            bark: section("bark", bark, BarkLook::check)?,
            background: section("background", background, Background::check)?,
        })
    }

    /// An appearance with these sections put in.
    pub(crate) fn applied_to(&self, now: &Appearance) -> Appearance {
        Appearance {
            leaves: self.leaves.unwrap_or(now.leaves),
            flowers: self.flowers.unwrap_or(now.flowers),
            fruits: self.fruits.unwrap_or(now.fruits),
            bark: self.bark.unwrap_or(now.bark),
            background: self.background.unwrap_or(now.background),
        }
    }
}

fn section<Wire: Across<Core>, Core>(
    name: &str,
    wire: Option<Wire>,
    check: impl Fn(&Core) -> Result<(), AppearanceError>,
) -> Result<Option<Core>, Problem> {
    let Some(wire) = wire else { return Ok(None) };
    let core = wire.across();
    check(&core).map_err(|error| {
        let problem = Problem {
            code: ProblemCode::OutOfRange,
            field: Some(error.name.to_owned()),
            message: error.to_string(),
            allowed: Some(error.allowed),
        };
        problem.within(&format!("appearance.{name}"))
    })?;
    Ok(Some(core))
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
