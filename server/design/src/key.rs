//! The parameters of a design, one row each.

use std::{fmt, sync::LazyLock};

use glam::Vec3;

use crate::{
    curve::Curve,
    envelope::Envelope,
    function::Function,
    value::{Held, Kind, Material, Value},
};

/// What is known of a parameter.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Its key.
    pub key: Key,
    /// Its name in files.
    pub name: &'static str,
    /// What kind of value it has.
    pub kind: Kind,
    /// The least and the greatest number in it.
    pub range: (f32, f32),
    /// Its unit.
    pub unit: &'static str,
    /// Whether only the root has it.
    pub is_of_root: bool,
    /// What it does.
    pub sentence: &'static str,
}

macro_rules! keys {
    ($($(#[doc = $sentence:literal])+ $key:ident = $name:literal: $kind:ident, $range:expr, $unit:literal, $root:literal, $default:expr;)+) => {
        /// A parameter of a design.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Key {
            $($(#[doc = $sentence])+ $key,)+
        }

        /// All parameters in the order of their keys.
        pub const ROWS: [Row; COUNT] = [
            $(Row {
                key: Key::$key,
                name: $name,
                kind: Kind::$kind,
                range: $range,
                unit: $unit,
                is_of_root: $root,
                sentence: concat!($($sentence),+),
            },)+
        ];

        /// How many parameters there are.
        pub const COUNT: usize = [$($name,)+].len();

        static DEFAULTS: LazyLock<[Held; COUNT]> = LazyLock::new(|| [$(Held::new($default),)+]);
    };
}

keys! {
    /// Length of the plant from its base to its tip.
    Height = "height": Scalar, (4.0, 400.0), "internodes", true, Value::Scalar(60.0);
    /// Radius of the stem at its base.
    Stem = "stem": Scalar, (0.05, 40.0), "internodes", true, Value::Scalar(1.2);
    /// Outline of everything that grows from this axis, whose size follows from the bearer's outline.
    Silhouette = "silhouette": Envelope, (-4.0, 4.0), "", false, Value::Envelope(Envelope::default());
    /// Course of the axis.
    Axis = "axis": Curve, (-4.0, 4.0), "", false, Value::Curve(Curve::straight());
    /// Length as a multiple of the way to the bearer's outline.
    Reach = "reach": Scalar, (0.0, 3.0), "", false, Value::Scalar(1.0);
    /// Where the axis is cut off, as a share of its length; 1 leaves it whole.
    Cut = "cut": Scalar, (0.0, 1.0), "", false, Value::Scalar(1.0);
    /// Turn of the branch about its base, as a vector along whose direction it turns, in the bearer's frame.
    Turn = "turn": Vector, (-180.0, 180.0), "degrees", false, Value::Vector(Vec3::ZERO);
    /// Turn of a branch about its own axis; the stem does not turn.
    Roll = "roll": Scalar, (-360.0, 360.0), "degrees", false, Value::Scalar(0.0);
    /// Where all branches are drawn to: 1 weighs as much as their own direction; Y is up.
    Pull = "pull": Vector, (-8.0, 8.0), "", false, Value::Vector(Vec3::ZERO);
    /// Laterals that the axis would bear if all of it were as here.
    Density = "density": Function, (0.0, 60.0), "laterals an axis", false, Value::Function(Function::constant(8.0));
    /// Where along the axis laterals begin and end.
    Zone = "zone": Span, (0.0, 1.0), "", false, Value::Span(0.15, 0.95);
    /// Laterals at one place.
    Whorl = "whorl": Whole, (1.0, 6.0), "", false, Value::Scalar(1.0);
    /// Angle around the axis from each place of laterals to the next.
    Phyllotaxis = "phyllotaxis": Scalar, (-360.0, 360.0), "degrees", false, Value::Scalar(137.5);
    /// Angle around the axis of its first lateral, from the side that looks up.
    Azimuth = "azimuth": Scalar, (-360.0, 360.0), "degrees", false, Value::Scalar(90.0);
    /// Angle between the axis and its laterals.
    BranchingAngle = "branching_angle": Function, (0.0, 180.0), "degrees", false, Value::Function(Function::line(80.0, 40.0));
    /// How much chance bends the axis and turns its laterals.
    Irregularity = "irregularity": Scalar, (0.0, 1.0), "", false, Value::Scalar(0.0);
    /// Order up to which branches stand here: 1 for limbs, 2 for their branches.
    Orders = "orders": Whole, (0.0, 4.0), "", false, Value::Scalar(3.0);
    /// Longest internode.
    Internode = "internode": Scalar, (0.25, 4.0), "internodes", false, Value::Scalar(1.0);
    /// Radius at the base as a share of the bearer's radius there.
    Girth = "girth": Scalar, (0.02, 1.5), "", false, Value::Scalar(0.55);
    /// Radius along the axis as a share of that at its base.
    Taper = "taper": Function, (0.02, 1.5), "", false, Value::Function(Function::line(1.0, 0.25));
    /// Leaves at each internode above the highest branch of an axis.
    Leaves = "leaves": Function, (0.0, 16.0), "leaves an internode", false, Value::Function(Function::constant(3.0));
    /// Size of leaves as a multiple of the document's.
    LeafSize = "leaf_size": Scalar, (0.05, 8.0), "", false, Value::Scalar(1.0);
    /// Colours of bark and leaves as multiples of the document's.
    Material = "material": Material, (0.0, 4.0), "", false, Value::Material(Material { bark: [1.0; 3], leaves: [1.0; 3] });
    /// Whether the branch is there: 1, or 0 where it was cut away.
    Shown = "shown": Whole, (0.0, 1.0), "", false, Value::Scalar(1.0);
}

impl Key {
    /// What is known of it.
    pub fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// The value of a root that says nothing.
    pub fn default(self) -> &'static Held {
        &DEFAULTS[self as usize]
    }

    /// The parameter of a name.
    pub fn named(name: &str) -> Option<Self> {
        ROWS.iter().find(|row| row.name == name).map(|row| row.key)
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        ROWS.iter().map(|row| row.key)
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row().name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::check;

    #[test]
    fn each_row_stands_at_its_key_and_holds_its_own_default() {
        for (at, row) in ROWS.iter().enumerate() {
            assert_eq!((row.key as usize, Key::named(row.name)), (at, Some(row.key)));
            let default = row.key.default().get();
            assert_eq!(check(default, row.kind, row.range), Ok(()), "{}", row.name);
        }
    }
}
