//! Tables of settings: from the rows come a struct of values and a struct of changes.

use std::{
    fmt::{self, Formatter},
    marker::PhantomData,
};

use serde::{
    Deserializer,
    de::{DeserializeSeed, Error, MapAccess, Visitor},
};

use crate::{setting::Setting, value::Value};

/// Some settings of a table.
pub(crate) trait Patch: Default {
    /// The table.
    const ROWS: &'static [Setting];
    /// The names of its rows.
    const NAMES: &'static [&'static str];

    /// Takes the value of a row; an error if it has one already.
    fn take<'de, A: MapAccess<'de>>(&mut self, row: &'static Setting, map: &mut A) -> Result<(), A::Error>;
}

/// Reads a patch field by field, each by its row.
pub(crate) fn read<'de, P: Patch, D: Deserializer<'de>>(deserializer: D) -> Result<P, D::Error> {
    deserializer.deserialize_map(Reader(PhantomData))
}

struct Reader<P>(PhantomData<P>);

impl<'de, P: Patch> Visitor<'de> for Reader<P> {
    type Value = P;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "an object with fields among {}", P::NAMES.join(", "))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<P, A::Error> {
        let mut patch = P::default();
        while let Some(row) = map.next_key_seed(RowName::<P>(PhantomData))? {
            patch.take(row, &mut map)?;
        }
        Ok(patch)
    }
}

/// Finds a row by its name.
struct RowName<P>(PhantomData<P>);

impl<'de, P: Patch> DeserializeSeed<'de> for RowName<P> {
    type Value = &'static Setting;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<P: Patch> Visitor<'_> for RowName<P> {
    type Value = &'static Setting;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&P::NAMES.join(", "))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Self::Value, E> {
        P::ROWS.iter().find(|row| row.name == name).ok_or_else(|| E::unknown_field(name, P::NAMES))
    }
}

/// Reads the value of a row into the place where it belongs.
pub(crate) fn take<'de, V: Value, A: MapAccess<'de>>(
    place: &mut Option<V>,
    row: &'static Setting,
    map: &mut A,
) -> Result<(), A::Error> {
    if place.is_some() {
        return Err(A::Error::duplicate_field(row.name));
    }
    *place = Some(map.next_value_seed(RowValue(row, PhantomData))?);
    Ok(())
}

struct RowValue<V>(&'static Setting, PhantomData<V>);

impl<'de, V: Value> DeserializeSeed<'de> for RowValue<V> {
    type Value = V;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<V, D::Error> {
        V::read(deserializer, self.0)
    }
}

/// Declares a struct of values and a struct of changes by a table. A row: what the setting is, its name, its type, its
/// default, then what else is known of it, as methods of [`Setting`]. The order of the rows is that of the JSON.
macro_rules! settings {
    ($(
        $(#[$about:meta])+ $values:ident / $(#[$about_patch:meta])* $patch:ident {
            $($(#[doc = $sentence:literal])+ $name:ident: $type:ty = $default:expr $(, $known:ident($($as:expr),+))*;)+
        }
    )+) => { $(
        #[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema, ts_rs::TS)]
        #[schemars(deny_unknown_fields, transform = $crate::schema::Rows($values::ROWS))]
        $(#[$about])+
        pub struct $values {
            $($(#[doc = $sentence])+ pub $name: $type,)+
        }

        #[doc = concat!("Some fields of [`", stringify!($values), "`]: those to change.")]
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, schemars::JsonSchema, ts_rs::TS)]
        #[schemars(deny_unknown_fields, transform = $crate::schema::Rows($values::ROWS))]
        $(#[$about_patch])*
        pub struct $patch {
            $(
                $(#[doc = $sentence])+
                #[serde(skip_serializing_if = "Option::is_none")]
                #[ts(optional)]
                pub $name: Option<$type>,
            )+
        }

        impl $values {
            /// The table.
            pub const ROWS: &'static [$crate::setting::Setting] = &[$(
                $crate::setting::Setting::new::<$type>(stringify!($name), concat!($($sentence),+))
                    $(.$known($($as),+))*
            ),+];
            /// The names of the rows.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($name)),+];

            /// Whether every number lies in its range; the error is about the first that does not.
            pub fn check(&self) -> Result<(), $crate::setting::OutOfRange> {
                let mut rows = Self::ROWS.iter();
                $(rows.next().map_or(Ok(()), |row| row.check(self.$name))?;)+
                Ok(())
            }

            /// What makes other values of these.
            #[must_use]
            pub fn change_to(&self, other: &Self) -> $patch {
                $patch { $($name: (self.$name != other.$name).then_some(other.$name),)+ }
            }

            /// These values with the patch's fields put in.
            #[must_use]
            pub fn patched(&self, patch: &$patch) -> Self {
                Self { $($name: patch.$name.unwrap_or(self.$name),)+ }
            }
        }

        impl Default for $values {
            fn default() -> Self {
                Self { $($name: $default,)+ }
            }
        }

        impl $patch {
            /// This patch with the fields of a later one put in.
            #[must_use]
            pub fn patched(&self, later: &Self) -> Self {
                Self { $($name: later.$name.or(self.$name),)+ }
            }

            /// The same patch with those fields only that are wanted, by their names.
            #[must_use]
            pub fn only(&self, is_wanted: impl Fn(&str) -> bool) -> Self {
                Self { $($name: self.$name.filter(|_| is_wanted(stringify!($name))),)+ }
            }

            /// The names of the fields it sets.
            pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
                [$((stringify!($name), self.$name.is_some())),+]
                    .into_iter()
                    .filter_map(|(name, is_set)| is_set.then_some(name))
            }
        }

        impl From<$values> for $patch {
            /// Sets every field.
            fn from(all: $values) -> Self {
                Self { $($name: Some(all.$name),)+ }
            }
        }

        impl $crate::table::Patch for $patch {
            const ROWS: &'static [$crate::setting::Setting] = $values::ROWS;
            const NAMES: &'static [&'static str] = $values::NAMES;

            fn take<'de, A: serde::de::MapAccess<'de>>(
                &mut self,
                row: &'static $crate::setting::Setting,
                map: &mut A,
            ) -> Result<(), A::Error> {
                match row.name {
                    $(stringify!($name) => $crate::table::take(&mut self.$name, row, map),)+
                    other => Err(serde::de::Error::unknown_field(other, Self::NAMES)),
                }
            }
        }

        impl<'de> serde::Deserialize<'de> for $patch {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::table::read(deserializer)
            }
        }

        impl<'de> serde::Deserialize<'de> for $values {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let given = $patch::deserialize(deserializer)?;
                let missing = serde::de::Error::missing_field;
                Ok(Self { $($name: given.$name.ok_or_else(|| missing(stringify!($name)))?,)+ })
            }
        }
    )+ };
}

pub(crate) use settings;
