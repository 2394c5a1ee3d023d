//! What surfaces look like: textures made of the clients' pictures for one look, and the colours that they are multiplied
//! by at each vertex.

pub(crate) mod bark;
pub(crate) mod thin;

use glam::{Vec2, Vec3};

/// A square texture, line upon line from its foot.
#[derive(Clone, Debug)]
pub(crate) struct Texture {
    /// Texels along a side.
    pub side: usize,
    /// Linear, 0 to 1.
    pub colours: Vec<Vec3>,
    /// 0 where there is nothing to 255.
    pub cover: Vec<u8>,
    /// Unit normals: along u, along v, out of the surface.
    pub normals: Vec<Vec3>,
    /// How much of the sky is seen, and how rough it is; none where both are the same all over.
    pub exposure: Option<Vec<[f32; 2]>>,
}

impl Texture {
    /// The texel at a place; it comes again beyond the borders.
    pub(crate) fn texel(&self, at: Vec2) -> usize {
        let place = (at - at.floor()) * self.side as f32;
        let [x, y] = place.to_array().map(|place| (place as usize).min(self.side - 1));
        y * self.side + x
    }

    /// Whether there is anything at a place.
    pub(crate) fn is_there(&self, at: Vec2) -> bool {
        self.cover[self.texel(at)] >= 128
    }
}
