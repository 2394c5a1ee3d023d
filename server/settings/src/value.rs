//! Types that a setting can have.

use std::fmt::{self, Formatter};

use serde::{
    Deserializer,
    de::{DeserializeSeed, Error, SeqAccess, Unexpected, Visitor},
};

use crate::setting::{Kind, Setting};

/// A colour: red, green and blue in sRGB.
pub type Tint = [u8; 3];

/// A type that a setting can have.
pub trait Value: Copy {
    /// What a setting of this type can be, before its row narrows it.
    const KIND: Kind;

    /// The value as a number and as text, if it is a number.
    fn number(self) -> Option<(f64, String)> {
        None
    }

    /// Reads a value; an error says what the row allows. A number outside its range is no error yet.
    fn read<'de, D: Deserializer<'de>>(deserializer: D, row: &Setting) -> Result<Self, D::Error>;
}

impl Value for f32 {
    const KIND: Kind = Kind::Number { least: Self::MIN, most: Self::MAX, step: 0.01 };

    fn number(self) -> Option<(f64, String)> {
        Some((f64::from(self), self.to_string()))
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D, row: &Setting) -> Result<Self, D::Error> {
        deserializer.deserialize_f32(Reader(row, |number| match number {
            Number::Float(value) => Some(value as Self),
            Number::Whole(value) => Some(value as Self),
            Number::Negative(value) => Some(value as Self),
        }))
    }
}

impl Value for u32 {
    const KIND: Kind = Kind::Number { least: 0.0, most: Self::MAX as f32, step: 1.0 };

    fn number(self) -> Option<(f64, String)> {
        Some((f64::from(self), self.to_string()))
    }

    fn read<'de, D: Deserializer<'de>>(deserializer: D, row: &Setting) -> Result<Self, D::Error> {
        deserializer.deserialize_u32(Reader(row, |number| match number {
            Number::Whole(value) => Self::try_from(value).ok(),
            Number::Float(_) | Number::Negative(_) => None,
        }))
    }
}

/// A number as a format may hold it.
enum Number {
    Whole(u64),
    Negative(i64),
    Float(f64),
}

/// Reads a number; `None` is one that the type cannot hold.
struct Reader<'a, V>(&'a Setting, fn(Number) -> Option<V>);

impl<V> Visitor<'_> for Reader<'_, V> {
    type Value = V;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.allowed())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<V, E> {
        self.1(Number::Whole(value)).ok_or_else(|| E::invalid_value(Unexpected::Unsigned(value), &self))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<V, E> {
        self.1(Number::Negative(value)).ok_or_else(|| E::invalid_value(Unexpected::Signed(value), &self))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<V, E> {
        self.1(Number::Float(value)).ok_or_else(|| E::invalid_value(Unexpected::Float(value), &self))
    }
}

impl Value for bool {
    const KIND: Kind = Kind::Switch;

    fn read<'de, D: Deserializer<'de>>(deserializer: D, row: &Setting) -> Result<Self, D::Error> {
        struct Reader<'a>(&'a Setting);

        impl Visitor<'_> for Reader<'_> {
            type Value = bool;

            fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
                f.write_str(&self.0.allowed())
            }

            fn visit_bool<E: Error>(self, value: bool) -> Result<bool, E> {
                Ok(value)
            }
        }

        deserializer.deserialize_bool(Reader(row))
    }
}

impl Value for Tint {
    const KIND: Kind = Kind::Colour;

    fn read<'de, D: Deserializer<'de>>(deserializer: D, row: &Setting) -> Result<Self, D::Error> {
        struct Reader<'a>(&'a Setting);

        impl<'de> Visitor<'de> for Reader<'_> {
            type Value = Tint;

            fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
                f.write_str(&self.0.allowed())
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Tint, A::Error> {
                let mut tint = [0; 3];
                for (index, part) in tint.iter_mut().enumerate() {
                    *part = parts
                        .next_element_seed(Channel)?
                        .ok_or_else(|| A::Error::invalid_length(index, &self))?;
                }
                match parts.next_element_seed(Channel)? {
                    None => Ok(tint),
                    Some(_) => Err(A::Error::invalid_length(tint.len() + 1, &self)),
                }
            }
        }

        deserializer.deserialize_seq(Reader(row))
    }
}

/// Reads one part of a colour.
struct Channel;

impl<'de> DeserializeSeed<'de> for Channel {
    type Value = u8;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<u8, D::Error> {
        deserializer.deserialize_u8(self)
    }
}

impl Visitor<'_> for Channel {
    type Value = u8;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("a whole number, 0 to 255")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<u8, E> {
        u8::try_from(value).map_err(|_| E::invalid_value(Unexpected::Unsigned(value), &self))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<u8, E> {
        Err(E::invalid_value(Unexpected::Signed(value), &self))
    }
}
