//! How the vertices of a swept body hang together, for what unrolls it.

/// The parts of one body by their vertices, as they stand in its mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Sides of the tube. A ring has one vertex more, for its last one stands where the first does.
    pub sides: u32,
    /// The first vertex of each ring, from the foot to the end; two at least.
    pub rings: Vec<u32>,
    /// The first vertex of the face at the foot: a rim like a ring, then for each side the middle.
    pub foot: u32,
    /// What closes the end.
    pub end: Closing,
}

/// What closes the end of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// A cone on the last ring, with an apex for each side from this vertex on.
    Cone(u32),
    /// The face of a cut, as that at the foot is.
    Face(u32),
}
