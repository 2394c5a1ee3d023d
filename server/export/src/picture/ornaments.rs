//! Flowers and fruits: which places bear one, and what it looks like.

use std::f32::consts::TAU;

use espalier_mesh::leaves;
use espalier_settings::{
    FLOWER_SALT, FRUIT_SALT, FlowerKind, FlowerLook, FruitKind, FruitLook, Place, THICKEST_BEARING,
};
use glam::Vec3;

use super::{blades::Painter, canvas::linear, leaf_look::own_numbers};

/// Of sixteen numbers a row has for its leaves, the one that no leaf takes.
const SPARE: u32 = 15;

/// A metamer that may bear flowers and fruits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bearer {
    /// Its row.
    pub row: u32,
    /// Where it begins and ends.
    pub ends: [Vec3; 2],
    /// Its radius in internodes.
    pub radius: f32,
    /// Whether it has leaves.
    pub is_leafy: bool,
    /// Whether its axis ends with it.
    pub is_tip: bool,
    /// Share of the greatest vigor, 0 to 1.
    pub vigor: f32,
}

/// Which metamers bear something, and how many at each.
#[derive(Clone, Copy, Debug)]
struct Placing {
    share: f32,
    place: Place,
    vigor: f32,
    salt: u32,
    together: u8,
}

/// Where one flower or fruit is.
#[derive(Clone, Copy, Debug)]
struct Spot {
    at: Vec3,
    /// Unit vector out of the wood.
    out: Vec3,
    /// A number from 0 to 1 of its own.
    random: f32,
}

impl Bearer {
    /// Whether it is a place of this sort.
    fn is_place(&self, place: Place) -> bool {
        match place {
            Place::Tips => self.is_tip,
            Place::Twigs => self.is_leafy,
            Place::Wood => !self.is_leafy && self.radius < THICKEST_BEARING,
        }
    }

    /// Whether it bears something: the same as for clients, and more with a larger share.
    fn bears(&self, Placing { share, place, vigor, salt, .. }: &Placing) -> bool {
        let number =
            leaves::hash(leaves::hash(self.row.wrapping_mul(16).wrapping_add(SPARE)).wrapping_add(*salt));
        let favour = (1.0 + vigor * (2.0 * self.vigor - 1.0)).clamp(0.0, 2.0);
        self.is_place(*place) && f64::from(number) < f64::from(share * favour) * 4_294_967_296.0
    }

    fn spots(&self, placing: &Placing) -> impl Iterator<Item = Spot> + use<> {
        let count = if self.bears(placing) { placing.together } else { 0 };
        let ([from, to], radius) = (self.ends, self.radius);
        let heading = (to - from).normalize_or(Vec3::Y);
        leaves::on_metamer(self.row, placing.salt, from, to, count, 1.0).map(move |leaf| {
            let aside = leaf.direction.reject_from_normalized(heading).normalize_or(leaf.direction);
            Spot { at: leaf.base + 0.9 * radius * aside, out: leaf.direction, random: leaf.random }
        })
    }
}

impl Spot {
    /// No two are quite alike in size and colour.
    fn varied(&self, size: f32, tint: [u8; 3]) -> (f32, Vec3) {
        let own = own_numbers(self.random);
        let warmth = own.y - 0.5;
        let hue =
            linear(tint) * (0.86 + 0.28 * own.z) * Vec3::new(1.0 + 0.10 * warmth, 1.0, 1.0 - 0.08 * warmth);
        (size * (0.82 + 0.36 * self.random), hue)
    }
}

/// Draws the flowers that a metamer bears.
pub(super) fn flowers(painter: &mut Painter, bearer: &Bearer, look: &FlowerLook) {
    let &FlowerLook { kind, share, place, vigor, .. } = look;
    let together = kind.nature().map_or(0, |nature| nature.together);
    for spot in bearer.spots(&Placing { share, place, vigor, salt: FLOWER_SALT, together }) {
        flower(painter, &spot, look);
    }
}

/// Draws the fruits that a metamer bears.
pub(super) fn fruits(painter: &mut Painter, bearer: &Bearer, look: &FruitLook) {
    let &FruitLook { kind, share, place, vigor, .. } = look;
    let together = kind.nature().map_or(0, |nature| nature.together);
    for spot in bearer.spots(&Placing { share, place, vigor, salt: FRUIT_SALT, together }) {
        fruit(painter, &spot, look);
    }
}

fn flower(painter: &mut Painter, spot: &Spot, look: &FlowerLook) {
    let (size, hue) = spot.varied(look.size, look.tint);
    painter.colour = hue;
    let turn = own_numbers(spot.random).y;
    match look.kind {
        FlowerKind::None => {}
        FlowerKind::Rosette => {
            // On a stalk, or the leaves would hide it.
            let facing = (spot.out + 0.7 * Vec3::Y).normalize_or(Vec3::Y);
            rosette(painter, spot.at + facing * (0.6 * size), facing, size, turn);
        }
        FlowerKind::Catkin => spindle(painter, spot.at, -Vec3::Y, size, 0.09 * size),
        FlowerKind::Panicle => {
            let up = (spot.out + 1.5 * Vec3::Y).normalize_or(Vec3::Y);
            for floret in 0..14 {
                let along = floret as f32 / 13.0;
                let (sin, cos) = libm::sincosf(TAU * (0.382 * floret as f32 + turn));
                let (u, w) = up.any_orthonormal_pair();
                let aside = (u * cos + w * sin) * (0.24 * (1.0 - 0.8 * along) * size);
                let at = spot.at + up * ((0.15 + 0.85 * along) * size) + aside;
                rosette(painter, at, (aside + 0.1 * up).normalize_or(up), 0.24 * size, along);
            }
        }
    }
}

fn fruit(painter: &mut Painter, spot: &Spot, look: &FruitLook) {
    let at = spot.at;
    let (size, hue) = spot.varied(look.size, look.tint);
    painter.colour = hue;
    match look.kind {
        FruitKind::None => {}
        FruitKind::Round => ball(painter, at - Vec3::Y * (0.7 * size), Vec3::splat(0.5 * size)),
        FruitKind::Nut => ball(painter, at - Vec3::Y * (0.6 * size), Vec3::new(0.34, 0.5, 0.34) * size),
        FruitKind::Cone => spindle(painter, at, -Vec3::Y, size, 0.24 * size),
        FruitKind::Winged => {
            let along = (spot.out - Vec3::Y).normalize_or(-Vec3::Y);
            let across = along.cross(Vec3::Y).normalize_or(Vec3::X);
            for hand in [-1.0, 1.0] {
                let wing = (along + 0.8 * hand * across).normalize_or(along);
                painter.blade(at, wing, wing.cross(Vec3::Z).normalize_or(across), size, WING);
            }
        }
    }
}

const PETAL: super::blades::Outline = &[(0.6, 0.36), (1.0, 0.0)];
const WING: super::blades::Outline = &[(0.3, 0.06), (0.75, 0.17), (1.0, 0.0)];

/// Five petals around a direction, `size` across.
fn rosette(painter: &mut Painter, centre: Vec3, facing: Vec3, size: f32, turn: f32) {
    let (u, w) = facing.any_orthonormal_pair();
    for petal in 0..5 {
        let (sin, cos) = libm::sincosf(TAU * (petal as f32 / 5.0 + turn));
        let along = (u * cos + w * sin + 0.3 * facing).normalize_or(u);
        painter.blade(centre, along, along.cross(facing), 0.5 * size, PETAL);
    }
}

/// A ball with three half-axes along x, y and z.
fn ball(painter: &mut Painter, centre: Vec3, half: Vec3) {
    body(painter, |out, up, cos, sin| {
        let normal = Vec3::new(out * cos, up, out * sin);
        (centre + normal * half, normal)
    });
}

/// A long body that hangs from a place, thickest in its upper half.
fn spindle(painter: &mut Painter, from: Vec3, along: Vec3, length: f32, radius: f32) {
    let (u, w) = along.any_orthonormal_pair();
    body(painter, |out, up, cos, sin| {
        let gone = 0.5 * (1.0 - up);
        let side = u * cos + w * sin;
        let width = radius * out * (1.15 - 0.5 * gone);
        (from + along * (gone * length) + side * width, (side - along * (0.3 * up)).normalize_or(side))
    });
}

/// A closed body from rings; where a point lies follows from its ring's width and height and from its side.
fn body(painter: &mut Painter, place: impl Fn(f32, f32, f32, f32) -> (Vec3, Vec3)) {
    const RINGS: u32 = 6;
    const SIDES: u32 = 8;
    let first = painter.painted.mesh.positions.len() as u32;
    for ring in 0..=RINGS {
        let (out, up) = libm::sincosf(0.5 * TAU * ring as f32 / RINGS as f32);
        for side in 0..=SIDES {
            let (sin, cos) = libm::sincosf(TAU * side as f32 / SIDES as f32);
            let (at, normal) = place(out, up, cos, sin);
            painter.vertex(at, normal);
        }
    }
    for ring in 0..RINGS {
        for side in 0..SIDES {
            let corner = first + ring * (SIDES + 1) + side;
            painter.painted.mesh.triangle(corner, corner + 1, corner + SIDES + 2);
            painter.painted.mesh.triangle(corner, corner + SIDES + 2, corner + SIDES + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use espalier_settings::Appearance;
    use serde_json::{Value, json};

    use super::*;
    use crate::picture::scene::Painted;

    const BEARER: Bearer = Bearer {
        row: 7,
        ends: [Vec3::ZERO, Vec3::Y],
        radius: 0.1,
        is_leafy: false,
        is_tip: false,
        vigor: 1.0,
    };

    fn triangles(draw: impl Fn(&mut Painter)) -> usize {
        let mut painter = Painter { painted: Painted::default(), colour: Vec3::ONE };
        draw(&mut painter);
        painter.painted.mesh.indices.len() / 3
    }

    #[test]
    fn every_kind_is_drawn_where_it_belongs() {
        for &kind in FlowerKind::ALL {
            let look = FlowerLook { kind, share: 1.0, place: Place::Wood, ..Appearance::default().flowers };
            assert_eq!(triangles(|p| flowers(p, &BEARER, &look)) > 0, kind != FlowerKind::None, "{kind:?}");
            let elsewhere = FlowerLook { place: Place::Tips, ..look };
            assert_eq!(triangles(|p| flowers(p, &BEARER, &elsewhere)), 0, "{kind:?}");
        }
        for &kind in FruitKind::ALL {
            let look = FruitLook { kind, share: 1.0, place: Place::Wood, ..Appearance::default().fruits };
            assert_eq!(triangles(|p| fruits(p, &BEARER, &look)) > 0, kind != FruitKind::None, "{kind:?}");
        }
    }

    #[test]
    fn wood_that_is_too_thick_bears_nothing() {
        assert!(BEARER.is_place(Place::Wood));
        assert!(!Bearer { radius: THICKEST_BEARING, ..BEARER }.is_place(Place::Wood));
    }

    /// Which of some rows bear something, in the levels of vigor that clients know.
    fn bearing() -> Value {
        let samples = (0..12).map(|i| {
            let (share, vigor) = ([0.1, 0.5, 0.9][i % 3], [-1.0, -0.3, 0.0, 1.0][i % 4]);
            let salt = [FLOWER_SALT, FRUIT_SALT][i % 2];
            let placing = Placing { share, place: Place::Wood, vigor, salt, together: 1 };
            let is_bearing = |row: &u32| {
                let vigor = (row % 16) as f32 / 15.0;
                Bearer { row: *row, vigor, ..BEARER }.bears(&placing)
            };
            let rows: Vec<u32> = (0..4_000_000).step_by(20_011).filter(is_bearing).collect();
            json!({ "share": share, "vigor": vigor, "salt": salt, "rows": rows })
        });
        samples.collect()
    }

    /// Clients choose places by themselves: both must choose those in `golden/ornaments.json`.
    ///
    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-export ornaments`.
    #[test]
    fn flowers_and_fruits_are_where_it_was_written_down() {
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/ornaments.json");
        let samples = bearing();
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, format!("{samples}\n")).expect("the samples can be written");
        }
        let stored = fs::read_to_string(&file).expect("the samples can be read");
        let stored: Value = serde_json::from_str(&stored).expect("the samples are JSON");
        let written: Value = serde_json::from_str(&samples.to_string()).expect("so are these");
        assert!(stored == written, "places differ from golden/ornaments.json");
    }

    #[test]
    fn a_share_of_the_places_bears_flowers() {
        let bearing = |own: f32, vigor| {
            let placing = Placing { share: 0.5, place: Place::Wood, vigor, salt: FLOWER_SALT, together: 1 };
            (0..200).filter(|&row| Bearer { row, vigor: own, ..BEARER }.bears(&placing)).count()
        };
        assert!((75..125).contains(&bearing(0.0, 0.0)) && bearing(0.0, 0.0) == bearing(1.0, 0.0));
        assert!(bearing(1.0, 1.0) == 200 && bearing(0.0, 1.0) == 0 && bearing(0.0, -1.0) == 200);
    }
}
