//! The values of a skeleton: each type says what is allowed in its fields.

use std::{fmt, marker::PhantomData, ops::Deref};

use espalier_plant::{Organ, OrganKind, Organs, organs::MOST_ORGANS};
use espalier_reading::{Between, Bounded, NotAllowed};
use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, Error, IgnoredAny, SeqAccess, Unexpected, Visitor},
};

use crate::wood::{MAX_SHED, MAX_STEP};

/// The last row that a file may name.
const MAX_ROW: u32 = 1_000_000_000;

/// What says how to read the rest.
#[derive(Deserialize)]
pub(super) struct Head {
    #[serde(rename = "format")]
    _format: Name,
    pub version: Version,
}

/// What the format calls itself.
struct Name;

const NAME: &str = "espalier-skeleton";

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl Visitor<'_> for Reader {
            type Value = Name;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(NAME)
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Name, E> {
                (text == NAME).then_some(Name).ok_or_else(|| E::unknown_variant(text, &[NAME]))
            }
        }

        deserializer.deserialize_str(Reader)
    }
}

/// A version that is read.
#[derive(Clone, Copy)]
pub(super) enum Version {
    First,
    Second,
}

impl<'de> Deserialize<'de> for Version {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = Bounded(Between(1, 2), &"1 or 2").deserialize(deserializer)?;
        Ok(if number == 1 { Self::First } else { Self::Second })
    }
}

/// Declares numbers by their type, their least and their most, and what is said to be allowed.
macro_rules! numbers {
    ($($(#[doc = $doc:literal])+ $name:ident: $type:ident from $least:expr, to $most:expr, $allowed:expr;)+) => { $(
        $(#[doc = $doc])+
        #[derive(Clone, Copy)]
        pub(super) struct $name(pub $type);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Bounded(Between($least, $most), &$allowed).deserialize(deserializer).map(Self)
            }
        }
    )+ };
}

numbers! {
    /// The metamer that one grows from.
    Parent: u32 from 0, to u32::MAX, "null, or the number of a metamer that stands before this one, from 0";
    /// The row of a metamer.
    Row: u32 from 0, to MAX_ROW, Between(0, MAX_ROW);
    /// The axis of a metamer.
    AxisNumber: u32 from 0, to u32::MAX, "the number of an axis, from 0";
    /// The metamer that bears an axis.
    Bearer: u32 from 0, to u32::MAX, "null, or the number of a metamer, from 0";
    /// How many axes lie below that of a metamer.
    Order: u32 from 0, to u32::MAX, Between(0, u32::MAX);
    /// The step in which a metamer grew.
    Birth: u32 from 0, to MAX_STEP, Between(0, MAX_STEP);
    /// Tips of twigs that were shed.
    Shed: u32 from 0, to MAX_SHED, Between(0, MAX_SHED);
    /// A radius, or a width.
    Girth: f64 from 0.0, to f64::MAX, "0 and more";
}

/// Organs that a metamer is given.
pub(super) struct Borne(pub Organs);

impl<'de> Deserialize<'de> for Borne {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl<'de> Visitor<'de> for Reader {
            type Value = Borne;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of up to {MOST_ORGANS} organs")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Borne, A::Error> {
                let mut all = Vec::new();
                while let Some(OneOrgan(organ)) = entries.next_element()? {
                    if all.len() == MOST_ORGANS {
                        let allowed = format!("a list of up to {MOST_ORGANS} organs");
                        return Err(A::Error::custom(NotAllowed::new("longer list", allowed)));
                    }
                    all.push(organ);
                }
                Ok(Borne(all.into()))
            }
        }

        deserializer.deserialize_seq(Reader)
    }
}

/// One of them.
struct OneOrgan(Organ);

impl<'de> Deserialize<'de> for OneOrgan {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        const ALLOWED: &str =
            "[kind, azimuth, inclination, roll, length], whole numbers up to 2, 255, 255, 63 and 255";
        let wrong = |found: String| D::Error::custom(NotAllowed::new(found, ALLOWED));
        let numbers = Vec::<u8>::deserialize(deserializer)?;
        let [kind, azimuth, inclination, roll, length] = numbers[..] else {
            return Err(wrong(format!("list of {}", numbers.len())));
        };
        let kind = OrganKind::ALL.get(usize::from(kind)).copied().filter(|_| roll < 64);
        let kind = kind.ok_or_else(|| wrong(format!("{numbers:?}")))?;
        Ok(Self(Organ { kind, azimuth, inclination, roll, length }))
    }
}

/// Three numbers.
#[derive(Clone, Copy)]
pub(super) struct Vector<T>(pub [T; 3]);

/// A number of a [`Vector`].
pub(super) trait Coordinate: Sized {
    /// Any that is finite.
    const ANY: Bounded<'static, Self>;
}

impl Coordinate for f32 {
    const ANY: Bounded<'static, Self> = Bounded(Between(Self::MIN, Self::MAX), &"a number");
}

impl Coordinate for f64 {
    const ANY: Bounded<'static, Self> = Bounded(Between(Self::MIN, Self::MAX), &"a number");
}

impl<'de, T: Coordinate + Copy + Default> Deserialize<'de> for Vector<T>
where
    Bounded<'static, T>: DeserializeSeed<'de, Value = T>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader<T>(PhantomData<T>);

        impl<'de, T: Coordinate + Copy + Default> Visitor<'de> for Reader<T>
        where
            Bounded<'static, T>: DeserializeSeed<'de, Value = T>,
        {
            type Value = Vector<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("three numbers")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Vector<T>, A::Error> {
                let mut numbers = [T::default(); 3];
                let mut count = 0;
                while let Some(number) = numbers.get_mut(count) {
                    let Some(found) = entries.next_element_seed(T::ANY)? else { break };
                    *number = found;
                    count += 1;
                }
                while entries.next_element::<IgnoredAny>()?.is_some() {
                    count += 1;
                }
                let found = format!("list of {count}");
                let wrong = || A::Error::invalid_type(Unexpected::Other(&found), &self);
                (count == 3).then_some(Vector(numbers)).ok_or_else(wrong)
            }
        }

        deserializer.deserialize_seq(Reader(PhantomData))
    }
}

/// Declares lists of at least one entry.
macro_rules! lists {
    ($($(#[doc = $doc:literal])+ $name:ident: $allowed:literal;)+) => { $(
        $(#[doc = $doc])+
        pub(super) struct $name<T>(Vec<T>);

        impl<T> Deref for $name<T> {
            type Target = [T];

            fn deref(&self) -> &[T] {
                &self.0
            }
        }

        impl<'de, T: Deserialize<'de>> Deserialize<'de> for $name<T> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Reader<T>(PhantomData<T>);

                impl<'de, T: Deserialize<'de>> Visitor<'de> for Reader<T> {
                    type Value = $name<T>;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str($allowed)
                    }

                    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<$name<T>, A::Error> {
                        let mut all = Vec::new();
                        while let Some(entry) = entries.next_element()? {
                            all.push(entry);
                        }
                        let none = || A::Error::custom(concat!("too few: no entries, expected ", $allowed));
                        (!all.is_empty()).then_some($name(all)).ok_or_else(none)
                    }
                }

                deserializer.deserialize_seq(Reader(PhantomData))
            }
        }
    )+ };
}

lists! {
    /// All metamers.
    Metamers: "a list of 1 metamer or more, seeds first";
    /// All axes.
    Axes: "a list of 1 axis or more";
}
