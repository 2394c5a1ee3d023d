//! Looks: of leaves, flowers, fruits, bark, what surrounds the tree, and the wind. Growth takes no notice of them.

use crate::{
    choice::choices,
    setting::Unit::{Degrees, Internodes, Metres, MetresPerSecond},
    table::settings,
    value::Tint,
};

/// Which gusts come, of all that a wind could come in: the same for clients and for files.
pub const GUST_SEED: u32 = 7;

choices! {
    /// Forms of leaves.
    LeafKind {
        /// Egg-shaped, as of beech and apple.
        Ovate = "ovate",
        /// Nearly as broad as long, on a long stalk, as of poplars and birches.
        Round = "round",
        /// Long and narrow, as of willow and olive.
        Lanceolate = "lanceolate",
        /// With round lobes, as of oaks.
        Lobed = "lobed",
        /// Like a hand, as of maples and planes.
        Palmate = "palmate",
        /// A fan, as of ginkgo.
        Fan = "fan",
        /// Many leaflets on one stalk, as of acacias.
        Compound = "compound",
        /// Tufts of needles, as of pines and spruces; evergreen.
        Needle = "needle",
        /// Scales that hide the twig, as of cypresses; evergreen.
        Scale = "scale",
    }

    /// Where flowers and fruits are borne.
    Place {
        /// At the ends of shoots.
        Tips = "tips",
        /// All along the leafy twigs.
        Twigs = "twigs",
        /// On older wood without leaves.
        Wood = "wood",
    }

    /// Forms of flowers.
    FlowerKind {
        /// No flowers.
        None = "none",
        /// Open, with five petals, as of cherries.
        Rosette = "rosette",
        /// A hanging tail, as of birches.
        Catkin = "catkin",
        /// An upright spike of many, as of horse chestnuts.
        Panicle = "panicle",
    }

    /// Forms of fruits.
    FruitKind {
        /// No fruits.
        None = "none",
        /// Balls: apples, cherries, olives, berries.
        Round = "round",
        /// Cones of conifers.
        Cone = "cone",
        /// Nuts and acorns.
        Nut = "nut",
        /// Keys with wings, as of maples.
        Winged = "winged",
    }

    /// Patterns of bark.
    BarkKind {
        /// Plain, as of beech.
        Smooth = "smooth",
        /// With furrows along the stem, as of oak.
        Furrowed = "furrowed",
        /// In plates, and red where it peels above, as of Scots pine.
        Plated = "plated",
        /// White with black marks, as of birch.
        Papery = "papery",
        /// In patches of many colours, as of plane.
        Flaking = "flaking",
        /// With bands around the stem, as of cherry.
        Banded = "banded",
        /// In fine strips, as of cypress and juniper.
        Stringy = "stringy",
    }

    /// Kinds of sky.
    Sky {
        /// Soft and light, with haze at the horizon.
        Meadow = "meadow",
        /// Deep blue.
        Clear = "clear",
        /// Even and grey.
        Overcast = "overcast",
        /// A backdrop of one colour.
        Studio = "studio",
    }

    /// What the tree stands on.
    Ground {
        /// A lawn.
        Grass = "grass",
        /// Bare earth.
        Earth = "earth",
        /// Sand.
        Sand = "sand",
        /// Snow.
        Snow = "snow",
        /// Nothing but a shadow.
        Plain = "plain",
    }
}

impl LeafKind {
    /// Whether leaves of this form stay all year, as a rule.
    pub fn is_evergreen(self) -> bool {
        matches!(self, Self::Needle | Self::Scale)
    }
}

settings! {
    /// What leaves look like. How many there are, and how long, are parameters of growth.
    #[derive(Copy)]
    LeafLook / #[derive(Copy)] LeafPatch {
        /// Their form.
        shape: LeafKind = LeafKind::Ovate;
        /// Their colour in summer.
        tint: Tint = [88, 128, 52];
        /// Into how many blades each leaf is divided (`LF6`), which together cover as much.
        blades: u32 = 1, range(1.0, 12.0);
        /// How far the hue shifts towards yellow and red on shoots of little vigor.
        vigor_shift: f32 = 0.4, range(0.0, 1.0);
        /// 0 bud burst, 1 summer, 2 autumn, 3 winter, and anything between; evergreen leaves hardly change.
        season: f32 = 1.0, range(0.0, 3.0), step(0.02);
        /// -1 hanging, 0 by the rule of `LF2`, 1 raised.
        orientation: f32 = 0.0, range(-1.0, 1.0), step(0.02);
    }

    /// Flowers, and where they are.
    #[derive(Copy)]
    FlowerLook / #[derive(Copy)] FlowerPatch {
        /// Their form, or none.
        kind: FlowerKind = FlowerKind::None;
        /// Their colour.
        tint: Tint = [246, 236, 240];
        /// Their diameter, or their length where they are long.
        size: f32 = 0.5, range(0.05, 2.0), step(0.05), unit(Internodes);
        /// Which share of the places bears one.
        share: f32 = 0.5, range(0.0, 1.0);
        /// Where they are borne: tips of shoots, leafy twigs, older wood.
        place: Place = Place::Twigs;
        /// Which shoots bear more of them: -1 the weak ones, 0 all alike, 1 the vigorous ones.
        vigor: f32 = 0.0, range(-1.0, 1.0), step(0.02);
    }

    /// Fruits, and where they are.
    #[derive(Copy)]
    FruitLook / #[derive(Copy)] FruitPatch {
        /// Their form, or none.
        kind: FruitKind = FruitKind::None;
        /// Their colour.
        tint: Tint = [178, 44, 34];
        /// Their diameter, or their length where they are long.
        size: f32 = 0.4, range(0.05, 2.0), step(0.05), unit(Internodes);
        /// Which share of the places bears one.
        share: f32 = 0.2, range(0.0, 1.0);
        /// Where they are borne: tips of shoots, leafy twigs, older wood.
        place: Place = Place::Twigs;
        /// Which shoots bear more of them: -1 the weak ones, 0 all alike, 1 the vigorous ones.
        vigor: f32 = 0.0, range(-1.0, 1.0), step(0.02);
    }

    /// What wood looks like.
    #[derive(Copy)]
    BarkLook / #[derive(Copy)] BarkPatch {
        /// Its pattern.
        kind: BarkKind = BarkKind::Furrowed;
        /// Its colour.
        tint: Tint = [121, 110, 97];
        /// How deep its furrows look.
        relief: f32 = 1.0, range(0.0, 2.0), step(0.02);
        /// How far the trunk widens at the ground.
        root_flare: f32 = 1.0, range(0.0, 2.0), step(0.02);
        /// How thick the collars are where a branch leaves another.
        collar: f32 = 1.0, range(0.0, 2.0), step(0.02);
        /// How smooth curves are drawn: 0 a polyline, 1 a smooth curve.
        smoothing: f32 = 1.0, range(0.0, 1.0);
    }

    /// What surrounds the tree.
    #[derive(Copy)]
    Background / #[derive(Copy)] BackgroundPatch {
        /// What is above.
        sky: Sky = Sky::Meadow;
        /// What is below.
        ground: Ground = Ground::Grass;
        /// The colour behind the tree in the studio.
        backdrop: Tint = [226, 222, 214];
        /// Where the sun is, from the z axis towards the x axis.
        sun_azimuth: f32 = 310.0, range(0.0, 360.0), step(1.0), unit(Degrees);
        /// How high it is above the horizon.
        sun_elevation: f32 = 48.0, range(-10.0, 90.0), step(1.0), unit(Degrees);
    }

    /// The wind in which trees sway, and what else the weather does to them. No row, light or growth knows of it.
    #[derive(Copy)]
    WindLook / #[derive(Copy)] WindPatch {
        /// How fast it blows on average 10 m above the ground, level; 0 is a calm.
        speed: f32 = 0.0, range(0.0, 25.0), step(0.5), unit(MetresPerSecond);
        /// Where it blows to, around the vertical from the x axis towards the z axis.
        direction: f32 = 0.0, range(0.0, 360.0), step(5.0), unit(Degrees);
        /// How fast it rises, or falls where it is less than 0.
        rise: f32 = 0.0, range(-10.0, 10.0), step(0.5), unit(MetresPerSecond);
        /// From an even wind to one that comes in gusts.
        turbulence: f32 = 0.6, range(0.0, 1.0), step(0.05);
        /// How much leaves flutter beside what is usual for their form.
        flutter: f32 = 1.0, range(0.0, 2.0), step(0.1);
        /// How much more wood weighs than it grew under: 1 is its own weight once more.
        sag: f32 = 0.0, range(0.0, 1.0), step(0.05);
        /// How much softer wood is than it swings in nature.
        suppleness: f32 = 1.0, range(0.2, 5.0), step(0.1);
        /// How much sooner wood comes to rest than in nature.
        damping: f32 = 1.0, range(0.2, 5.0), step(0.1);
        /// How deep fresh snow lies on all that holds it.
        snow: f32 = 0.0, range(0.0, 0.5), step(0.01), unit(Metres);
        /// From dry leaves to leaves heavy with rain.
        rain: f32 = 0.0, range(0.0, 1.0), step(0.05);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Appearance;

    #[test]
    fn both_ends_pass_and_beyond_fails() {
        let with = |season| LeafLook { season, ..LeafLook::default() }.check();
        assert!(with(0.0).is_ok() && with(3.0).is_ok());
        for bad in [-0.01, 3.01, f32::NAN, f32::INFINITY] {
            let error = with(bad).expect_err("out of range");
            assert_eq!((error.field.as_str(), error.allowed.as_str()), ("season", "0 to 3"));
        }
    }

    #[test]
    fn wd1_a_wind_that_is_no_number_or_beyond_all_storms_is_refused_with_what_is_allowed() {
        for (name, allowed) in [
            ("speed", "0 to 25"),
            ("direction", "0 to 360"),
            ("rise", "-10 to 10"),
            ("turbulence", "0 to 1"),
            ("flutter", "0 to 2"),
            ("sag", "0 to 1"),
            ("suppleness", "0.2 to 5"),
            ("damping", "0.2 to 5"),
            ("snow", "0 to 0.5"),
            ("rain", "0 to 1"),
        ] {
            for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e9, -1e9] {
                let mut look = WindLook::default();
                *match name {
                    "speed" => &mut look.speed,
                    "direction" => &mut look.direction,
                    "rise" => &mut look.rise,
                    "turbulence" => &mut look.turbulence,
                    "flutter" => &mut look.flutter,
                    "sag" => &mut look.sag,
                    "suppleness" => &mut look.suppleness,
                    "damping" => &mut look.damping,
                    "snow" => &mut look.snow,
                    _ => &mut look.rain,
                } = bad;
                let error = look.check().expect_err("out of range");
                assert_eq!(error.field, name, "{bad}");
                assert!(error.allowed.starts_with(allowed), "{name}: {}", error.allowed);
            }
        }
        let names: Vec<&str> = Appearance::TABLES
            .iter()
            .filter(|(section, _)| *section == "wind")
            .flat_map(|(_, rows)| rows.iter().map(|row| row.name))
            .collect();
        assert_eq!(names.len(), 10, "all of {names:?} are tried");
    }

    #[test]
    fn every_default_is_in_range_and_every_row_says_what_it_is() {
        assert_eq!(Appearance::default().check(), Ok(()));
        for row in Appearance::TABLES.iter().flat_map(|(_, rows)| *rows) {
            assert!(row.sentence.len() > 5 && row.sentence.ends_with('.'), "{}: {}", row.name, row.sentence);
        }
    }

    #[test]
    fn what_cannot_be_read_says_what_is_allowed() {
        for (text, expected) in [
            (r#"{"tint":[1,2]}"#, "invalid length 2, expected three whole numbers, 0 to 255"),
            (r#"{"tint":[1,2,3,4]}"#, "invalid length 4, expected three whole numbers, 0 to 255"),
            (r#"{"tint":[1,300,3]}"#, "integer `300`, expected a whole number, 0 to 255"),
            (r#"{"tint":[1,2.5,3]}"#, "floating point `2.5`, expected a whole number, 0 to 255"),
            (r##"{"tint":"#ff0000"}"##, "expected three whole numbers, 0 to 255"),
            (r#"{"shape":"oak"}"#, "expected ovate, round, lanceolate, "),
            (r#"{"orientation":"up"}"#, r#"invalid type: string "up", expected -1 to 1"#),
        ] {
            let error = serde_json::from_str::<LeafPatch>(text).expect_err(text).to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
