//! What can be asked for about an export, on the command line and in a request alike.

use std::{fmt, str::FromStr};

use clap::Args;
use espalier_export::{Detail, Model, picture::Camera};
use serde::Deserialize;

/// The most pixels of a picture: each takes some 170 bytes while it is drawn.
const MOST_PIXELS: usize = 4_000_000;
const MOST_FRAMES: u16 = 180;
const MOST_POINTS: u32 = 20_000_000;
/// Points of a cloud: some two thousand a square metre of a grown tree.
const POINTS: u32 = 1_000_000;

/// Options of an export; each format has some of them.
#[derive(Clone, Debug, Default, PartialEq, Args, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Order {
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
    /// Pixels of a picture across and down.
    #[arg(long, value_name = "WIDTHxHEIGHT", requires = "export")]
    pub size: Option<Size>,
    /// Degrees by which the eye goes around the tree, from the front to the right.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, requires = "export")]
    pub turn: Option<Degrees>,
    /// Degrees by which the eye stands above the horizon, 1 to 80.
    #[arg(long, value_name = "DEGREES", requires = "export")]
    pub rise: Option<Degrees>,
    /// Pictures of a turntable, which make the PNG file an animated one.
    #[arg(long, value_name = "N", requires = "export")]
    pub frames: Option<u16>,
    /// Points of a cloud.
    #[arg(long, value_name = "N", requires = "export")]
    pub points: Option<u32>,
    /// Say who made the plants.
    #[arg(long, value_name = "NAME", requires = "export")]
    pub author: Option<String>,
    /// Say under which licence they may be used, by its SPDX name.
    #[arg(long, value_name = "LICENCE", requires = "export")]
    pub licence: Option<String>,
}

/// Names of options, as formats list them.
pub mod option {
    pub const LOD: &str = "lod";
    pub const QUANTISED: &str = "quantised";
    pub const COMPRESSED: &str = "compressed";
    pub const INSTANCED: &str = "instanced";
    pub const HULL: &str = "hull";
    pub const BY_LIMB: &str = "by_limb";
    pub const SIZE: &str = "size";
    pub const TURN: &str = "turn";
    pub const RISE: &str = "rise";
    pub const FRAMES: &str = "frames";
    pub const POINTS: &str = "points";
    pub const AUTHOR: &str = "author";
    pub const LICENCE: &str = "licence";
    /// Those of all files of triangles.
    pub const MESHES: &[&str] = &[LOD, HULL, BY_LIMB, AUTHOR, LICENCE];
    /// Those of USD.
    pub const SCENES: &[&str] = &[LOD, INSTANCED, HULL, BY_LIMB, AUTHOR, LICENCE];
    /// Those whose values are numbers and switches, not texts.
    pub const PLAIN: &[&str] = &[QUANTISED, COMPRESSED, INSTANCED, HULL, BY_LIMB, FRAMES, POINTS];
}

impl Order {
    /// The names of the options that are given.
    pub fn given(&self) -> Vec<&'static str> {
        let all = [
            (option::LOD, self.lod.is_some()),
            (option::QUANTISED, self.quantised),
            (option::COMPRESSED, self.compressed),
            (option::INSTANCED, self.instanced),
            (option::HULL, self.hull),
            (option::BY_LIMB, self.by_limb),
            (option::SIZE, self.size.is_some()),
            (option::TURN, self.turn.is_some()),
            (option::RISE, self.rise.is_some()),
            (option::FRAMES, self.frames.is_some()),
            (option::POINTS, self.points.is_some()),
            (option::AUTHOR, self.author.is_some()),
            (option::LICENCE, self.licence.is_some()),
        ];
        all.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name).collect()
    }

    /// Whether a format that has these options can do it, and all numbers are in range.
    pub fn check(&self, options: &[&str]) -> Result<(), OrderError> {
        if let Some(name) = self.given().into_iter().find(|name| !options.contains(name)) {
            return Err(OrderError::NotOfFormat(name));
        }
        if self.rise.is_some_and(|rise| !(1.0..=80.0).contains(&rise.0)) {
            return Err(OrderError::OutOfRange(option::RISE, "1 to 80".into()));
        }
        if self.frames.is_some_and(|frames| !(1..=MOST_FRAMES).contains(&frames)) {
            return Err(OrderError::OutOfRange(option::FRAMES, format!("1 to {MOST_FRAMES}")));
        }
        if self.points.is_some_and(|points| !(1..=MOST_POINTS).contains(&points)) {
            return Err(OrderError::OutOfRange(option::POINTS, format!("1 to {MOST_POINTS}")));
        }
        Ok(())
    }

    /// What it says about triangles.
    pub fn model(&self) -> Model {
        let &Self { quantised, compressed, instanced, hull, by_limb, .. } = self;
        let detail = self.lod.map_or(Detail::Level(0), |lod| lod.0);
        Model { detail, quantised, compressed, instanced, hull, by_limb }
    }

    /// Where the first picture is taken from.
    pub fn camera(&self) -> Camera {
        let plain = Camera::default();
        Camera {
            turn: self.turn.map_or(plain.turn, |turn| turn.0),
            rise: self.rise.map_or(plain.rise, |rise| rise.0),
        }
    }

    /// Points of a cloud.
    pub fn points(&self) -> u32 {
        self.points.unwrap_or(POINTS)
    }
}

/// An order that cannot be done.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum OrderError {
    /// The format does not have this option.
    #[error("this format has no option `{0}`")]
    NotOfFormat(&'static str),
    /// A number is too small or too large.
    #[error("{0} is out of range; allowed: {1}")]
    OutOfRange(&'static str, String),
}

impl OrderError {
    /// The option that is wrong.
    pub fn option(&self) -> &'static str {
        match self {
            Self::NotOfFormat(option) | Self::OutOfRange(option, _) => option,
        }
    }
}

/// A level of detail, or all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Lod(pub Detail);

impl FromStr for Lod {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "set" {
            return Ok(Self(Detail::Set));
        }
        let level = text.parse().ok().filter(|level| *level <= Detail::BILLBOARD);
        level
            .map(|level| Self(Detail::Level(level)))
            .ok_or_else(|| "lod must be 0, 1, 2, 3 or set".to_owned())
    }
}

/// Pixels across and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Size(pub usize, pub usize);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once('x').and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
        let fits = |&(w, h): &(usize, usize)| w >= 16 && h >= 16 && w.saturating_mul(h) <= MOST_PIXELS;
        let (width, height) = sides.filter(fits).ok_or_else(|| {
            format!("size must be WIDTHxHEIGHT, 16 or more each and {MOST_PIXELS} pixels at most")
        })?;
        Ok(Self(width, height))
    }
}

/// A finite angle.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Degrees(pub f32);

impl FromStr for Degrees {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let angle = text.parse().ok().filter(|angle: &f32| angle.abs() <= 3600.0);
        angle.map(Self).ok_or_else(|| "it must be an angle in degrees".to_owned())
    }
}

macro_rules! from_text {
    ($($name:ty),*) => {$(
        impl TryFrom<String> for $name {
            type Error = String;

            fn try_from(text: String) -> Result<Self, String> {
                text.parse()
            }
        }
    )*};
}

from_text!(Lod, Size, Degrees);

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.0, self.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_become_options() {
        assert_eq!("set".parse(), Ok(Lod(Detail::Set)));
        assert_eq!("2".parse(), Ok(Lod(Detail::Level(2))));
        assert_eq!("640x480".parse(), Ok(Size(640, 480)));
        for bad in ["", "4", "-1", "all"] {
            assert!(bad.parse::<Lod>().is_err(), "{bad}");
        }
        for bad in ["640", "0x9", "9999999999x9999999999", "4000x4000", "axb"] {
            assert!(bad.parse::<Size>().is_err(), "{bad}");
        }
        assert!("NaN".parse::<Degrees>().is_err() && "-30".parse::<Degrees>().is_ok());
    }

    #[test]
    fn a_format_refuses_what_it_has_not() {
        let order = Order { hull: true, ..Order::default() };
        assert_eq!(order.check(&[option::LOD]), Err(OrderError::NotOfFormat("hull")));
        assert_eq!(order.check(&[option::HULL]), Ok(()));
        let order = Order { frames: Some(0), ..Order::default() };
        assert_eq!(order.check(&[option::FRAMES]).unwrap_err().option(), "frames");
    }
}
