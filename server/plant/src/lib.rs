//! What a plant is, however it came to be.
//!
//! A [`Plant`] is an arena of metamers in birth order: parents stand before their children, so one backward
//! loop visits tips before bases and one forward loop bases before tips. An axis is a bud and what it has
//! grown; a bud that has not grown yet is an axis without metamers. Every row carries the step of its birth
//! and of its death, and the plant keeps its whole timeline: going back and forth in time only moves a cursor.

pub mod axes;
pub mod bend;
mod births;
pub mod capacity;
mod chains;
pub mod checks;
pub mod columns;
mod deaths;
pub mod edits;
pub mod future;
pub mod girth;
pub mod given;
pub mod hash;
pub mod id;
mod key_table;
pub mod metamers;
pub mod motion;
pub mod organs;
pub mod parts;
pub mod place;
pub mod plant;
pub mod resettled;
pub mod settling;
pub mod time_travel;
pub mod timeline;
mod tips;
pub mod widths;
pub mod wood;

pub use axes::Axes;
pub use bend::{Bend, BendState};
pub use capacity::reserve;
pub use columns::Columns;
pub use edits::{Carried, Edit};
pub use future::{Future, FutureParts};
pub use girth::Girth;
pub use given::{Given, GivenOrgans, GivenRadii};
pub use id::{AxisId, MetamerId};
pub use key_table::KeyTable;
pub use metamers::{Condition, Metamers};
pub use motion::Motion;
pub use organs::{Organ, OrganKind, Organs, Stance};
pub use parts::{BrokenPlant, PlantParts};
pub use place::BadColumns;
pub use plant::{Internode, Plant};
pub use resettled::{AxisEnds, Resettled};
pub use settling::{Claim, Claims, Settled};
pub use time_travel::TimeShift;
pub use widths::{Width, Widths};
pub use wood::{DormantBuds, Wood, WoodAxis, WoodNode};
