//! Light maps: a second place for each vertex, in a texture in which no two pieces of a mesh lie on one another. A mesh
//! has a texture of its own.

pub(crate) mod flat_cards;
mod packing;
pub(crate) mod unrolled;

use glam::Vec2;
use serde_json::{Value, json};

use self::packing::shelves;

/// Texels between two pieces at least, half of them at the borders: so interpolation never mixes two pieces.
const GUTTER: f32 = 2.0;
/// No piece is narrower or lower, in texels.
const LEAST: f32 = 1.0;
/// Halvings of the range in which the density is searched.
const HALVINGS: usize = 20;

/// The pieces of one mesh in their texture.
#[derive(Clone, Debug)]
pub(crate) struct LightMap {
    /// Along a side of the texture.
    texels: u32,
    /// Texels along an internode, but for pieces that would have less than one.
    density: f32,
    pieces: Vec<Piece>,
}

/// A rectangle in the texture.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// In texels.
    corner: Vec2,
    /// Of the piece itself, in internodes.
    size: Vec2,
    /// Texels in the texture for an internode of the piece, across and along.
    stretch: Vec2,
    /// Whether its width runs up the texture.
    is_turned: bool,
}

impl LightMap {
    /// Finds room for pieces of these sizes, as large as they can all be, in a texture of so many texels square. Where
    /// there is not a texel for each, the texture has twice as many a side, or four times.
    pub(crate) fn of(sizes: &[Vec2], texels: u32) -> Self {
        let lying: Vec<Vec2> =
            sizes.iter().map(|size| Vec2::new(size.min_element(), size.max_element())).collect();
        let mut order: Vec<usize> = (0..sizes.len()).collect();
        order.sort_by(|&a, &b| {
            let [a, b] = [lying[a], lying[b]];
            b.y.total_cmp(&a.y).then(b.x.total_cmp(&a.x))
        });
        let pack = |density: f32, texels: u32| {
            let boxes = order.iter().map(|&one| (lying[one] * density).max(Vec2::splat(LEAST)) + GUTTER);
            shelves(boxes, texels as f32)
        };
        let mut texels = texels.max(1);
        let mut places = loop {
            if let Some(places) = pack(0.0, texels) {
                break places;
            }
            texels *= 2;
        };
        let area: f32 = lying.iter().map(|size| size.x * size.y).sum();
        let (mut density, mut beyond) = (0.0, texels as f32 / area.sqrt().max(f32::MIN_POSITIVE));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (density + beyond);
            match pack(middle, texels) {
                Some(found) => (places, density) = (found, middle),
                None => beyond = middle,
            }
        }
        let mut pieces =
            vec![
                Piece { corner: Vec2::ZERO, size: Vec2::ONE, stretch: Vec2::ONE, is_turned: false };
                sizes.len()
            ];
        for (&one, place) in order.iter().zip(places) {
            let size = sizes[one];
            let shown = (size * density).max(Vec2::splat(LEAST));
            pieces[one] = Piece {
                corner: place + 0.5 * GUTTER,
                size,
                stretch: shown / size.max(Vec2::splat(f32::MIN_POSITIVE)),
                is_turned: size.x > size.y,
            };
        }
        Self { texels, density, pieces }
    }

    /// The place in the texture, 0 to 1, of a place on a piece, in internodes from its corner.
    pub(crate) fn at(&self, piece: usize, place: Vec2) -> Vec2 {
        let Piece { corner, size, stretch, is_turned } = self.pieces[piece];
        let place = place.clamp(Vec2::ZERO, size) * stretch;
        let place = if is_turned { Vec2::new(size.y * stretch.y - place.y, place.x) } else { place };
        (corner + place) / self.texels as f32
    }

    /// What a file says of it, with so many metres in an internode.
    pub(crate) fn about(&self, metres: f32) -> Value {
        json!({ "texels": self.texels, "gutter": GUTTER as u32, "texels_per_metre": self.density / metres })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a piece in the texture, in texels.
    fn rectangle(map: &LightMap, piece: usize) -> [Vec2; 2] {
        let size = map.pieces[piece].size;
        let ends = [Vec2::ZERO, size].map(|place| map.at(piece, place) * map.texels as f32);
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    }

    fn holds(sizes: &[Vec2], texels: u32) -> LightMap {
        let map = LightMap::of(sizes, texels);
        let all: Vec<_> = (0..sizes.len()).map(|piece| rectangle(&map, piece)).collect();
        for (i, [low, high]) in all.iter().enumerate() {
            let side = map.texels as f32;
            assert!(low.min_element() > 0.99 && high.max_element() < side - 0.99, "{low} to {high}");
            assert!((*high - *low).min_element() > 0.99, "piece {i} has a texel");
            for [other_low, other_high] in &all[..i] {
                let between = (*other_low - *high).max(*low - *other_high).max_element();
                assert!(between > GUTTER - 0.01, "{low} to {high} and {other_low} to {other_high}");
            }
        }
        map
    }

    #[test]
    fn pieces_do_not_meet_and_fill_the_texture() {
        let sizes: Vec<Vec2> = (0..400u32)
            .map(|i| Vec2::new(0.2 + (i * 7 % 13) as f32 * 0.1, 0.3 + (i * 5 % 31) as f32 * 0.2))
            .collect();
        let map = holds(&sizes, 1024);
        let filled: f32 = sizes.iter().map(|size| size.x * size.y).sum::<f32>() * map.density * map.density;
        assert!(filled > 0.7 * 1024.0 * 1024.0, "only {filled} texels are used");
        assert_eq!(map.texels, 1024);
    }

    #[test]
    fn a_single_piece_a_thin_one_and_none_have_their_places() {
        holds(&[Vec2::new(3.0, 1.0)], 64);
        holds(&[Vec2::new(1000.0, 0.01), Vec2::ONE], 256);
        assert_eq!(LightMap::of(&[], 64).texels, 64);
    }

    #[test]
    fn more_pieces_than_texels_get_a_larger_texture() {
        let map = holds(&vec![Vec2::new(0.5, 1.0); 900], 64);
        assert_eq!(map.texels, 128, "30 by 30 of three texels");
        assert_eq!(map.about(0.1)["texels"], 128);
    }

    #[test]
    fn a_piece_that_lies_is_turned_and_not_mirrored() {
        let map = LightMap::of(&[Vec2::new(4.0, 1.0)], 64);
        let [origin, right, up] = [Vec2::ZERO, Vec2::X, Vec2::Y].map(|place| map.at(0, place));
        assert!((right - origin).perp_dot(up - origin) > 0.0);
        assert!((right - origin).y > 0.0 && (up - origin).x < 0.0);
    }
}
