//! What surfaces look like: textures made of the clients' pictures for one look, and the colours that they are multiplied
//! by at each vertex.

pub(crate) mod bark;
pub(crate) mod thin;

use glam::{Vec2, Vec3};

use crate::{colour::encoded, png};

/// How often a texture stands side by side and one above the other in a picture.
pub(crate) type Cells = [usize; 2];
/// Once.
pub(crate) const ONE_CELL: Cells = [1, 1];

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
    /// How far what is seen lies in front of the card that shows it; none where a surface is what it seems.
    pub depth: Option<Depth>,
}

/// Depths of the texels of a picture.
#[derive(Clone, Debug)]
pub(crate) struct Depth {
    /// From 0, which is `far`, to 1, which is `near`.
    pub shares: Vec<f32>,
    /// How far in front of the card they are, in internodes; behind it where they are negative.
    pub far: f32,
    pub near: f32,
}

impl Depth {
    /// What a file says of it, with so many metres in an internode.
    pub(crate) fn about(&self, metres: f32) -> [(&'static str, f32); 2] {
        [("far", self.far * metres), ("near", self.near * metres)]
    }
}

impl Texture {
    /// The colours times each of some tints as a PNG file, with cover where there is nothing in places: so many cells
    /// across and up, one for each tint from the foot on, and nothing in those left over.
    pub(crate) fn colour_png(&self, tints: &[Vec3], cells: Cells) -> Vec<u8> {
        if self.cover.iter().all(|&cover| cover == 255) && tints.len() == cells[0] * cells[1] {
            return self.png(cells, |texel, cell| encoded(self.colours[texel] * tints[cell]));
        }
        self.png(cells, |texel, cell| match tints.get(cell) {
            None => [0; 4],
            Some(&tint) => {
                let [r, g, b] = encoded(self.colours[texel] * tint);
                [r, g, b, self.cover[texel]]
            }
        })
    }

    /// The normals as a PNG file.
    pub(crate) fn normal_png(&self) -> Vec<u8> {
        self.png(ONE_CELL, |texel, _| (self.normals[texel] * 0.5 + 0.5).to_array().map(byte))
    }

    /// How much of the sky is seen (red) and how rough it is (green) as a PNG file, where it says so.
    pub(crate) fn exposure_png(&self) -> Option<Vec<u8>> {
        let exposure = self.exposure.as_ref()?;
        Some(self.png(ONE_CELL, |texel, _| {
            let [sky, rough] = exposure[texel];
            [byte(sky), byte(rough), 0]
        }))
    }

    /// The depths as a PNG file, black for the farthest, where it says so.
    pub(crate) fn depth_png(&self) -> Option<Vec<u8>> {
        let depth = self.depth.as_ref()?;
        Some(self.png(ONE_CELL, |texel, _| [byte(depth.shares[texel])]))
    }

    /// A picture of so many cells, each of which has all texels.
    fn png<const CHANNELS: usize>(
        &self,
        [across, up]: Cells,
        texel: impl Fn(usize, usize) -> [u8; CHANNELS],
    ) -> Vec<u8> {
        let mut pixels = Vec::with_capacity(across * up * self.side * self.side);
        // An image's first row is its top.
        for line in (0..up * self.side).rev() {
            let (row, y) = (line / self.side, line % self.side);
            for cell in row * across..(row + 1) * across {
                pixels.extend((y * self.side..(y + 1) * self.side).map(|at| texel(at, cell)));
            }
        }
        png::picture([across * self.side, up * self.side], &pixels)
    }

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

fn byte(share: f32) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
