//! Plain values between the wire and the core: what has the same name on both sides is the same thing.

/// A value as the other side has it.
pub(crate) trait Across<To> {
    fn across(self) -> To;
}

macro_rules! same_on_both_sides {
    ($($type:ty),+) => { $(impl Across<$type> for $type { fn across(self) -> $type { self } })+ };
}

same_on_both_sides!(f32, u32, bool, [u8; 3]);

/// Takes every variant across by name, both ways, so that a variant on one side alone does not compile.
macro_rules! enums {
    ($($one:ty = $other:ty { $($variant:ident),+ $(,)? })+) => { $(
        impl $crate::across::Across<$one> for $other {
            fn across(self) -> $one { match self { $(Self::$variant => <$one>::$variant),+ } }
        }
        impl $crate::across::Across<$other> for $one {
            fn across(self) -> $other { match self { $(Self::$variant => <$other>::$variant),+ } }
        }
    )+ };
}

/// The same for structs, field by field.
macro_rules! structs {
    ($($one:ident = $other:path { $($name:ident),+ $(,)? })+) => { $(
        impl $crate::across::Across<$one> for $other {
            fn across(self) -> $one { $one { $($name: self.$name.across()),+ } }
        }
        impl $crate::across::Across<$other> for $one {
            fn across(self) -> $other { $other { $($name: self.$name.across()),+ } }
        }
    )+ };
}

pub(crate) use {enums, structs};
