//! Numbers and lists with bounds: whoever holds one need not check it.

use std::{borrow::Cow, fmt, marker::PhantomData, ops::Deref};

use espalier_reading::{Between, Bounded, NotAllowed};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, IgnoredAny, SeqAccess, Visitor},
};
use ts_rs::{Config, TS};

use crate::{
    schema::{between, list, schemas},
    version::{
        MAX_AGE, MAX_BEND_TOUCHES, MAX_DIAMETER, MAX_LIMB_ORDERS, MAX_LINK_HOURS, MAX_PREDICTED_STEPS,
        MAX_STEPS_PER_COMMAND, MIN_DIAMETER,
    },
};

/// Types that are written in TypeScript as another one.
macro_rules! written_as {
    ($($name:ty as $type:ty;)+) => { $(
        impl ts_rs::TS for $name {
            type WithoutGenerics = $type;
            type OptionInnerType = Self;

            fn name(config: &ts_rs::Config) -> String {
                <$type as ts_rs::TS>::name(config)
            }

            fn inline(config: &ts_rs::Config) -> String {
                <$type as ts_rs::TS>::inline(config)
            }
        }
    )+ };
}
pub(crate) use written_as;

/// Declares numbers by their type, their least and their most.
macro_rules! bounded {
    ($($(#[doc = $doc:expr])+ $name:ident: $type:ident from $least:expr, to $most:expr, read $read:ident;)+) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize)]
        #[serde(transparent)]
        pub struct $name($type);

        impl $name {
            /// The least that is allowed.
            pub const LEAST: Self = Self($least);
            /// The most that is allowed.
            pub const MOST: Self = Self($most);

            pub(crate) const RANGE: Between<$type> = Between($least, $most);

            /// The allowed value nearest to this one; the least for what is no number.
            pub fn nearest(value: $type) -> Self {
                if value > $most { Self::MOST } else if value > $least { Self(value) } else { Self::LEAST }
            }

            /// The number.
            pub fn get(self) -> $type {
                self.0
            }
        }

        impl TryFrom<$type> for $name {
            type Error = NotAllowed;

            fn try_from(value: $type) -> Result<Self, NotAllowed> {
                let is_allowed = ($least..=$most).contains(&value);
                is_allowed.then_some(Self(value)).ok_or_else(|| NotAllowed::new(value.to_string(), Self::RANGE.to_string()))
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.$read(Bounded(Self::RANGE, &Self::RANGE)).map(Self)
            }
        }

        written_as! { $name as $type; }
        schemas! { $name = |_| between(&Self::RANGE); }
    )+

        /// The names of these numbers, each with its least and its most as they are written.
        pub(crate) fn bounds() -> Vec<(&'static str, [String; 2])> {
            vec![$((stringify!($name), [$name::RANGE.0.to_string(), $name::RANGE.1.to_string()])),+]
        }
    };
}

bounded! {
    /// Simulation steps of one command (`LM3`).
    Steps: u32 from 1, to MAX_STEPS_PER_COMMAND, read deserialize_u32;
    /// An age in a programme, in steps of growth (`LM13`).
    Age: u32 from 0, to MAX_AGE, read deserialize_u32;
    /// Simulation steps of a prediction (`LM10`).
    PredictedSteps: u32 from 0, to MAX_PREDICTED_STEPS, read deserialize_u32;
    /// Up to which order the limbs of a plant are described (`DS10`).
    LimbOrders: u32 from 1, to MAX_LIMB_ORDERS, read deserialize_u32;
    /// How long a link lets in, in hours (`AC12`).
    LinkHours: u32 from 1, to MAX_LINK_HOURS, read deserialize_u32;
    /// The radius of the brush, in internode lengths (`LM2`).
    BrushRadius: f32 from 0.0, to 40.0, read deserialize_f32;
    /// The depth of a lasso's body against its width (`LM5`).
    Depth: f32 from 0.1, to 1.0, read deserialize_f32;
    /// From the base to the tip of an outline that a limb is to fill, in internode lengths (`LM21`).
    LimbLength: f32 from 0.5, to 400.0, read deserialize_f32;
    /// A share of a whole (`LM7`, `LM9`).
    Share: f32 from 0.0, to 1.0, read deserialize_f32;
    /// A width that is asked for, in internode lengths (`LM8`).
    Diameter: f32 from MIN_DIAMETER, to MAX_DIAMETER, read deserialize_f32;
    /// The radius of a sphere, in internode lengths (`LM6`).
    SphereRadius: f32 from 0.1, to 500.0, read deserialize_f32;
    /// Width, height or depth of a box, in internode lengths (`LM6`).
    BoxSide: f32 from 0.1, to 1000.0, read deserialize_f32;
    /// Turn of a camera around the vertical, in degrees (`LM20`).
    Yaw: f32 from -180.0, to 180.0, read deserialize_f32;
    /// Height of a camera above the horizontal, in degrees (`LM20`).
    Pitch: f32 from -90.0, to 90.0, read deserialize_f32;
    /// From a camera to what it looks at, in internode lengths (`LM20`).
    EyeDistance: f32 from 0.1, to 10_000.0, read deserialize_f32;
    /// What the coordinates of a mesh are multiplied by (`LM6`).
    Scale: f32 from 0.001, to 1000.0, read deserialize_f32;
}

/// `LEAST` to `MOST` entries.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct List<T, const LEAST: usize, const MOST: usize>(Vec<T>);

impl<T, const LEAST: usize, const MOST: usize> List<T, LEAST, MOST> {
    fn allowed() -> String {
        match LEAST {
            0 => format!("a list of up to {MOST} entries"),
            least => format!("a list of {least} to {MOST} entries"),
        }
    }
}

impl<T, const MOST: usize> Default for List<T, 0, MOST> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T, const MOST: usize> List<T, 1, MOST> {
    /// A list of one entry.
    pub fn of(entry: T) -> Self {
        Self(vec![entry])
    }
}

impl<T, const LEAST: usize, const MOST: usize> Deref for List<T, LEAST, MOST> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T, const LEAST: usize, const MOST: usize> TryFrom<Vec<T>> for List<T, LEAST, MOST> {
    type Error = NotAllowed;

    fn try_from(entries: Vec<T>) -> Result<Self, NotAllowed> {
        if (LEAST..=MOST).contains(&entries.len()) {
            return Ok(Self(entries));
        }
        Err(NotAllowed::new(format!("a list of {}", entries.len()), Self::allowed()))
    }
}

impl<T, const LEAST: usize, const MOST: usize> From<List<T, LEAST, MOST>> for Vec<T> {
    fn from(list: List<T, LEAST, MOST>) -> Self {
        list.0
    }
}

struct ListVisitor<T, const LEAST: usize, const MOST: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const LEAST: usize, const MOST: usize> Visitor<'de>
    for ListVisitor<T, LEAST, MOST>
{
    type Value = List<T, LEAST, MOST>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&List::<T, LEAST, MOST>::allowed())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut entries = Vec::new();
        while entries.len() < MOST {
            match seq.next_element()? {
                Some(entry) => entries.push(entry),
                None => break,
            }
        }
        let mut count = entries.len();
        while seq.next_element::<IgnoredAny>()?.is_some() {
            count += 1;
        }
        let fault = if count < LEAST { "too few" } else { "too many" };
        List::try_from(entries).ok().filter(|_| count <= MOST).ok_or_else(|| {
            let allowed = List::<T, LEAST, MOST>::allowed();
            A::Error::custom(format_args!("{fault}: {count} entries, expected {allowed}"))
        })
    }
}

impl<'de, T: Deserialize<'de>, const LEAST: usize, const MOST: usize> Deserialize<'de>
    for List<T, LEAST, MOST>
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

impl<T: TS, const LEAST: usize, const MOST: usize> TS for List<T, LEAST, MOST> {
    type WithoutGenerics = Vec<ts_rs::Dummy>;
    type OptionInnerType = Self;

    fn name(config: &Config) -> String {
        Vec::<T>::name(config)
    }

    fn inline(config: &Config) -> String {
        Vec::<T>::inline(config)
    }
}

impl<T: JsonSchema, const LEAST: usize, const MOST: usize> JsonSchema for List<T, LEAST, MOST> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("{}To{LEAST}To{MOST}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        list::<T>(generator, LEAST, MOST)
    }
}

/// The rows that a bend has hold of, each once (`LM7`).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "List<u32, 1, MAX_BEND_TOUCHES>")]
pub struct Touches(List<u32, 1, MAX_BEND_TOUCHES>);

impl Deref for Touches {
    type Target = [u32];

    fn deref(&self) -> &[u32] {
        &self.0
    }
}

impl TryFrom<List<u32, 1, MAX_BEND_TOUCHES>> for Touches {
    type Error = NotAllowed;

    fn try_from(rows: List<u32, 1, MAX_BEND_TOUCHES>) -> Result<Self, NotAllowed> {
        match (1..rows.len()).find(|&index| rows[..index].contains(&rows[index])) {
            Some(index) => Err(NotAllowed {
                at: format!("[{index}]"),
                ..NotAllowed::new(rows[index].to_string(), "a row that is touched once")
            }),
            None => Ok(Self(rows)),
        }
    }
}

impl TryFrom<Vec<u32>> for Touches {
    type Error = NotAllowed;

    fn try_from(rows: Vec<u32>) -> Result<Self, NotAllowed> {
        List::try_from(rows)?.try_into()
    }
}

written_as! { Touches as Vec<u32>; }
schemas! {
    Touches = |generator| {
        let mut schema = list::<u32>(generator, 1, MAX_BEND_TOUCHES);
        schema.insert("uniqueItems".into(), true.into());
        schema
    };
}
