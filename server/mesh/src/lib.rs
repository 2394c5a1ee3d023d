//! A plant as it is drawn.
//!
//! [`RingTable`] holds one quantised row per metamer: what clients mirror, chunk by chunk. [`wood`] makes
//! the triangles of wood for exports, and [`leaves`] says where leaves are. Lengths are in internodes.

pub mod checks;
mod drawn;
pub mod dyes;
pub mod foliage;
pub mod grain;
pub mod leaves;
mod limbs;
pub mod radius_code;
pub mod ring_table;
mod rotation_minimising;
mod rows;
pub mod sheet;
pub mod style;
pub mod triangle_mesh;
pub mod tubes;

pub use drawn::course::seeds;
pub use dyes::{Dye, Dyes, RowDyes};
pub use grain::Grain;
pub use limbs::{Limb, Limbs};
pub use ring_table::{Changes, Detail, RingTable};
pub use rows::{BrokenRows, NONE, Row, Rows};
pub use sheet::{Closing, Sheet};
pub use style::{Style, StyleOptions};
pub use triangle_mesh::TriangleMesh;
pub use tubes::{Bodies, Body, Wood, wood};
