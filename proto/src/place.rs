//! Places, directions and rotations, in good form.

use std::fmt;

use espalier_reading::{Between, Bounded, NotAllowed};
use glam::{Quat, Vec2, Vec3};
use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{Error, IgnoredAny, SeqAccess, Unexpected, Visitor},
};
use ts_rs::TS;

use crate::{
    bounded::{BoxSide, written_as},
    schema::{numbers, schemas},
};

/// The farthest a place may lie from the origin on any axis, in internode lengths (`LM2`).
pub const FARTHEST: f32 = 1000.0;
/// The lowest y of a position, in internode lengths (`LM2`).
pub const DEEPEST: f32 = -10.0;
/// How far a length may be from 1, and the cosine of two directions that should be perpendicular from 0.
const TOLERANCE: f32 = 0.01;

/// So many numbers, each with its range.
struct Numbers<const N: usize> {
    ranges: [Between<f32>; N],
    allowed: String,
}

impl<'de, const N: usize> Visitor<'de> for Numbers<N> {
    type Value = [f32; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.allowed)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<[f32; N], A::Error> {
        let mut numbers = [0.0; N];
        let mut count = 0;
        for (number, range) in numbers.iter_mut().zip(self.ranges) {
            let allowed = if range.1.is_finite() { range.to_string() } else { self.allowed.clone() };
            let Some(found) = seq.next_element_seed(Bounded(range, &allowed))? else { break };
            *number = found;
            count += 1;
        }
        while seq.next_element::<IgnoredAny>()?.is_some() {
            count += 1;
        }
        let found = format!("list of {count}");
        (count == N)
            .then_some(numbers)
            .ok_or_else(|| A::Error::invalid_type(Unexpected::Other(&found), &self.allowed.as_str()))
    }
}

const ANY: Between<f32> = Between(f32::NEG_INFINITY, f32::INFINITY);
const ACROSS: Between<f32> = Between(-FARTHEST, FARTHEST);
/// Beside a place on wood.
const NEAR: Between<f32> = Between(-16.0, 16.0);
const UPWARDS: Between<f32> = Between(DEEPEST, FARTHEST);

/// Declares numbers that stand together.
macro_rules! several {
    ($($(#[doc = $doc:expr])+ $name:ident: $type:ty = [f32; $count:literal], $ranges:expr, $allowed:expr;)+) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name($type);

        impl $name {
            const RANGES: [Between<f32>; $count] = $ranges;

            /// The value, as it was given.
            pub fn get(self) -> $type {
                self.0
            }
        }

        impl TryFrom<$type> for $name {
            type Error = NotAllowed;

            fn try_from(value: $type) -> Result<Self, NotAllowed> {
                let numbers = value.to_array();
                for (axis, (number, range)) in numbers.iter().zip(Self::RANGES).enumerate() {
                    if !(range.0..=range.1).contains(number) {
                        let whole = NotAllowed::new(number.to_string(), range.to_string());
                        return Err(NotAllowed { at: format!("[{axis}]"), ..whole });
                    }
                }
                Ok(Self(value))
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.0.to_array().serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let numbers = Numbers { ranges: Self::RANGES, allowed: $allowed };
                deserializer.deserialize_seq(numbers).map(|numbers| Self(numbers.into()))
            }
        }

        written_as! { $name as [f32; $count]; }
        schemas! { $name = |_| numbers(&Self::RANGES); }
    )+ };
}

several! {
    /// A place in the world, in internode lengths (`LM2`).
    ///
    /// Coordinates are right-handed with Y up; the ground is y = 0 and the first seed stands at the origin.
    Position: Vec3 = [f32; 3], [ACROSS, UPWARDS, ACROSS],
        format!("three numbers, x and z {ACROSS}, y {UPWARDS}");
    /// A place on a plane, in internode lengths (`LM5`).
    PlanePoint: Vec2 = [f32; 2], [ACROSS; 2], format!("two numbers, {ACROSS}");
    /// From a place on wood to where a pointer is, in internode lengths (`LM20`).
    Offset: Vec3 = [f32; 3], [NEAR; 3], format!("three numbers, {NEAR}");
    /// Width, height and depth of a box, in internode lengths (`LM6`).
    BoxSize: Vec3 = [f32; 3], [BoxSide::RANGE; 3], format!("three numbers, {}", BoxSide::RANGE);
}

impl Position {
    /// The origin, where the first seed stands.
    pub const ORIGIN: Self = Self(Vec3::ZERO);

    /// The allowed place nearest to this one.
    pub fn nearest(place: Vec3) -> Self {
        let (low, high) = (Vec3::new(-FARTHEST, DEEPEST, -FARTHEST), Vec3::splat(FARTHEST));
        Self(place.max(low).min(high))
    }
}

/// Declares numbers whose length is 1, within a hundredth.
macro_rules! unit {
    ($($(#[doc = $doc:expr])+ $name:ident: $type:ty = [f32; $count:literal], $allowed:literal;)+) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name($type);

        impl TryFrom<$type> for $name {
            type Error = NotAllowed;

            fn try_from(value: $type) -> Result<Self, NotAllowed> {
                let length = value.length();
                if ((1.0 - TOLERANCE)..=(1.0 + TOLERANCE)).contains(&length) {
                    return Ok(Self(value));
                }
                Err(NotAllowed::new(format!("of length {length}"), $allowed))
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.0.to_array().serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let numbers = Numbers { ranges: [ANY; $count], allowed: $allowed.into() };
                let numbers = deserializer.deserialize_seq(numbers)?;
                Self::try_from(<$type>::from_array(numbers)).map_err(D::Error::custom)
            }
        }

        written_as! { $name as [f32; $count]; }
        schemas! { $name = |_| numbers(&[ANY; $count]); }
    )+ };
}

unit! {
    /// A direction.
    Direction: Vec3 = [f32; 3], "three finite numbers of length 1";
    /// A rotation: a quaternion x, y, z, w (`LM8`).
    UnitRotation: Quat = [f32; 4], "four finite numbers that make a quaternion of length 1";
}

impl UnitRotation {
    /// No rotation.
    pub const IDENTITY: Self = Self(Quat::IDENTITY);

    /// The rotation, of length 1 exactly.
    pub fn get(self) -> Quat {
        self.0.normalize()
    }

    /// The rotation nearest to these numbers; none for numbers without a length.
    pub fn nearest(rotation: Quat) -> Self {
        Self::try_from(rotation).or_else(|_| Self::try_from(rotation.normalize())).unwrap_or(Self::IDENTITY)
    }
}

/// A plane in space that an outline is drawn on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema, TS)]
#[serde(try_from = "Axes")]
#[schemars(!try_from, deny_unknown_fields)]
pub struct DrawingPlane {
    /// The point that is (0, 0) on the plane, in internode lengths.
    origin: Position,
    /// Unit direction of the plane's x axis.
    right: Direction,
    /// Unit direction of the plane's y axis, perpendicular to `right`.
    up: Direction,
}

/// A plane whose directions may be askew.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with origin, right and up")]
struct Axes {
    origin: Position,
    right: Direction,
    up: Direction,
}

impl TryFrom<Axes> for DrawingPlane {
    type Error = NotAllowed;

    fn try_from(Axes { origin, right, up }: Axes) -> Result<Self, NotAllowed> {
        Self::new(origin, right, up)
    }
}

impl DrawingPlane {
    /// A plane whose (0, 0) lies at `origin`.
    ///
    /// # Errors
    ///
    /// The directions are not perpendicular.
    pub fn new(origin: Position, right: Direction, up: Direction) -> Result<Self, NotAllowed> {
        let plane = Self { origin, right, up };
        let slant = plane.slant();
        if slant.abs() <= TOLERANCE {
            return Ok(plane);
        }
        let found = format!("off by a cosine of {slant}");
        Err(NotAllowed { at: "up".into(), ..NotAllowed::new(found, "perpendicular to right") })
    }

    /// Where (0, 0) lies.
    pub fn origin(&self) -> Vec3 {
        self.origin.get()
    }

    /// The directions of the x axis and the y axis, of length 1 and perpendicular exactly.
    pub fn axes(&self) -> (Vec3, Vec3) {
        let (right, up) = self.directions();
        (right, (up - right * self.slant()).normalize())
    }

    fn slant(&self) -> f32 {
        let (right, up) = self.directions();
        right.dot(up)
    }

    fn directions(&self) -> (Vec3, Vec3) {
        let unit = |Direction(vector)| vector / vector.length();
        (unit(self.right), unit(self.up))
    }
}
