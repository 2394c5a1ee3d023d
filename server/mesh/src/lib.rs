//! A plant as it is drawn.
//!
//! [`RingTable`] holds one quantised row per metamer: what clients mirror, chunk by chunk. [`wood`] and
//! [`leaf_mesh`] make whole triangle meshes for exports. Lengths are in internodes.

pub mod blades;
pub mod checks;
mod course;
mod curve;
pub mod foliage;
pub mod leaves;
pub mod radius_code;
pub mod ring_table;
mod rotation_minimising;
pub mod style;
pub mod triangle_mesh;
pub mod tubes;

pub use blades::leaf_mesh;
pub use course::seeds;
pub use ring_table::{Changes, RingTable};
pub use style::{Style, StyleOptions};
pub use triangle_mesh::TriangleMesh;
pub use tubes::{Wood, wood};
