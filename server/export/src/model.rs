//! What can be chosen about a file of triangles.

/// How triangles are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Model {
    /// How finely.
    pub detail: Detail,
    /// Vertices in 8 and 16 bits (`KHR_mesh_quantization`).
    pub quantised: bool,
    /// Vertices and triangles packed by meshoptimizer (`EXT_meshopt_compression`).
    pub compressed: bool,
    /// Leaves as places of few meshes (`EXT_mesh_gpu_instancing` in glTF, `PointInstancer` in USD).
    pub instanced: bool,
    /// Convex bodies for collisions beside each plant.
    pub hull: bool,
    /// A node for each limb, where it begins.
    pub by_limb: bool,
    /// A second place for each vertex in a light map of so many texels square, one for each mesh.
    pub lightmap: Option<u32>,
    /// At most so many bones for each plant, and animations of its sway.
    pub sway: Option<u32>,
    /// Numbers for each vertex by which shaders move it in the wind (`glTF`).
    pub wind_weights: bool,
}

/// How finely plants are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// One level, from 0, the finest, to [`Detail::BILLBOARD`].
    Level(u8),
    /// All levels in one file.
    Set,
}

impl Detail {
    /// The coarsest level: two crossed cards with pictures of the plant.
    pub const BILLBOARD: u8 = 3;

    /// The levels that are written.
    pub(crate) fn levels(self) -> Vec<u8> {
        match self {
            Self::Level(level) => vec![level.min(Self::BILLBOARD)],
            Self::Set => (0..=Self::BILLBOARD).collect(),
        }
    }
}

impl Default for Detail {
    fn default() -> Self {
        Self::Level(0)
    }
}
