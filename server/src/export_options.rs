//! What can be asked for about an export, on the command line and in a request alike.

use std::{borrow::Cow, str::FromStr};

use clap::Args;
use espalier_export::{
    Detail, Model,
    picture::{Camera, Perspective},
};
use espalier_proto::{NotAllowed, text::Name};
use glam::Vec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::Value;

/// The most pixels of a picture: four times those of a large screen.
const MOST_PIXELS: usize = 16_000_000;
/// Texels along a side of a light map, as engines have them.
const FEWEST_TEXELS: u32 = 64;
const MOST_TEXELS: u32 = 8192;
/// Bones of a plant: some programs take 64, most 256.
const FEWEST_BONES: u32 = 2;
const MOST_BONES: u32 = 1024;
/// The most pictures of a turntable.
const MOST_FRAMES: u16 = 180;
/// The field of a picture's eye where a camera stands somewhere, in degrees: that of the page.
const FIELD: f32 = 32.0;
/// The most points of a cloud.
const MOST_POINTS: u32 = 20_000_000;
/// Points of a cloud: some two thousand a square metre of a grown tree.
const POINTS: u32 = 1_000_000;

/// Options of an export; each format has some of them.
#[derive(Clone, Debug, Default, PartialEq, Args, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(inline)]
pub struct ExportOptions {
    /// How finely triangles are written: 0, 1, 2, 3 (crossed cards), or `set` for all four in one file.
    #[arg(long, value_name = "LEVEL", requires = "export")]
    pub lod: Option<Lod>,
    /// Write vertices in 8 and 16 bits.
    #[arg(long, requires = "export")]
    pub quantised: bool,
    /// Pack vertices and triangles by meshoptimizer.
    #[arg(long, requires = "export")]
    pub compressed: bool,
    /// Write leaves as places of few meshes.
    #[arg(long, requires = "export")]
    pub instanced: bool,
    /// Add convex bodies for collisions.
    #[arg(long, requires = "export")]
    pub hull: bool,
    /// Write a node for each limb.
    #[arg(long, requires = "export")]
    pub by_limb: bool,
    /// Add a second place for each vertex, in a light map of so many texels square.
    #[arg(long, value_name = "TEXELS", requires = "export")]
    pub lightmap: Option<Texels>,
    /// Add at most so many bones for each plant, with animations of its sway in the wind that is set, or in a breeze.
    #[arg(long, value_name = "BONES", requires = "export", conflicts_with = "instanced")]
    pub sway: Option<Bones>,
    /// Add numbers to each vertex by which shaders of engines move it in the wind.
    #[arg(long, requires = "export", conflicts_with = "instanced")]
    pub wind_weights: bool,
    /// Pixels of a picture across and down.
    #[arg(long, value_name = "WIDTHxHEIGHT", requires = "export")]
    pub size: Option<Size>,
    /// Degrees by which the eye goes around the tree, from the front to the right.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, requires = "export")]
    pub turn: Option<Turn>,
    /// Degrees by which the eye stands above the horizon, -89 to 89.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, requires = "export")]
    pub rise: Option<Rise>,
    /// Degrees between the upper and the lower edge of what the eye sees; what is near is larger then.
    #[arg(long, value_name = "DEGREES", requires = "export")]
    pub fov: Option<Fov>,
    /// Metres from the eye to what is in the middle of the picture; what is near is larger then.
    #[arg(long, value_name = "METRES", requires = "export")]
    pub distance: Option<Distance>,
    /// The place in the middle of the picture, in metres; what is near is larger then.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "export")]
    pub target: Option<Target>,
    /// Pictures of a turntable, which make the PNG file an animated one.
    #[arg(long, value_name = "N", requires = "export")]
    pub frames: Option<Frames>,
    /// Points of a cloud.
    #[arg(long, value_name = "N", requires = "export")]
    pub points: Option<Points>,
    /// Say who made the plants.
    #[arg(long, value_name = "NAME", requires = "export")]
    pub author: Option<Name>,
    /// Say under which licence they may be used, by its SPDX name.
    #[arg(long, value_name = "LICENCE", requires = "export")]
    pub licence: Option<Name>,
}

/// Names of options, as formats list them.
pub mod option {
    pub const LOD: &str = "lod";
    pub const QUANTISED: &str = "quantised";
    pub const COMPRESSED: &str = "compressed";
    pub const INSTANCED: &str = "instanced";
    pub const HULL: &str = "hull";
    pub const BY_LIMB: &str = "by_limb";
    pub const LIGHTMAP: &str = "lightmap";
    pub const SWAY: &str = "sway";
    pub const WIND_WEIGHTS: &str = "wind_weights";
    pub const SIZE: &str = "size";
    pub const TURN: &str = "turn";
    pub const RISE: &str = "rise";
    pub const FOV: &str = "fov";
    pub const DISTANCE: &str = "distance";
    pub const TARGET: &str = "target";
    pub const FRAMES: &str = "frames";
    pub const POINTS: &str = "points";
    pub const AUTHOR: &str = "author";
    pub const LICENCE: &str = "licence";
    /// Those of all files of triangles.
    pub const MESHES: &[&str] = &[LOD, HULL, BY_LIMB, AUTHOR, LICENCE];
    /// Those of models with pivots, whose triangles stay in one mesh for each kind.
    pub const PIVOTS: &[&str] = &[LOD, AUTHOR, LICENCE];
    /// Those of pictures.
    pub const PICTURES: &[&str] = &[SIZE, TURN, RISE, FOV, DISTANCE, TARGET, FRAMES];
    /// Those of USD.
    pub const SCENES: &[&str] = &[LOD, INSTANCED, HULL, BY_LIMB, LIGHTMAP, SWAY, AUTHOR, LICENCE];
}

impl ExportOptions {
    /// The names of the options that are given.
    pub fn given(&self) -> Vec<&'static str> {
        let all = [
            (option::LOD, self.lod.is_some()),
            (option::QUANTISED, self.quantised),
            (option::COMPRESSED, self.compressed),
            (option::INSTANCED, self.instanced),
            (option::HULL, self.hull),
            (option::BY_LIMB, self.by_limb),
            (option::LIGHTMAP, self.lightmap.is_some()),
            (option::SWAY, self.sway.is_some()),
            (option::WIND_WEIGHTS, self.wind_weights),
            (option::SIZE, self.size.is_some()),
            (option::TURN, self.turn.is_some()),
            (option::RISE, self.rise.is_some()),
            (option::FOV, self.fov.is_some()),
            (option::DISTANCE, self.distance.is_some()),
            (option::TARGET, self.target.is_some()),
            (option::FRAMES, self.frames.is_some()),
            (option::POINTS, self.points.is_some()),
            (option::AUTHOR, self.author.is_some()),
            (option::LICENCE, self.licence.is_some()),
        ];
        all.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name).collect()
    }

    /// Whether a format with these options has all that are given.
    pub fn check(&self, options: &[&str]) -> Result<(), NotOfFormat> {
        if let Some(name) = self.given().into_iter().find(|name| !options.contains(name)) {
            return Err(NotOfFormat::Unknown(name));
        }
        let moves = [option::SWAY, option::WIND_WEIGHTS].into_iter().find(|name| self.given().contains(name));
        moves.filter(|_| self.instanced).map_or(Ok(()), |name| Err(NotOfFormat::Instanced(name)))
    }

    /// What it says about triangles.
    pub fn model(&self) -> Model {
        let &Self { quantised, compressed, instanced, hull, by_limb, wind_weights, .. } = self;
        let detail = self.lod.map_or(Detail::Level(0), |lod| lod.0);
        let lightmap = self.lightmap.map(|texels| texels.0);
        let sway = self.sway.map(|bones| bones.0);
        Model { detail, quantised, compressed, instanced, hull, by_limb, lightmap, sway, wind_weights }
    }

    /// Where the first picture is taken from, where an internode has so many metres.
    pub fn camera(&self, metres: f32) -> Camera {
        let plain = Camera::default();
        let &Self { fov, distance, target, .. } = self;
        let is_near = fov.is_some() || distance.is_some() || target.is_some();
        let perspective = is_near.then(|| Perspective {
            field: fov.map_or(FIELD, |fov| fov.0),
            target: target.map(|Target(x, y, z)| Vec3::new(x, y, z) / metres),
            distance: distance.map(|distance| distance.0 / metres),
        });
        Camera {
            turn: self.turn.map_or(plain.turn, |turn| turn.0),
            rise: self.rise.map_or(plain.rise, |rise| rise.0),
            perspective,
        }
    }

    /// Points of a cloud.
    pub fn points(&self) -> u32 {
        self.points.map_or(POINTS, |points| points.0)
    }
}

/// An option that cannot be.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotOfFormat {
    /// The format does not have it.
    #[error("this format has no option `{0}`")]
    Unknown(&'static str),
    /// Leaves that are places of few meshes stand still.
    #[error("the options `{0}` and `instanced` exclude each other")]
    Instanced(&'static str),
}

impl NotOfFormat {
    /// Which it is.
    pub fn option(&self) -> &'static str {
        let (Self::Unknown(name) | Self::Instanced(name)) = self;
        name
    }
}

/// A text, or a number as it is written.
#[derive(Deserialize)]
#[serde(from = "Value")]
struct Word(String);

impl From<Value> for Word {
    fn from(value: Value) -> Self {
        match value {
            Value::String(text) => Self(text),
            // What is neither is no allowed text either.
            other => Self(other.to_string()),
        }
    }
}

/// Declares what an option can be: a text becomes a value, or is none of what is allowed.
macro_rules! values {
    ($($(#[doc = $doc:literal])+ $name:ident($($type:ty),+): $allowed:expr, $read:expr;)+) => {$(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
        #[serde(try_from = "Word")]
        pub struct $name($(pub $type),+);

        impl TryFrom<Word> for $name {
            type Error = NotAllowed;

            fn try_from(Word(text): Word) -> Result<Self, NotAllowed> {
                let read: fn(&str) -> Option<Self> = $read;
                read(&text).ok_or_else(|| NotAllowed::new(text, $allowed))
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "type": ["string", "number"], "description": format!("Allowed: {}.", $allowed) })
            }
        }

        impl FromStr for $name {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                Self::try_from(Word(text.to_owned())).map_err(|error| format!("allowed: {}", error.allowed))
            }
        }
    )+};
}

values! {
    /// A level of detail, or all.
    Lod(Detail): "0, 1, 2, 3 or set", |text| match text {
        "set" => Some(Self(Detail::Set)),
        level => {
            let level = level.parse().ok().filter(|level| *level <= Detail::BILLBOARD);
            level.map(|level| Self(Detail::Level(level)))
        }
    };
    /// Pixels across and down.
    Size(usize, usize): format!("WIDTHxHEIGHT, 16 or more each and {MOST_PIXELS} pixels at most"), |text| {
        let (width, height) = text.split_once('x')?;
        let (width, height): (usize, usize) = (width.parse().ok()?, height.parse().ok()?);
        let fits = width >= 16 && height >= 16 && width.saturating_mul(height) <= MOST_PIXELS;
        fits.then_some(Self(width, height))
    };
    /// Degrees to the right.
    Turn(f32): "-3600 to 3600", |text| number(text, -3600.0, 3600.0).map(Self);
    /// Degrees above the horizon.
    Rise(f32): "-89 to 89", |text| number(text, -89.0, 89.0).map(Self);
    /// Degrees between the edges of a picture.
    Fov(f32): "1 to 150", |text| number(text, 1.0, 150.0).map(Self);
    /// Metres to the eye.
    Distance(f32): "0.01 to 100000", |text| number(text, 0.01, 100_000.0).map(Self);
    /// A place in metres.
    Target(f32, f32, f32): "X,Y,Z in metres, each -100000 to 100000", |text| {
        let mut places = text.split(',').map(|place| number(place.trim(), -100_000.0, 100_000.0));
        let [x, y, z] = [places.next()??, places.next()??, places.next()??];
        places.next().is_none().then_some(Self(x, y, z))
    };
    /// Texels along a side of a light map.
    Texels(u32): format!("{FEWEST_TEXELS} to {MOST_TEXELS}"), |text| number(text, FEWEST_TEXELS, MOST_TEXELS).map(Self);
    /// Bones of a plant.
    Bones(u32): format!("{FEWEST_BONES} to {MOST_BONES}"), |text| number(text, FEWEST_BONES, MOST_BONES).map(Self);
    /// Pictures of a turntable.
    Frames(u16): format!("1 to {MOST_FRAMES}"), |text| number(text, 1, MOST_FRAMES).map(Self);
    /// Points of a cloud.
    Points(u32): format!("1 to {MOST_POINTS}"), |text| number(text, 1, MOST_POINTS).map(Self);
}

fn number<T: FromStr + PartialOrd>(text: &str, least: T, most: T) -> Option<T> {
    text.parse().ok().filter(|number| (least..=most).contains(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_become_options() {
        assert_eq!("set".parse(), Ok(Lod(Detail::Set)));
        assert_eq!("2".parse(), Ok(Lod(Detail::Level(2))));
        assert_eq!("640x480".parse(), Ok(Size(640, 480)));
        assert_eq!("-30".parse(), Ok(Turn(-30.0)));
        for bad in ["", "4", "-1", "all"] {
            assert_eq!(bad.parse::<Lod>(), Err("allowed: 0, 1, 2, 3 or set".into()), "{bad}");
        }
        for bad in ["640", "0x9", "9999999999x9999999999", "4001x4001", "axb"] {
            assert!(bad.parse::<Size>().is_err(), "{bad}");
        }
        assert!("NaN".parse::<Turn>().is_err() && "90".parse::<Rise>().is_err());
        assert_eq!(" 1.5,-2, 0".parse(), Ok(Target(1.5, -2.0, 0.0)));
        for bad in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,NaN", "1,2,1e9", "1 2 3"] {
            assert!(bad.parse::<Target>().is_err_and(|error| error.contains("X,Y,Z in metres")), "{bad}");
        }
        for bad in ["0", "151", "-30", "NaN"] {
            assert_eq!(bad.parse::<Fov>(), Err("allowed: 1 to 150".into()), "{bad}");
        }
        for bad in ["0", "-1", "inf", "1e6"] {
            assert_eq!(bad.parse::<Distance>(), Err("allowed: 0.01 to 100000".into()), "{bad}");
        }
        for bad in ["0", "181", "70000", "1.5", ""] {
            assert!(bad.parse::<Frames>().is_err_and(|error| error == "allowed: 1 to 180"), "{bad}");
        }
        assert_eq!("1024".parse(), Ok(Texels(1024)));
        for bad in ["63", "8193", "true"] {
            assert!(bad.parse::<Texels>().is_err_and(|error| error == "allowed: 64 to 8192"), "{bad}");
        }
        assert!("20000001".parse::<Points>().is_err());
    }

    #[test]
    fn a_camera_is_near_where_anything_says_so() {
        let plain = ExportOptions { turn: Some(Turn(30.0)), ..ExportOptions::default() };
        assert_eq!(plain.camera(0.5), Camera { turn: 30.0, ..Camera::default() });
        let near = |options: ExportOptions| options.camera(0.5).perspective;
        let field = Perspective { field: 60.0, target: None, distance: None };
        assert_eq!(near(ExportOptions { fov: Some(Fov(60.0)), ..plain.clone() }), Some(field));
        let far = Perspective { field: FIELD, target: None, distance: Some(20.0) };
        assert_eq!(near(ExportOptions { distance: Some(Distance(10.0)), ..plain.clone() }), Some(far));
        let aimed = Perspective { field: FIELD, target: Some(Vec3::new(2.0, 4.0, -6.0)), distance: None };
        assert_eq!(near(ExportOptions { target: Some(Target(1.0, 2.0, -3.0)), ..plain }), Some(aimed));
    }

    #[test]
    fn a_format_refuses_what_it_has_not() {
        let options = ExportOptions { hull: true, ..ExportOptions::default() };
        assert_eq!(options.check(&[option::LOD]), Err(NotOfFormat::Unknown("hull")));
        assert_eq!(options.check(&[option::HULL]), Ok(()));
        let options = ExportOptions { lightmap: Some(Texels(512)), ..ExportOptions::default() };
        assert_eq!(
            options.check(option::MESHES),
            Err(NotOfFormat::Unknown("lightmap")),
            "OBJ has no second places"
        );
        assert_eq!(options.check(option::SCENES), Ok(()));
        let options = ExportOptions { sway: Some(Bones(64)), instanced: true, ..ExportOptions::default() };
        let both = [option::SWAY, option::INSTANCED];
        assert_eq!(
            options.check(&both),
            Err(NotOfFormat::Instanced("sway")),
            "leaves that are instances stand still"
        );
        assert_eq!(ExportOptions { instanced: false, ..options }.check(&both), Ok(()));
        let options = ExportOptions { wind_weights: true, instanced: true, ..ExportOptions::default() };
        let both = [option::WIND_WEIGHTS, option::INSTANCED];
        assert_eq!(options.check(&both), Err(NotOfFormat::Instanced("wind_weights")));
    }
}
