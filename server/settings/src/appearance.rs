//! How a tree and its surroundings look, as a whole.

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};
use ts_rs::TS;

use crate::{
    looks::{
        Background, BackgroundPatch, BarkKind, BarkLook, BarkPatch, FlowerLook, FlowerPatch, FruitLook,
        FruitPatch, LeafKind, LeafLook, LeafPatch, WindLook, WindPatch,
    },
    schema::without_null,
    setting::{OutOfRange, Setting},
    value::Tint,
};

/// Declares the whole and its patch by the sections.
macro_rules! sections {
    ($($(#[doc = $doc:literal])+ $section:ident: $look:ident / $patch:ident,)+) => {
        /// How a tree and its surroundings look. Part of the document; it changes nothing of what grows.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
        #[serde(deny_unknown_fields)]
        pub struct Appearance {
            $($(#[doc = $doc])+ pub $section: $look,)+
        }

        /// Some fields of some sections of an appearance: those to change.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
        #[serde(deny_unknown_fields)]
        #[schemars(transform = without_null)]
        pub struct AppearancePatch {
            $(
                $(#[doc = $doc])+
                #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
                #[ts(optional)]
                pub $section: Option<$patch>,
            )+
        }

        impl Appearance {
            /// The table of each section.
            pub const TABLES: &'static [(&'static str, &'static [Setting])] =
                &[$((stringify!($section), $look::ROWS)),+];

            /// Whether every number lies in its range; an error names the section and the field.
            pub fn check(&self) -> Result<(), OutOfRange> {
                $(self.$section.check().map_err(|error| error.within(stringify!($section)))?;)+
                Ok(())
            }

            /// This appearance with the patch's fields put in.
            #[must_use]
            pub fn patched(&self, patch: &AppearancePatch) -> Self {
                Self {
                    $($section: patch.$section.map_or(self.$section, |fields| self.$section.patched(&fields)),)+
                }
            }
        }

        impl From<Appearance> for AppearancePatch {
            /// Sets every field of every section.
            fn from(all: Appearance) -> Self {
                Self { $($section: Some(all.$section.into()),)+ }
            }
        }
    };
}

sections! {
    /// The leaves.
    leaves: LeafLook / LeafPatch,
    /// The flowers.
    flowers: FlowerLook / FlowerPatch,
    /// The fruits.
    fruits: FruitLook / FruitPatch,
    /// The wood.
    bark: BarkLook / BarkPatch,
    /// All around.
    background: Background / BackgroundPatch,
    /// The wind.
    wind: WindLook / WindPatch,
}

/// A section that is there holds fields; `null` is none.
fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

impl Appearance {
    /// This appearance with what belongs to a place and a day, not to a tree, as in another one: all around, and the wind.
    #[must_use]
    pub fn among(self, surroundings: &Self) -> Self {
        Self { background: surroundings.background, wind: surroundings.wind, ..self }
    }

    /// This appearance with leaves of this form and colour.
    #[must_use]
    pub fn leafy(mut self, shape: LeafKind, tint: Tint) -> Self {
        (self.leaves.shape, self.leaves.tint) = (shape, tint);
        // What does not fall does not turn either.
        if shape.is_evergreen() {
            self.leaves.vigor_shift = 0.15;
        }
        self
    }

    /// This appearance with another hue of weak shoots, season and orientation of its leaves.
    #[must_use]
    pub fn turned(mut self, vigor_shift: f32, season: f32, orientation: f32) -> Self {
        self.leaves = LeafLook { vigor_shift, season, orientation, ..self.leaves };
        self
    }

    /// This appearance with bark of this kind and colour.
    #[must_use]
    pub fn barked(mut self, kind: BarkKind, tint: Tint) -> Self {
        (self.bark.kind, self.bark.tint) = (kind, tint);
        self
    }

    /// This appearance with another relief of the bark, root flare and thickness of collars.
    #[must_use]
    pub fn carved(mut self, relief: f32, root_flare: f32, collar: f32) -> Self {
        self.bark = BarkLook { relief, root_flare, collar, ..self.bark };
        self
    }

    /// This appearance with flowers.
    #[must_use]
    pub fn flowering(mut self, flowers: FlowerLook) -> Self {
        self.flowers = flowers;
        self
    }

    /// This appearance with fruits.
    #[must_use]
    pub fn fruiting(mut self, fruits: FruitLook) -> Self {
        self.fruits = fruits;
        self
    }
}
