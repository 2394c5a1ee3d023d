//! Design graphs: a plant described from its outline inwards (Boudon et al. 2003), and the wood that follows from it.
//!
//! A [`Graph`] holds what somebody said of branches: values of parameters ([`Key`]) that are explicit, relative, shared or
//! inherited. A [`Design`] is a graph with the values of all its branches; an [`Edit`] changes it as a whole or is refused.
//! A [`Generator`] makes wood of it, limb by limb, and each branch reaches with its tip the outline of the one that bears
//! it. Lengths are in internodes, Y is up, angles are in degrees.

mod axis;
mod block;
mod chance;
mod curve;
mod design;
mod dyes;
mod edit;
mod envelope;
mod file;
mod fitting;
mod frame;
mod function;
mod generator;
mod graph;
pub mod hands;
mod key;
mod limb;
mod merging;
mod node;
mod patch;
mod places;
mod provenance;
mod refusal;
mod resolution;
mod slots;
mod table;
mod templates;
mod value;

pub use axis::Placed;
pub use block::{Block, Seal};
pub use curve::Curve;
pub use design::{Applied, Design};
pub use dyes::Dyes;
pub use edit::{Edit, Standing, relative_range};
pub use envelope::{Envelope, Half};
pub use file::{MOST_BYTES, VERSION};
pub use fitting::{Fitted, Fitting, GrownLimb, Limits, MOST_ORDERS, Unfit, fit};
pub use function::Function;
pub use generator::{Generated, Generator, MAX_INTERNODES, Missing};
pub use graph::{From, Graph, Level, Name, Owner, Record, Setting, Share, ShareId, Source, Visibility};
pub use key::{COUNT, Key, ROWS, Row};
pub use node::{MAX_ORDER, MAX_ORDINAL, NodeId};
pub use patch::Patch;
pub use places::MOST_LATERALS;
pub use provenance::{Origin, Status, Stop};
pub use refusal::{MAX_BATCH, MAX_SHARES, MAX_VALUES, Place, Refusal};
pub use resolution::{Branch, MAX_BRANCHES, Reached};
pub use slots::Slot;
pub use table::Table;
pub use templates::{TEMPLATES, Template};
pub use value::{Held, Kind, Material, Op, Value, combined};
