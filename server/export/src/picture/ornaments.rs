//! Flowers and fruits: which places bear one, and what it looks like.

use std::f32::consts::TAU;

use espalier_settings::{FlowerKind, FlowerLook, FruitKind, FruitLook, Place};
use glam::Vec3;

use super::{
    blades::{Painter, share},
    canvas::linear,
};

/// A place that may bear something.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// What kind of place it is.
    pub place: Place,
    /// Where.
    pub at: Vec3,
    /// Unit vector out of the wood.
    pub out: Vec3,
    /// Vigor of the shoot, 0 to 1.
    pub vigor: f32,
    /// A number from 0 to 1 of its own.
    pub random: f32,
}

impl Spot {
    /// Whether it bears one of those of which a share of the places, rather of vigorous shoots or of weak ones, does.
    fn bears(&self, place: Place, wanted: f32, vigor: f32) -> bool {
        let favour = 1.0 + vigor * (2.0 * self.vigor - 1.0);
        self.place == place && self.random < wanted * favour
    }
}

/// Draws the flower that a place bears, if any.
pub(super) fn flower(painter: &mut Painter, spot: &Spot, look: &FlowerLook) {
    if look.kind == FlowerKind::None || !spot.bears(look.place, look.share, look.vigor) {
        return;
    }
    let turn = share(spot.random);
    painter.colour = linear(look.tint) * (0.86 + 0.2 * turn);
    match look.kind {
        FlowerKind::None => {}
        FlowerKind::Rosette => {
            // On a stalk, or the leaves would hide it.
            let facing = (spot.out + 0.7 * Vec3::Y).normalize_or(Vec3::Y);
            rosette(painter, spot.at + facing * (0.6 * look.size), facing, look.size, turn);
        }
        FlowerKind::Catkin => spindle(painter, spot.at, -Vec3::Y, look.size, 0.09 * look.size),
        FlowerKind::Panicle => {
            let up = (spot.out + 1.5 * Vec3::Y).normalize_or(Vec3::Y);
            for floret in 0..14 {
                let along = floret as f32 / 13.0;
                let (sin, cos) = libm::sincosf(TAU * (0.382 * floret as f32 + turn));
                let (u, w) = up.any_orthonormal_pair();
                let aside = (u * cos + w * sin) * (0.24 * (1.0 - 0.8 * along) * look.size);
                let at = spot.at + up * ((0.15 + 0.85 * along) * look.size) + aside;
                rosette(painter, at, (aside + 0.1 * up).normalize_or(up), 0.24 * look.size, along);
            }
        }
    }
}

/// Draws the fruit that a place bears, if any.
pub(super) fn fruit(painter: &mut Painter, spot: &Spot, look: &FruitLook) {
    // Another number than that of the flower at the same place.
    let spot = Spot { random: share(0.7 * spot.random + 0.1), ..*spot };
    if look.kind == FruitKind::None || !spot.bears(look.place, look.share, look.vigor) {
        return;
    }
    painter.colour = linear(look.tint) * (0.85 + 0.3 * share(spot.random));
    let (size, at) = (look.size, spot.at);
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
    use espalier_settings::Appearance;

    use super::*;
    use crate::picture::scene::Painted;

    fn triangles(draw: impl Fn(&mut Painter)) -> usize {
        let mut painter = Painter { painted: Painted::default(), colour: Vec3::ONE };
        draw(&mut painter);
        painter.painted.mesh.indices.len() / 3
    }

    fn spots(vigor: f32) -> Vec<Spot> {
        let spot = |i| Spot {
            place: Place::Twigs,
            at: Vec3::Y,
            out: Vec3::X,
            vigor,
            random: share(i as f32 / 200.0),
        };
        (0..200).map(spot).collect()
    }

    #[test]
    fn every_kind_is_drawn_where_it_belongs() {
        let spot = Spot { place: Place::Wood, at: Vec3::Y, out: Vec3::X, vigor: 1.0, random: 0.2 };
        for kind in [FlowerKind::Rosette, FlowerKind::Catkin, FlowerKind::Panicle] {
            let look = FlowerLook { kind, share: 1.0, place: Place::Wood, ..Appearance::default().flowers };
            assert!(triangles(|p| flower(p, &spot, &look)) > 0, "{kind:?}");
            let elsewhere = FlowerLook { place: Place::Tips, ..look };
            assert_eq!(triangles(|p| flower(p, &spot, &elsewhere)), 0, "{kind:?}");
        }
        for kind in [FruitKind::Round, FruitKind::Cone, FruitKind::Nut, FruitKind::Winged] {
            let look = FruitLook { kind, share: 1.0, place: Place::Wood, ..Appearance::default().fruits };
            assert!(triangles(|p| fruit(p, &spot, &look)) > 0, "{kind:?}");
        }
        assert_eq!(triangles(|p| flower(p, &spot, &Appearance::default().flowers)), 0);
    }

    #[test]
    fn a_share_of_the_places_bears_flowers() {
        let bearing =
            |vigor, favour| spots(vigor).iter().filter(|spot| spot.bears(Place::Twigs, 0.5, favour)).count();
        assert!((85..115).contains(&bearing(0.0, 0.0)) && bearing(0.0, 0.0) == bearing(1.0, 0.0));
        assert!(bearing(1.0, 1.0) > 180 && bearing(0.0, 1.0) == 0 && bearing(0.0, -1.0) > 180);
    }
}
