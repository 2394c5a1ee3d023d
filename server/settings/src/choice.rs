//! Settings that are one of some names.

use std::{
    fmt::{self, Formatter},
    marker::PhantomData,
};

use serde::{
    Deserializer,
    de::{Error, Visitor},
};

/// An enum that travels as a name.
pub(crate) trait Choice: Copy + 'static {
    /// All of them, each with its name.
    const NAMED: &'static [(&'static str, Self)];
}

/// Reads a choice by its name; an error lists all names.
pub(crate) fn read<'de, C: Choice, D: Deserializer<'de>>(deserializer: D) -> Result<C, D::Error> {
    deserializer.deserialize_str(Reader(PhantomData))
}

struct Reader<C>(PhantomData<C>);

impl<C: Choice> Visitor<'_> for Reader<C> {
    type Value = C;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&names::<C>())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<C, E> {
        let found = C::NAMED.iter().find(|(name, _)| *name == text);
        found
            .map(|&(_, choice)| choice)
            .ok_or_else(|| E::custom(format_args!("unknown name `{text}`, expected {}", names::<C>())))
    }
}

fn names<C: Choice>() -> String {
    C::NAMED.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}

/// Declares an enum whose variants have names, as which they travel.
macro_rules! choices {
    ($($(#[$about:meta])+ $choice:ident { $($(#[$of:meta])+ $variant:ident = $name:literal,)+ })+) => { $(
        $(#[$about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, schemars::JsonSchema, ts_rs::TS)]
        pub enum $choice {
            $($(#[$of])+ #[serde(rename = $name)] $variant,)+
        }

        impl $choice {
            /// All of them, in their order.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
            /// The names, in their order.
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// The name of this one.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }
        }

        impl $crate::choice::Choice for $choice {
            const NAMED: &'static [(&'static str, Self)] = &[$(($name, Self::$variant)),+];
        }

        impl $crate::value::Value for $choice {
            const KIND: $crate::setting::Kind = $crate::setting::Kind::Choice { choices: Self::NAMES };

            fn read<'de, D: serde::Deserializer<'de>>(
                deserializer: D,
                _row: &$crate::setting::Setting,
            ) -> Result<Self, D::Error> {
                $crate::choice::read(deserializer)
            }
        }

        impl<'de> serde::Deserialize<'de> for $choice {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::choice::read(deserializer)
            }
        }
    )+ };
}

pub(crate) use choices;
