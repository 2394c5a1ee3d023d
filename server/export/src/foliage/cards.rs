//! Cards that show pictures: leaves, sprays, flowers and fruits as triangles, formed as clients form them when they are
//! near.

use std::{
    f32::consts::{PI, TAU},
    ops::Range,
};

use espalier_mesh::{TriangleMesh, leaves::Leaf};
use espalier_plant::MetamerId;
use espalier_settings::{LeafKind, LeafNature, OrnamentNature};
use glam::{Mat3, Quat, Vec2, Vec3, Vec4};

use super::leaf_look::{bending, own_numbers};
use crate::{painted::LAYOUT, swaying::Rider};

/// With more leaves than this each gets half the triangles or fewer: nobody sees single ones then.
const MANY_LEAVES: usize = 60_000;
/// How far a blade rolls about its midrib, in radians from one extreme to the other.
const ROLL: f32 = 0.9;
/// How far a spray of full length sags, in its own length.
const SAG: f32 = 0.1;
/// How far needles look to the side at the edge of a spray.
const AROUND: f32 = 0.9;

/// Triangles that show an atlas. Texture coordinates are places in it, upwards.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cards {
    pub mesh: TriangleMesh,
    /// The direction in which u grows, and the side of the normal on which v does.
    pub tangents: Vec<Vec4>,
    /// The colour of what each vertex belongs to, linear.
    pub hues: Vec<Vec3>,
    /// The cards, in the order of their vertices.
    pub grids: Vec<Grid>,
    /// What the vertices go along with in the wind, as far as that has been said.
    pub riders: Vec<Rider>,
}

/// One card: lines of vertices, each from its left to its right, from its foot upwards.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// Its first vertex.
    pub first: u32,
    pub columns: u32,
    pub rows: u32,
    /// How it hangs, where it is a leaf's.
    pub stalk: Option<Stalk>,
}

/// How a leaf hangs at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stalk {
    pub base: Vec3,
    /// Unit vectors along it and across it.
    pub direction: Vec3,
    /// The same.
    pub side: Vec3,
    /// Its own numbers.
    pub own: Vec4,
}

impl Grid {
    /// The indices of all its vertices.
    pub(crate) fn vertices(&self) -> Range<usize> {
        self.first as usize..(self.first + (self.columns + 1) * (self.rows + 1)) as usize
    }

    /// The index of a vertex.
    pub(crate) fn vertex(&self, column: u32, row: u32) -> usize {
        (self.first + row * (self.columns + 1) + column) as usize
    }
}

/// How finely leaves are drawn.
#[derive(Clone, Copy, Debug)]
struct Fineness {
    /// Parts across and along a blade.
    blade: [u32; 2],
    /// Crossed cards of a spray, and parts along each.
    spray: [u32; 2],
}

impl Fineness {
    /// For so many leaves, at a level of detail.
    fn of(leaves: usize, level: usize) -> Self {
        match level {
            0 if leaves <= MANY_LEAVES => Self { blade: [2, 3], spray: [3, 2] },
            0 | 1 => Self { blade: [2, 1], spray: [2, 1] },
            _ => Self { blade: [1, 1], spray: [2, 1] },
        }
    }
}

/// What all leaves of a look have in common.
#[derive(Clone, Debug)]
pub(crate) struct LeafForm {
    nature: LeafNature,
    reach: f32,
    fineness: Fineness,
    level: u8,
}

impl LeafForm {
    pub(crate) fn new(kind: LeafKind, leaves: usize, level: usize) -> Self {
        Self {
            fineness: Fineness::of(leaves, level),
            level: level as u8,
            nature: kind.nature(),
            reach: LAYOUT.leaf_reach.get(kind.name()).copied().unwrap_or(0.5),
        }
    }

    /// Adds a leaf as it hangs.
    pub(crate) fn add(&self, cards: &mut Cards, leaf: &Leaf, hue: Vec3) {
        let own = own_numbers(leaf.random);
        let first = cards.grids.len();
        self.add_form(cards, &self.stand(leaf), own.x, bending(leaf.random, own.w), hue);
        let Leaf { base, direction, normal, .. } = *leaf;
        let stalk = Stalk { base, direction, side: direction.cross(normal), own };
        cards.grids[first..].iter_mut().for_each(|grid| grid.stalk = Some(stalk));
    }

    /// How many forms stand for all leaves where these are places: the pictures of an atlas, each mirrored as well.
    pub(crate) const PROTOTYPES: usize = 8;

    /// Adds one of the forms that stand for all leaves, at the origin, one internode long, along X and facing Y.
    pub(crate) fn add_prototype(&self, cards: &mut Cards, which: usize) {
        let stand = Stand { base: Vec3::ZERO, direction: Vec3::X, side: Vec3::Z, up: Vec3::Y, size: 1.0 };
        let number = (which as f32 + 0.5) / Self::PROTOTYPES as f32;
        self.add_form(cards, &stand, number, bending(0.5, 0.5), Vec3::ONE);
    }

    /// Which of those forms stands for a leaf, and where.
    pub(crate) fn instance(&self, leaf: &Leaf) -> LeafInstance {
        let Stand { base, direction, side, up, size } = self.stand(leaf);
        let number = own_numbers(leaf.random).x * Self::PROTOTYPES as f32;
        LeafInstance {
            prototype: (number as usize).min(Self::PROTOTYPES - 1),
            place: base,
            rotation: Quat::from_mat3(&Mat3::from_cols(direction, up, side)).normalize(),
            scale: size,
        }
    }

    /// The level of detail that it is drawn at.
    pub(crate) fn level(&self) -> u8 {
        self.level
    }

    /// How a leaf stands when it has rolled about its midrib, or a spray has turned.
    fn stand(&self, leaf: &Leaf) -> Stand {
        let Leaf { base, direction, normal, size, random } = *leaf;
        let own = own_numbers(random);
        let roll = if self.nature.is_spray { -TAU * own.y } else { (own.y - 0.5) * ROLL };
        let (sin, cos) = libm::sincosf(roll);
        let level = direction.cross(normal);
        Stand { base, direction, side: level * cos - normal * sin, up: normal * cos + level * sin, size }
    }

    fn add_form(&self, cards: &mut Cards, stand: &Stand, number: f32, bending: [f32; 2], hue: Vec3) {
        let tile = Tile::of(number);
        if self.nature.is_spray {
            self.add_spray(cards, stand, &tile, hue);
        } else {
            self.add_blade(cards, stand, &tile, bending, hue);
        }
    }

    fn add_blade(&self, cards: &mut Cards, stand: &Stand, tile: &Tile, bending: [f32; 2], hue: Vec3) {
        let Stand { base, direction, side, up, size } = *stand;
        let [bow, fold] = bending.map(|much| much * self.nature.bend);
        cards.grid(self.fineness.blade, tile, hue, |across, along| {
            let (out, along) = (across * full(self.reach), shifted(along));
            let sunk = bow * along * along;
            let place = direction * (along - 0.12 * sunk) + side * out + up * (out.abs() * fold - sunk);
            let lengthwise = direction - up * (2.0 * bow * along);
            let normal = (side + up * (fold * across)).normalize().cross(lengthwise).normalize();
            Corner { place: base + size * place, normal, side }
        });
    }

    fn add_spray(&self, cards: &mut Cards, stand: &Stand, tile: &Tile, hue: Vec3) {
        let Stand { base, direction, side: level, up, size } = *stand;
        let [count, parts] = self.fineness.spray;
        for which in 0..count {
            let (sin, cos) = libm::sincosf(PI * which as f32 / count as f32);
            let side = level * cos + up * sin;
            let flat = side.cross(direction);
            cards.grid([2, parts], tile, hue, |across, along| {
                let (out, along) = (across * full(self.reach), shifted(along));
                let sag = SAG * self.nature.bend * along * along;
                Corner {
                    place: base + size * (direction * along + side * out - Vec3::Y * sag),
                    // Needles stand all around: the further out, the more they look to the side.
                    normal: (flat + side * (across * AROUND)).normalize(),
                    side,
                }
            });
        }
    }
}

/// A leaf that is one of few forms, moved, turned and scaled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafInstance {
    pub prototype: usize,
    pub place: Vec3,
    pub rotation: Quat,
    pub scale: f32,
}

/// How a leaf stands: unit vectors from its base to its tip, across, and out of its upper side.
struct Stand {
    base: Vec3,
    direction: Vec3,
    side: Vec3,
    up: Vec3,
    size: f32,
}

/// A flower or fruit in its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ornament {
    pub base: Vec3,
    /// Unit vector along which it hangs or stands.
    pub axis: Vec3,
    pub size: f32,
    /// How far it stands off, in its own size.
    pub stalk: f32,
    /// A number from 0 to 1 of its own.
    pub random: f32,
}

impl Ornament {
    /// Adds it: a disc, or crossed cards, so many that it looks as thick as it is broad.
    pub(crate) fn add(&self, cards: &mut Cards, nature: &OrnamentNature, hue: Vec3) {
        let own = own_numbers(self.random);
        let foot = self.base + self.axis * (self.stalk * self.size);
        let (u, w) = self.axis.any_orthonormal_pair();
        let tile = Tile::of(own.x);
        let turned = |angle: f32| {
            let (sin, cos) = libm::sincosf(angle);
            u * cos + w * sin
        };
        if nature.turn < 0.0 {
            let side = turned(TAU * own.y);
            let lengthwise = self.axis.cross(side);
            cards.grid([1, 1], &tile, hue, |across, along| Corner {
                place: foot
                    + self.size
                        * (side * (across * full(nature.reach)) + lengthwise * (shifted(along) - 0.5)),
                normal: self.axis,
                side,
            });
            return;
        }
        let count = if nature.turn < 0.5 { 2 } else { 3 };
        for which in 0..count {
            let side = turned(PI * which as f32 / count as f32 + TAU * own.y);
            let flat = side.cross(self.axis);
            cards.grid([2, 1], &tile, hue, |across, along| Corner {
                place: foot + self.size * (self.axis * shifted(along) + side * (across * full(nature.reach))),
                normal: (flat + side * (across * AROUND)).normalize(),
                side,
            });
        }
    }
}

/// One of the four pictures of an atlas, as it is or mirrored.
struct Tile {
    corner: Vec2,
    mirror: f32,
}

impl Tile {
    fn of(number: f32) -> Self {
        let mirror = if number > 0.5 { 1.0 } else { -1.0 };
        let which = (8.0 * number) as u8 % 4;
        let tiles = LAYOUT.tiles;
        Self { corner: Vec2::new(f32::from(which % tiles), f32::from(which / tiles)), mirror }
    }

    /// The place of a card's corner, -1 to 1 across and 0 to 1 along.
    fn at(&self, across: f32, along: f32) -> Vec2 {
        (self.corner + Vec2::new(0.5 + 0.5 * self.mirror * across, along)) / f32::from(LAYOUT.tiles)
    }
}

/// Half the width of a card for what is so wide.
fn full(reach: f32) -> f32 {
    reach * (1.0 + 2.0 * LAYOUT.margin)
}

/// How far along the thing a place of its card is.
fn shifted(along: f32) -> f32 {
    along * (1.0 + 2.0 * LAYOUT.margin) - LAYOUT.margin
}

struct Corner {
    place: Vec3,
    normal: Vec3,
    /// Across the card.
    side: Vec3,
}

impl Cards {
    fn grid(
        &mut self,
        [columns, rows]: [u32; 2],
        tile: &Tile,
        hue: Vec3,
        corner: impl Fn(f32, f32) -> Corner,
    ) {
        let first = self.mesh.positions.len() as u32;
        self.grids.push(Grid { first, columns, rows, stalk: None });
        for row in 0..=rows {
            for column in 0..=columns {
                let (across, along) = (2.0 * column as f32 / columns as f32 - 1.0, row as f32 / rows as f32);
                let Corner { place, normal, side } = corner(across, along);
                self.mesh.vertex(place, normal, tile.at(across, along));
                let tangent = side.reject_from_normalized(normal).normalize() * tile.mirror;
                self.tangents.push(tangent.extend(tile.mirror));
                self.hues.push(hue);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let a = first + row * (columns + 1) + column;
                let c = a + columns + 1;
                self.mesh.triangle(a, a + 1, c);
                self.mesh.triangle(c, a + 1, c + 1);
            }
        }
    }

    /// Forgets all triangles, but not their room.
    pub(crate) fn clear(&mut self) {
        self.mesh.clear();
        self.tangents.clear();
        self.hues.clear();
        self.grids.clear();
        self.riders.clear();
    }

    /// What has been added since the last time goes along with a metamer.
    pub(crate) fn ride_on(&mut self, id: MetamerId) {
        let said = self.riders.len();
        // They stand in the order of their vertices, and there are as many as leaves.
        let new = self.grids.partition_point(|grid| (grid.first as usize) < said);
        for grid in &self.grids[new..] {
            for row in 0..=grid.rows {
                let rider = Rider { row: id.raw(), share: 1.0, flutter: row as f32 / grid.rows as f32 };
                self.riders.extend(std::iter::repeat_n(rider, grid.columns as usize + 1));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use espalier_mesh::checks;
    use espalier_settings::{FlowerKind, FruitKind};

    use super::*;

    const LEAF: Leaf = Leaf { base: Vec3::ONE, direction: Vec3::X, normal: Vec3::Y, size: 2.0, random: 0.3 };

    fn holds(cards: &Cards, name: &str) {
        assert_eq!(checks::mesh(&cards.mesh), Ok(()), "{name}");
        assert_eq!(cards.tangents.len(), cards.mesh.positions.len());
        for (corners, normals) in cards.mesh.indices.as_chunks::<3>().0.iter().map(|corners| {
            (
                corners.map(|c| cards.mesh.positions[c as usize]),
                corners.map(|c| cards.mesh.normals[c as usize]),
            )
        }) {
            let [a, b, c] = corners;
            let facing = (b - a).cross(c - a);
            assert!(
                facing.dot(normals.into_iter().sum()) > 0.0,
                "{name}: a triangle faces away from its normal"
            );
        }
        for (i, tangent) in cards.tangents.iter().enumerate() {
            assert!((tangent.truncate().length() - 1.0).abs() < 1e-4 && tangent.w.abs() == 1.0);
            assert!(tangent.truncate().dot(cards.mesh.normals[i]).abs() < 1e-3, "{name}");
        }
        assert!(cards.mesh.uvs.iter().all(|uv| uv.min_element() >= 0.0 && uv.max_element() <= 1.0));
    }

    /// In each triangle the tangent points where u grows, and the bitangent where v does.
    fn tangents_follow(cards: &Cards) {
        for corners in cards.mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| corner as usize);
            let (p, uv) = (&cards.mesh.positions, &cards.mesh.uvs);
            let ([e, f], [s, t]) = ([p[b] - p[a], p[c] - p[a]], [uv[b] - uv[a], uv[c] - uv[a]]);
            let area = s.perp_dot(t);
            let (along_u, along_v) = ((e * t.y - f * s.y) / area, (f * s.x - e * t.x) / area);
            let tangent = cards.tangents[a];
            let bitangent = cards.mesh.normals[a].cross(tangent.truncate()) * tangent.w;
            assert!(along_u.dot(tangent.truncate()) > 0.0 && along_v.dot(bitangent) > 0.0);
        }
    }

    #[test]
    fn leaves_of_every_kind_are_cards_with_tangents() {
        for &kind in LeafKind::ALL {
            for (leaves, most) in [(1, 24), (MANY_LEAVES + 1, 8)] {
                let form = LeafForm::new(kind, leaves, 0);
                for random in [0.1, 0.3, 0.6, 0.9] {
                    let mut cards = Cards::default();
                    form.add(&mut cards, &Leaf { random, ..LEAF }, Vec3::ONE);
                    holds(&cards, kind.name());
                    tangents_follow(&cards);
                    assert!(cards.mesh.indices.len() <= 3 * most);
                    let [low, high] = cards.mesh.bounds().expect("it has vertices");
                    assert!(low.x > 0.7 && high.x < 3.2 && high.x > 2.2, "{kind:?}: {low} to {high}");
                }
            }
        }
    }

    #[test]
    fn flowers_and_fruits_of_every_kind_are_cards_with_tangents() {
        let flowers = FlowerKind::ALL.iter().filter_map(|kind| kind.nature());
        for nature in flowers.chain(FruitKind::ALL.iter().filter_map(|kind| kind.nature())) {
            let mut cards = Cards::default();
            let ornament =
                Ornament { base: Vec3::ZERO, axis: -Vec3::Y, size: 1.0, stalk: nature.stalk, random: 0.7 };
            ornament.add(&mut cards, &nature, Vec3::ONE);
            holds(&cards, "ornament");
            tangents_follow(&cards);
        }
    }
}
