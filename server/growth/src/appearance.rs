//! How a tree and its surroundings look; growth takes no notice of it.
//!
//! It stands beside the parameters because a species has both. Colours are red, green and blue in sRGB.

/// A colour in sRGB.
pub type Tint = [u8; 3];

/// A value outside its range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} is {value}; allowed: {allowed}")]
pub struct AppearanceError {
    /// The field, within its section.
    pub name: &'static str,
    /// What it was to be.
    pub value: String,
    /// What it may be.
    pub allowed: String,
}

/// Declares a section: choices and colours, then numbers with their ranges.
macro_rules! section {
    (
        $(#[doc = $doc:expr])+
        $section:ident {
            choices { $($(#[doc = $chosen_doc:expr])+ $chosen:ident : $choice:ty;)+ }
            numbers { $($(#[doc = $number_doc:expr])+ $name:ident in $low:expr, $high:expr;)+ }
        }
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $section {
            $($(#[doc = $chosen_doc])+ pub $chosen: $choice,)+
            $($(#[doc = $number_doc])+ pub $name: f32,)+
        }

        impl $section {
            /// Name, least and greatest value of every number.
            pub const RANGES: &'static [(&'static str, f32, f32)] =
                &[$((stringify!($name), $low, $high),)+];

            /// Whether every number lies in its range; what is not a number lies in none.
            pub fn check(&self) -> Result<(), AppearanceError> {
                $(
                    if !($low..=$high).contains(&self.$name) {
                        return Err(AppearanceError {
                            name: stringify!($name),
                            value: self.$name.to_string(),
                            allowed: format!("{} to {}", $low, $high),
                        });
                    }
                )+
                Ok(())
            }
        }
    };
}

/// Forms of leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeafKind {
    /// Egg-shaped, as of beech and apple.
    Ovate,
    /// Nearly as broad as long, on a long stalk, as of poplars and birches.
    Round,
    /// Long and narrow, as of willow and olive.
    Lanceolate,
    /// With round lobes, as of oaks.
    Lobed,
    /// Like a hand, as of maples and planes.
    Palmate,
    /// A fan, as of ginkgo.
    Fan,
    /// Many leaflets on one stalk, as of acacias.
    Compound,
    /// Tufts of needles, as of pines and spruces.
    Needle,
    /// Scales that hide the twig, as of cypresses.
    Scale,
}

impl LeafKind {
    /// Whether leaves of this form stay all year, as a rule.
    pub fn is_evergreen(self) -> bool {
        matches!(self, Self::Needle | Self::Scale)
    }
}

section! {
    /// What leaves look like. How many there are, and how long, are parameters of growth.
    LeafLook {
        choices {
            /// Their form.
            shape: LeafKind;
            /// Their colour in summer.
            tint: Tint;
        }
        numbers {
            /// How far the hue shifts towards yellow and red on shoots of little vigor.
            vigor_shift in 0.0, 1.0;
            /// 0 bud burst, 1 summer, 2 autumn, 3 winter.
            season in 0.0, 3.0;
            /// -1 hanging, 0 as the rule of leaves has it, 1 raised.
            orientation in -1.0, 1.0;
        }
    }
}

/// Where flowers and fruits are borne.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// At the ends of shoots.
    Tips,
    /// All along the leafy twigs.
    Twigs,
    /// On older wood without leaves.
    Wood,
}

/// Forms of flowers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

section! {
    /// Flowers, and where they are.
    FlowerLook {
        choices {
            /// Their form, or none.
            kind: FlowerKind;
            /// Their colour.
            tint: Tint;
            /// Where they are borne.
            place: Place;
        }
        numbers {
            /// Diameter in internodes, or length of what is long.
            size in 0.05, 2.0;
            /// Which share of the places bears one.
            share in 0.0, 1.0;
            /// -1: more on weak shoots, 0: on all alike, 1: more on vigorous ones.
            vigor in -1.0, 1.0;
        }
    }
}

/// Forms of fruits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

section! {
    /// Fruits, and where they are.
    FruitLook {
        choices {
            /// Their form, or none.
            kind: FruitKind;
            /// Their colour.
            tint: Tint;
            /// Where they are borne.
            place: Place;
        }
        numbers {
            /// Diameter in internodes, or length of what is long.
            size in 0.05, 2.0;
            /// Which share of the places bears one.
            share in 0.0, 1.0;
            /// -1: more on weak shoots, 0: on all alike, 1: more on vigorous ones.
            vigor in -1.0, 1.0;
        }
    }
}

/// Patterns of bark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarkKind {
    /// Plain, as of beech.
    Smooth,
    /// With furrows along the stem, as of oak.
    Furrowed,
    /// In plates, and red where it peels above, as of Scots pine.
    Plated,
    /// White with black marks, as of birch.
    Papery,
    /// In patches of many colours, as of plane.
    Flaking,
    /// With bands around the stem, as of cherry.
    Banded,
    /// In fine strips, as of cypress and juniper.
    Stringy,
}

section! {
    /// What wood looks like.
    BarkLook {
        choices {
            /// Its pattern.
            kind: BarkKind;
            /// Its colour.
            tint: Tint;
        }
        numbers {
            /// How deep its furrows look.
            relief in 0.0, 2.0;
            /// How far the trunk widens at the ground.
            root_flare in 0.0, 2.0;
            /// How thick the collars are where a branch leaves another.
            collar in 0.0, 2.0;
            /// 0 a polyline, 1 a smooth curve.
            smoothing in 0.0, 1.0;
        }
    }
}

/// Kinds of sky.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

section! {
    /// What surrounds the tree.
    Background {
        choices {
            /// What is above.
            sky: Sky;
            /// What is below.
            ground: Ground;
            /// The colour of the studio's backdrop.
            backdrop: Tint;
        }
        numbers {
            /// Where the sun is, in degrees from the z axis towards the x axis.
            sun_azimuth in 0.0, 360.0;
            /// How high it is, in degrees above the horizon.
            sun_elevation in -10.0, 90.0;
        }
    }
}

/// How a tree and its surroundings look.
#[derive(Clone, Copy, Debug, PartialEq)]
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

impl Default for Appearance {
    /// A tree of no species: green, on a meadow.
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

impl Appearance {
    /// Whether every number lies in its range.
    pub fn check(&self) -> Result<(), AppearanceError> {
        self.leaves.check()?;
        self.flowers.check()?;
        self.fruits.check()?;
        self.bark.check()?;
        self.background.check()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_appearance_is_in_range() {
        assert_eq!(Appearance::default().check(), Ok(()));
    }

    #[test]
    fn both_ends_pass_and_beyond_fails() {
        let with = |season| LeafLook { season, ..Appearance::default().leaves }.check();
        assert!(with(0.0).is_ok() && with(3.0).is_ok());
        for bad in [-0.01, 3.01, f32::NAN, f32::INFINITY] {
            let error = with(bad).expect_err("out of range");
            assert_eq!((error.name, error.allowed.as_str()), ("season", "0 to 3"));
        }
    }
}
