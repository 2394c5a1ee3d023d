//! Invariants of what is drawn, one a file. Property tests run all that apply.

mod closed_wood;
mod finite_vertices;
mod table_mirrors_plant;
mod true_triangles;

use espalier_plant::Plant;

use crate::{ring_table::RingTable, style::Style, triangle_mesh::TriangleMesh, tubes::Wood};

/// An invariant that does not hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{check}: {detail}")]
pub struct Failure {
    /// The invariant.
    pub check: &'static str,
    /// Where it fails, and how.
    pub detail: String,
}

/// Checks a table against the plant it was last synced with.
pub fn table(table: &RingTable, plant: &Plant, style: &Style) -> Result<(), Failure> {
    table_mirrors_plant::check(table, plant, style)
}

/// Checks a mesh.
pub fn mesh(mesh: &TriangleMesh) -> Result<(), Failure> {
    finite_vertices::check(mesh)?;
    true_triangles::check(mesh)
}

/// Checks the wood of a plant.
pub fn wood(wood: &Wood) -> Result<(), Failure> {
    mesh(&wood.surface)?;
    closed_wood::check(wood)
}

fn require(check: &'static str, holds: bool, detail: impl FnOnce() -> String) -> Result<(), Failure> {
    if holds { Ok(()) } else { Err(Failure { check, detail: detail() }) }
}
