//! How a tree and its surroundings look. Part of the document, and changes nothing of what grows.
//!
//! Ranges are checked where an appearance becomes part of a document; `PROTOCOL.md` lists them (`AP1`).

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Forms of leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum LeafKind {
    /// Egg-shaped.
    Ovate,
    /// Nearly as broad as long, on a long stalk.
    Round,
    /// Long and narrow.
    Lanceolate,
    /// With round lobes.
    Lobed,
    /// Like a hand.
    Palmate,
    /// A fan.
    Fan,
    /// Many leaflets on one stalk.
    Compound,
    /// Tufts of needles; evergreen.
    Needle,
    /// Scales that hide the twig; evergreen.
    Scale,
}

/// Where flowers and fruits are borne.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// At the ends of shoots.
    Tips,
    /// All along the leafy twigs.
    Twigs,
    /// On older wood without leaves.
    Wood,
}

/// Forms of flowers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum FlowerKind {
    /// No flowers.
    None,
    /// Open, with five petals, as of cherries.
    Rosette,
    /// A hanging tail, as of birches.
    Catkin,
    /// An upright spike of many, as of horse chestnuts.
    Panicle,
}

/// Forms of fruits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum FruitKind {
    /// No fruits.
    None,
    /// Balls: apples, cherries, olives, berries.
    Round,
    /// Cones of conifers.
    Cone,
    /// Nuts and acorns.
    Nut,
    /// Keys with wings, as of maples.
    Winged,
}

/// Patterns of bark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum BarkKind {
    /// Plain.
    Smooth,
    /// With furrows along the stem.
    Furrowed,
    /// In plates, and red where it peels above.
    Plated,
    /// White with black marks.
    Papery,
    /// In patches of many colours.
    Flaking,
    /// With bands around the stem.
    Banded,
    /// In fine strips.
    Stringy,
}

/// Kinds of sky.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Sky {
    /// Soft and light, with haze at the horizon.
    Meadow,
    /// Deep blue.
    Clear,
    /// Even and grey.
    Overcast,
    /// A backdrop of one colour.
    Studio,
}

/// What the tree stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Ground {
    /// A lawn.
    Grass,
    /// Bare earth.
    Earth,
    /// Sand.
    Sand,
    /// Snow.
    Snow,
    /// Nothing but a shadow.
    Plain,
}

/// Declares sections and their patches together, so that they cannot differ.
macro_rules! sections {
    ($($(#[doc = $doc:expr])+ $name:ident / $patch:ident { $($(#[doc = $of:expr])+ $field:ident: $type:ty,)+ })+) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[doc = $of])+ pub $field: $type,)+
        }

        /// Some fields of the section: those to change.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
        #[serde(deny_unknown_fields)]
        pub struct $patch {
            $(
                $(#[doc = $of])+
                #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
                #[ts(optional)]
                pub $field: Option<$type>,
            )+
        }

        impl From<$name> for $patch {
            /// Sets every field.
            fn from(all: $name) -> Self {
                Self { $($field: Some(all.$field),)+ }
            }
        }

        impl $name {
            /// This section with the patch's fields put in.
            #[must_use]
            pub fn patched(&self, patch: &$patch) -> Self {
                Self { $($field: patch.$field.unwrap_or(self.$field),)+ }
            }
        }
    )+ };
}

sections! {
    /// What leaves look like. How many there are, and how long, are parameters of growth.
    LeafLook / LeafPatch {
        /// Their form.
        shape: LeafKind,
        /// Their colour in summer: red, green and blue in sRGB.
        tint: [u8; 3],
        /// How far the hue shifts towards yellow and red on shoots of little vigor: 0 not at all, to 1.
        vigor_shift: f32,
        /// 0 bud burst, 1 summer, 2 autumn, 3 winter, and anything between; evergreen leaves hardly change.
        season: f32,
        /// -1 hanging, 0 by the rule of `LF2`, 1 raised.
        orientation: f32,
    }

    /// Flowers, and where they are.
    FlowerLook / FlowerPatch {
        /// Their form, or none.
        kind: FlowerKind,
        /// Their colour: red, green and blue in sRGB.
        tint: [u8; 3],
        /// Their diameter in internodes, or their length where they are long; 0.05 to 2.
        size: f32,
        /// Which share of the places bears one, 0 to 1.
        share: f32,
        /// Where they are borne.
        place: Place,
        /// Which shoots bear more of them: -1 the weak ones, 0 all alike, 1 the vigorous ones.
        vigor: f32,
    }

    /// Fruits, and where they are.
    FruitLook / FruitPatch {
        /// Their form, or none.
        kind: FruitKind,
        /// Their colour: red, green and blue in sRGB.
        tint: [u8; 3],
        /// Their diameter in internodes, or their length where they are long; 0.05 to 2.
        size: f32,
        /// Which share of the places bears one, 0 to 1.
        share: f32,
        /// Where they are borne.
        place: Place,
        /// Which shoots bear more of them: -1 the weak ones, 0 all alike, 1 the vigorous ones.
        vigor: f32,
    }

    /// What wood looks like.
    BarkLook / BarkPatch {
        /// Its pattern.
        kind: BarkKind,
        /// Its colour: red, green and blue in sRGB.
        tint: [u8; 3],
        /// How deep its furrows look, 0 to 2; 1 by default.
        relief: f32,
        /// How far the trunk widens at the ground, 0 to 2; 1 by default.
        root_flare: f32,
        /// How thick the collars are where a branch leaves another, 0 to 2; 1 by default.
        collar: f32,
        /// How smooth curves are drawn: 0 a polyline, 1 a smooth curve, which is the default.
        smoothing: f32,
    }

    /// What surrounds the tree.
    Background / BackgroundPatch {
        /// What is above.
        sky: Sky,
        /// What is below.
        ground: Ground,
        /// The colour of the studio's backdrop: red, green and blue in sRGB.
        backdrop: [u8; 3],
        /// Where the sun is, in degrees from the z axis towards the x axis, 0 to 360.
        sun_azimuth: f32,
        /// How high it is, in degrees above the horizon, -10 to 90.
        sun_elevation: f32,
    }
}

/// How a tree and its surroundings look.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Appearance {
    /// The leaves.
    pub leaves: LeafLook,
    /// The flowers.
    pub flowers: FlowerLook,
    /// The fruits.
    pub fruits: FruitLook,
    /// The wood.
    pub bark: BarkLook,
    /// All around.
    pub background: Background,
}

/// Some fields of some sections of an appearance: those to change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct AppearancePatch {
    /// The leaves.
    #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub leaves: Option<LeafPatch>,
    /// The flowers.
    #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub flowers: Option<FlowerPatch>,
    /// The fruits.
    #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub fruits: Option<FruitPatch>,
    /// The wood.
    #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub bark: Option<BarkPatch>,
    /// All around.
    #[serde(default, deserialize_with = "crate::present", skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub background: Option<BackgroundPatch>,
}

impl Appearance {
    /// This appearance with the patch's fields put in.
    #[must_use]
    pub fn patched(&self, patch: &AppearancePatch) -> Self {
        Self {
            leaves: patch.leaves.map_or(self.leaves, |fields| self.leaves.patched(&fields)),
            flowers: patch.flowers.map_or(self.flowers, |fields| self.flowers.patched(&fields)),
            fruits: patch.fruits.map_or(self.fruits, |fields| self.fruits.patched(&fields)),
            bark: patch.bark.map_or(self.bark, |fields| self.bark.patched(&fields)),
            background: patch.background.map_or(self.background, |fields| self.background.patched(&fields)),
        }
    }
}

impl From<Appearance> for AppearancePatch {
    /// Sets every field of every section.
    fn from(Appearance { leaves, flowers, fruits, bark, background }: Appearance) -> Self {
        Self {
            leaves: Some(leaves.into()),
            flowers: Some(flowers.into()),
            fruits: Some(fruits.into()),
            bark: Some(bark.into()),
            background: Some(background.into()),
        }
    }
}

impl Default for Appearance {
    /// What a session without any begins with.
    fn default() -> Self {
        Self {
            leaves: LeafLook {
                shape: LeafKind::Ovate,
                tint: [88, 128, 52],
                vigor_shift: 0.4,
                season: 1.0,
                orientation: 0.0,
            },
            flowers: FlowerLook {
                kind: FlowerKind::None,
                tint: [246, 236, 240],
                size: 0.5,
                share: 0.5,
                place: Place::Twigs,
                vigor: 0.0,
            },
            fruits: FruitLook {
                kind: FruitKind::None,
                tint: [178, 44, 34],
                size: 0.4,
                share: 0.2,
                place: Place::Twigs,
                vigor: 0.0,
            },
            bark: BarkLook {
                kind: BarkKind::Furrowed,
                tint: [121, 110, 97],
                relief: 1.0,
                root_flare: 1.0,
                collar: 1.0,
                smoothing: 1.0,
            },
            background: Background {
                sky: Sky::Meadow,
                ground: Ground::Grass,
                backdrop: [226, 222, 214],
                sun_azimuth: 310.0,
                sun_elevation: 48.0,
            },
        }
    }
}
