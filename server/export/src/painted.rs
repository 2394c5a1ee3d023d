//! The pictures that clients paint of leaves, flowers, fruits and bark, as they were written down.
//!
//! After a deliberate change in `client/src/scene/painting`: `UPDATE_GOLDEN=1 npx vitest run painted` there.

use std::{collections::BTreeMap, sync::LazyLock};

use espalier_settings::{BarkKind, FlowerKind, FruitKind, LeafKind};
use glam::Vec2;
use serde::Deserialize;

/// How the pictures are laid out, and what their bytes mean.
#[derive(Debug, Deserialize)]
pub(crate) struct Layout {
    /// Pictures of one thing along each side of its atlas.
    pub tiles: u8,
    /// What is painted keeps so far from the edges of its tile, in its own length.
    pub margin: f32,
    /// The shade of bark that a byte of 255 stands for.
    pub most_shade: f32,
    /// The slope of bark that a byte of 255 stands for.
    pub most_slope: f32,
    /// Half the width of each kind of leaf, in its own length.
    pub leaf_reach: BTreeMap<String, f32>,
}

/// The layout of all pictures.
pub(crate) static LAYOUT: LazyLock<Layout> = LazyLock::new(|| {
    let text = include_str!("../painted/layout.json");
    serde_json::from_str(text)
        .unwrap_or_else(|error| unreachable!("the layout is kept with the sources: {error}"))
});

/// A square of texels, line upon line from its foot.
#[derive(Clone, Debug)]
pub(crate) struct Painted {
    /// Texels along a side.
    pub side: usize,
    /// Of an atlas half the brightness, share of the second colour, sheerness, coverage. Of bark the shares of its three
    /// colours, the first by its shade, and height.
    pub colours: Vec<[u8; 4]>,
    /// Of an atlas the normal across and along about 128, wood, margin. Of bark the slopes around and along, how much of
    /// the sky is seen, and height.
    pub relief: Vec<[u8; 4]>,
}

macro_rules! kept {
    ($kind:expr, $sort:literal: $($name:literal)+) => {
        match $kind {
            $($name => include_bytes!(concat!("../painted/", $sort, "-", $name, ".png")) as &[u8],)+
            other => unreachable!("{other} has no picture"),
        }
    };
}

impl Painted {
    /// Four pictures of a kind of leaf.
    pub(crate) fn leaf(kind: LeafKind) -> Self {
        Self::read(kept!(kind.name(), "leaf":
            "ovate" "round" "lanceolate" "lobed" "palmate" "fan" "compound" "needle" "scale"))
    }

    /// Four pictures of a kind of flower, if it is one.
    pub(crate) fn flower(kind: FlowerKind) -> Option<Self> {
        kind.nature()?;
        Some(Self::read(kept!(kind.name(), "flower": "rosette" "catkin" "panicle")))
    }

    /// Four pictures of a kind of fruit, if it is one.
    pub(crate) fn fruit(kind: FruitKind) -> Option<Self> {
        kind.nature()?;
        Some(Self::read(kept!(kind.name(), "fruit": "round" "cone" "nut" "winged")))
    }

    /// A square of bark, which goes on without a seam beyond its borders.
    pub(crate) fn bark(kind: BarkKind) -> Self {
        Self::read(kept!(kind.name(), "bark":
            "smooth" "furrowed" "plated" "papery" "flaking" "banded" "stringy"))
    }

    /// Whether there is anything at a place of an atlas, upwards from its foot.
    pub(crate) fn covers(&self, uv: Vec2) -> bool {
        let [column, line] =
            uv.to_array().map(|share| ((share * self.side as f32) as usize).min(self.side - 1));
        self.colours[line * self.side + column][3] >= 128
    }

    fn read(png: &[u8]) -> Self {
        let read = || -> Result<Self, png::DecodingError> {
            let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info()?;
            let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
            let side = reader.next_frame(&mut bytes)?.width as usize;
            let (colours, relief) = bytes.as_chunks::<4>().0.split_at(side * side);
            Ok(Self { side, colours: colours.to_vec(), relief: relief.to_vec() })
        };
        read().unwrap_or_else(|error| unreachable!("pictures are kept with the sources: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_picture() {
        let leaves = LeafKind::ALL.iter().map(|&kind| Painted::leaf(kind));
        let flowers = FlowerKind::ALL.iter().filter_map(|&kind| Painted::flower(kind));
        let fruits = FruitKind::ALL.iter().filter_map(|&kind| Painted::fruit(kind));
        let all: Vec<_> = leaves.chain(flowers).chain(fruits).collect();
        assert_eq!(all.len(), LeafKind::ALL.len() + FlowerKind::ALL.len() + FruitKind::ALL.len() - 2);
        for picture in all {
            assert_eq!([picture.colours.len(), picture.relief.len()], [picture.side * picture.side; 2]);
            let inside = picture.colours.iter().filter(|texel| texel[3] > 127).count();
            assert!((0.05..0.8).contains(&(inside as f32 / picture.colours.len() as f32)), "{inside}");
        }
        for &kind in BarkKind::ALL {
            assert_eq!(Painted::bark(kind).side, 256);
        }
        assert!(LeafKind::ALL.iter().all(|kind| LAYOUT.leaf_reach.contains_key(kind.name())));
    }
}
