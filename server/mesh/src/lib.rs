//! A plant as it is drawn.
//!
//! [`RingTable`] holds one quantised row per metamer: what clients mirror, chunk by chunk. [`wood`] makes
//! the triangles of wood for exports, and [`leaves`] says where leaves are. Lengths are in internodes.

pub mod checks;
mod course;
mod curve;
pub mod foliage;
pub mod grain;
pub mod leaves;
pub mod radius_code;
pub mod ring_table;
mod rotation_minimising;
pub mod sheet;
pub mod style;
pub mod triangle_mesh;
pub mod tubes;

pub use course::seeds;
pub use grain::Grain;
pub use ring_table::{Changes, RingTable};
pub use sheet::{Closing, Sheet};
pub use style::{Style, StyleOptions};
pub use triangle_mesh::TriangleMesh;
pub use tubes::{Bodies, Body, Wood, wood};
