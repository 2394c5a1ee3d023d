//! Numbers between bounds.

use std::fmt;

use serde::{
    Deserializer,
    de::{DeserializeSeed, Error, Unexpected, Visitor},
};

/// The least and the most of a number.
#[derive(Clone, Copy, Debug)]
pub struct Between<T>(pub T, pub T);

impl<T: fmt::Display> fmt::Display for Between<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.0, self.1)
    }
}

/// Reads a number between bounds; `.1` says what is allowed.
pub struct Bounded<'a, T>(pub Between<T>, pub &'a dyn fmt::Display);

impl Visitor<'_> for Bounded<'_, u32> {
    type Value = u32;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.1.fmt(f)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<u32, E> {
        let Between(least, most) = self.0;
        let allowed = u32::try_from(value).ok().filter(|value| (least..=most).contains(value));
        allowed.ok_or_else(|| E::invalid_value(Unexpected::Unsigned(value), &self))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<u32, E> {
        Err(E::invalid_value(Unexpected::Signed(value), &self))
    }
}

impl Visitor<'_> for Bounded<'_, f32> {
    type Value = f32;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.1.fmt(f)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f32, E> {
        let (Between(least, most), value) = (self.0, value as f32);
        if (least..=most).contains(&value) {
            return Ok(value);
        }
        Err(E::invalid_value(Unexpected::Other(&value.to_string()), &self))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f32, E> {
        self.visit_f64(value as f64)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f32, E> {
        self.visit_f64(value as f64)
    }
}

impl Visitor<'_> for Bounded<'_, f64> {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.1.fmt(f)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        let Between(least, most) = self.0;
        if (least..=most).contains(&value) {
            return Ok(value);
        }
        Err(E::invalid_value(Unexpected::Other(&value.to_string()), &self))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        self.visit_f64(value as f64)
    }
}

impl<'de> DeserializeSeed<'de> for Bounded<'_, f32> {
    type Value = f32;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f32, D::Error> {
        deserializer.deserialize_f32(self)
    }
}

impl<'de> DeserializeSeed<'de> for Bounded<'_, u32> {
    type Value = u32;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<u32, D::Error> {
        deserializer.deserialize_u32(self)
    }
}

impl<'de> DeserializeSeed<'de> for Bounded<'_, f64> {
    type Value = f64;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f64, D::Error> {
        deserializer.deserialize_f64(self)
    }
}
