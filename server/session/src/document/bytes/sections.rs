//! The kinds of sections: one line each. Another section or version is a line here and a module beside.

use std::fmt;

use super::lengths;

/// A released version of the program: major, minor, patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Release(pub u8, pub u8, pub u16);

impl Release {
    /// This program.
    pub(super) const THIS: Self = Self(
        decimal(env!("CARGO_PKG_VERSION_MAJOR")) as u8,
        decimal(env!("CARGO_PKG_VERSION_MINOR")) as u8,
        decimal(env!("CARGO_PKG_VERSION_PATCH")),
    );

    /// Patch in the low 16 bits, minor and major above.
    pub(super) fn to_number(self) -> u32 {
        u32::from(self.0) << 24 | u32::from(self.1) << 16 | u32::from(self.2)
    }

    pub(super) fn from_number(number: u32) -> Self {
        Self((number >> 24) as u8, (number >> 16) as u8, number as u16)
    }
}

const fn decimal(digits: &str) -> u16 {
    let (mut number, mut rest) = (0, digits.as_bytes());
    while let [digit, behind @ ..] = rest {
        number = number * 10 + (*digit - b'0') as u16;
        rest = behind;
    }
    number
}

impl fmt::Display for Release {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}.{}", self.0, self.1, self.2)
    }
}

/// What this program knows of a section.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Kind {
    pub(crate) tag: [u8; 4],
    /// What errors call it.
    pub(crate) name: &'static str,
    /// The version that is written; all up to it are read.
    pub(super) version: u16,
    /// The first release that reads this version.
    pub(super) since: Release,
    /// Whether a program that does not know the section cannot read the document.
    pub(super) is_required: bool,
    /// The most bytes that it unpacks to.
    pub(crate) most: u64,
}

/// The first release with sections.
const FIRST: Release = Release(0, 2, 0);

const fn first(tag: [u8; 4], name: &'static str, most: u64) -> Kind {
    Kind { tag, name, version: 1, since: FIRST, is_required: true, most }
}

/// Rows: metamers and axes.
pub(super) const PLANT: Kind = first(*b"PLNT", "plant", lengths::PLANT);
/// Where steps end, what was done to wood, the present.
pub(super) const TIMELINE: Kind = first(*b"TIME", "timeline", lengths::TIMELINE);
/// Width constraints of the present; none if it is not there.
pub(super) const WIDTHS: Kind = first(*b"WIDT", "widths", lengths::WIDTHS);
/// Radii given in the present; none if it is not there.
pub(super) const GIVEN_RADII: Kind = first(*b"RADI", "given radii", lengths::GIVEN_RADII);
/// Organs given in the present; where it is not there no step gives any.
pub(super) const GIVEN_ORGANS: Kind = first(*b"ORGN", "organs", lengths::GIVEN_ORGANS);
/// What the next step of growth depends on beside plant and obstacles.
pub(super) const GROWTH: Kind = Kind { version: 2, ..first(*b"GROW", "growth", lengths::GROWTH) };
/// What the brushes of strokes in progress have swept, and whether wood has come to their paths; nothing if it is not
/// there.
pub(super) const SWEEPS: Kind = Kind { version: 2, ..first(*b"SWEP", "sweeps", lengths::SWEEPS) };
/// Every set of parameters that an operation holds.
pub(super) const PARAMETERS: Kind = first(*b"PARA", "parameters", lengths::PARAMETERS);
/// Programmes, which parameters belong to which, and the ages they have led to; none if it is not there.
pub(super) const PROGRAMMES: Kind = first(*b"PROG", "programmes", lengths::PROGRAMMES);
/// Grammars, and what they have written; none if it is not there.
pub(super) const GRAMMARS: Kind = Kind { version: 2, ..first(*b"GRAM", "grammars", lengths::GRAMMARS) };
/// Every look that an operation holds, and the present one.
pub(super) const LOOKS: Kind = first(*b"LOOK", "looks", lengths::LOOKS);
/// Meshes, every set of obstacles that an operation holds, and the present one.
pub(super) const OBSTACLES: Kind = first(*b"OBST", "obstacles", lengths::OBSTACLES);
/// The operations of the present line.
pub(super) const HISTORY: Kind = Kind { version: 3, ..first(*b"HIST", "history", lengths::HISTORY) };
/// Designs, and which operation leaves which in force; none if it is not there.
pub(super) const DESIGNS: Kind = first(*b"DSGN", "designs", lengths::DESIGNS);
/// Designs that were let go, of which wood keeps colours, and after which operations; none if it is not there.
pub(super) const LET_GO: Kind = first(*b"LETG", "designs let go", lengths::LET_GO);
/// All other lines; none if it is not there.
pub(super) const FUTURES: Kind = Kind { version: 3, ..first(*b"FUTU", "futures", lengths::FUTURES) };
/// Strokes and bends in progress; none if it is not there.
pub(super) const GESTURES: Kind = first(*b"GEST", "gestures", lengths::GESTURES);
/// The program that wrote the document; none if it is not there.
pub(super) const WRITER: Kind = Kind { is_required: false, ..first(*b"WRIT", "writer", lengths::WRITER) };
/// Of a session's snapshot alone: who has done how much. A document is whole without it.
pub(crate) const SESSION: Kind = first(*b"SESS", "session", lengths::SESSION);
/// The state of the generator that tests have; none if it never made a step. No release reads it.
#[cfg(test)]
pub(crate) const FORKS: Kind = Kind { since: Release(9, 0, 0), ..first(*b"FORK", "forks", 1_000_000) };

/// Those of documents that releases write, in the order in which they are written.
pub(super) const RELEASED: &[&Kind] = &[
    &PLANT,
    &TIMELINE,
    &WIDTHS,
    &GIVEN_RADII,
    &GIVEN_ORGANS,
    &GROWTH,
    &SWEEPS,
    &PARAMETERS,
    &PROGRAMMES,
    &GRAMMARS,
    &LOOKS,
    &OBSTACLES,
    &HISTORY,
    &DESIGNS,
    &LET_GO,
    &FUTURES,
    &GESTURES,
    &WRITER,
    &SESSION,
];

impl Kind {
    /// The kind with this tag, if it is known.
    pub(crate) fn of(tag: [u8; 4]) -> Option<&'static Self> {
        #[cfg(test)]
        if tag == FORKS.tag {
            return Some(&FORKS);
        }
        RELEASED.iter().copied().find(|kind| kind.tag == tag)
    }
}
