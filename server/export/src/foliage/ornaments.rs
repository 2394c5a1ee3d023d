//! Flowers and fruits: which places bear one, and what it looks like.

use espalier_mesh::leaves;
use espalier_plant::{Organ, OrganKind};
use espalier_settings::{
    FLOWER_SALT, FRUIT_SALT, FlowerLook, FruitLook, OrnamentNature, Place, THICKEST_BEARING,
};
use glam::Vec3;

use super::{
    cards::{Cards, Ornament},
    leaf_look::own_numbers,
};
use crate::colour::linear;

/// Of sixteen numbers a row has for its leaves, the one that no leaf takes.
const SPARE: u32 = 15;

/// A metamer that may bear flowers and fruits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bearer<'a> {
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
    /// Organs that it is given.
    pub organs: &'a [Organ],
}

/// Which metamers bear something.
#[derive(Clone, Copy, Debug)]
struct Placing {
    organ: OrganKind,
    share: f32,
    place: Place,
    vigor: f32,
    salt: u32,
}

impl Bearer<'_> {
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

    /// What it bears: so many at a place, each of its own size and colour.
    fn borne(
        &self,
        placing: &Placing,
        nature: &OrnamentNature,
        (size, tint): (f32, Vec3),
    ) -> impl Iterator<Item = (Ornament, Vec3)> {
        let given = self.organs.iter().copied().filter(|organ| organ.kind == placing.organ);
        // Those that it is given stand in place of others.
        let is_given = given.clone().next().is_some();
        let count = if !is_given && self.bears(placing) { nature.together } else { 0 };
        let ([from, to], radius, hang, stalk) = (self.ends, self.radius, nature.hang, nature.stalk);
        let heading = (to - from).normalize_or(Vec3::Y);
        let lengths = given.clone().map(|organ| Some(organ.length()));
        let by_rule = leaves::on_metamer(self.row, placing.salt, from, to, count, 1.0);
        let by_rule = by_rule.map(|leaf| (leaf, None));
        let given = leaves::given_on_metamer(self.row, placing.salt, from, to, given, 1.0).zip(lengths);
        by_rule.chain(given).map(move |(leaf, length)| {
            let aside = leaf.direction.reject_from_normalized(heading).normalize_or(leaf.direction);
            let own = own_numbers(leaf.random).truncate();
            // What is given stands on its wood.
            let stalk = if length.is_some() { 0.0 } else { stalk };
            let ornament = Ornament {
                stalk,
                base: leaf.base + 0.9 * radius * aside,
                axis: axis(leaf.direction, hang, own),
                size: length.flatten().unwrap_or(size * varied(leaf.random)),
                random: leaf.random,
            };
            (ornament, hue(tint, own))
        })
    }
}

/// Adds the flowers that a metamer bears.
pub(super) fn add_flowers(cards: &mut Cards, bearer: &Bearer, look: &FlowerLook) {
    let &FlowerLook { kind, tint, size, share, place, vigor } = look;
    let Some(nature) = kind.nature() else { return };
    let placing = Placing { organ: OrganKind::Flower, share, place, vigor, salt: FLOWER_SALT };
    for (flower, hue) in bearer.borne(&placing, &nature, (size, linear(tint))) {
        flower.add(cards, &nature, hue);
    }
}

/// Adds the fruits that a metamer bears.
pub(super) fn add_fruits(cards: &mut Cards, bearer: &Bearer, look: &FruitLook) {
    let &FruitLook { kind, tint, size, share, place, vigor } = look;
    let Some(nature) = kind.nature() else { return };
    let placing = Placing { organ: OrganKind::Fruit, share, place, vigor, salt: FRUIT_SALT };
    for (fruit, hue) in bearer.borne(&placing, &nature, (size, linear(tint))) {
        fruit.add(cards, &nature, hue);
    }
}

/// How large it is beside the middle size.
fn varied(random: f32) -> f32 {
    0.82 + 0.36 * random
}

/// Where it points that hangs or stands upright so far, from where a leaf would.
fn axis(direction: Vec3, hang: f32, own: Vec3) -> Vec3 {
    let way = if hang < 0.0 { -Vec3::Y } else { Vec3::Y };
    (direction.lerp(way, hang.abs()) + 0.16 * (own - Vec3::splat(0.5))).normalize_or(way)
}

/// The colour of one of this tint.
fn hue(tint: Vec3, own: Vec3) -> Vec3 {
    let warmth = own.y - 0.5;
    tint * (0.86 + 0.28 * own.z) * Vec3::new(1.0 + 0.10 * warmth, 1.0, 1.0 - 0.08 * warmth)
}

/// The brightest that any of the three colours of this tint gets.
pub(crate) fn brightest(tint: Vec3) -> f32 {
    1.05 * 1.14 * tint.max_element()
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use espalier_settings::{Appearance, FlowerKind, FruitKind};
    use serde_json::{Value, json};

    use super::*;

    const BEARER: Bearer<'_> = Bearer {
        row: 7,
        ends: [Vec3::ZERO, Vec3::Y],
        radius: 0.1,
        is_leafy: false,
        is_tip: false,
        vigor: 1.0,
        organs: &[],
    };

    fn triangles(add: impl Fn(&mut Cards)) -> usize {
        let mut cards = Cards::default();
        add(&mut cards);
        cards.mesh.indices.len() / 3
    }

    #[test]
    fn every_kind_is_drawn_where_it_belongs() {
        for &kind in FlowerKind::ALL {
            let look = FlowerLook { kind, share: 1.0, place: Place::Wood, ..Appearance::default().flowers };
            assert_eq!(
                triangles(|cards| add_flowers(cards, &BEARER, &look)) > 0,
                kind != FlowerKind::None,
                "{kind:?}"
            );
            let elsewhere = FlowerLook { place: Place::Tips, ..look };
            assert_eq!(triangles(|cards| add_flowers(cards, &BEARER, &elsewhere)), 0, "{kind:?}");
        }
        for &kind in FruitKind::ALL {
            let look = FruitLook { kind, share: 1.0, place: Place::Wood, ..Appearance::default().fruits };
            assert_eq!(
                triangles(|cards| add_fruits(cards, &BEARER, &look)) > 0,
                kind != FruitKind::None,
                "{kind:?}"
            );
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
            let placing = Placing { organ: OrganKind::Flower, share, place: Place::Wood, vigor, salt };
            let is_bearing = |row: &u32| {
                let vigor = (row % 16) as f32 / 15.0;
                Bearer { row: *row, vigor, ..BEARER }.bears(&placing)
            };
            let rows: Vec<u32> = (0..4_000_000).step_by(20_011).filter(is_bearing).collect();
            json!({ "share": share, "vigor": vigor, "salt": salt, "rows": rows })
        });
        samples.collect()
    }

    /// Size, direction and colour of some.
    fn shapes() -> Value {
        let rounded = |numbers: &[f32]| -> Vec<f64> {
            numbers.iter().map(|&number| (f64::from(number) * 1e5).round() / 1e5).collect()
        };
        let shapes = (0..18).map(|i| {
            let random = (i as f32 * 0.618_034).fract();
            let own = own_numbers(random).truncate();
            let hang = [-1.0, -0.75, 0.0, 0.35, 0.85, 1.0][i % 6];
            let direction = Vec3::new(random, 0.3 - own.x, 0.4).normalize();
            let tint = Vec3::new(0.9, own.z, 0.05 * (i % 4) as f32);
            json!({
                "random": random,
                "own": own.to_array(),
                "hang": hang,
                "direction": direction.to_array(),
                "tint": tint.to_array(),
                "size": rounded(&[varied(random)]),
                "axis": rounded(&axis(direction, hang, own).to_array()),
                "hue": rounded(&hue(tint, own).to_array()),
            })
        });
        shapes.collect()
    }

    /// Clients place and shape them by themselves: both must find what is in `golden/ornaments.json`.
    ///
    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-export ornaments`.
    #[test]
    fn flowers_and_fruits_are_as_it_was_written_down() {
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/ornaments.json");
        let samples = json!({ "places": bearing(), "shapes": shapes() });
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, format!("{samples}\n")).expect("the samples can be written");
        }
        let stored = fs::read_to_string(&file).expect("the samples can be read");
        let stored: Value = serde_json::from_str(&stored).expect("the samples are JSON");
        let written: Value = serde_json::from_str(&samples.to_string()).expect("so are these");
        assert!(stored == written, "flowers and fruits differ from golden/ornaments.json");
    }

    #[test]
    fn flowers_that_are_given_stand_in_place_of_others() {
        let look = FlowerLook {
            kind: FlowerKind::Rosette,
            share: 1.0,
            place: Place::Wood,
            ..Appearance::default().flowers
        };
        let one = triangles(|cards| add_flowers(cards, &BEARER, &look)) / 7;
        let organ = |kind| Organ { kind, azimuth: 9, inclination: 90, roll: 0, length: 40 };
        let [flower, fruit] = [OrganKind::Flower, OrganKind::Fruit].map(organ);
        let bearer = Bearer { organs: &[flower, fruit, flower], ..BEARER };
        assert_eq!(triangles(|cards| add_flowers(cards, &bearer, &look)), 2 * one);
        let none = FlowerLook { kind: FlowerKind::None, ..look };
        assert_eq!(triangles(|cards| add_flowers(cards, &bearer, &none.with_given())), 2 * one);
        assert_eq!(triangles(|cards| add_flowers(cards, &BEARER, &none.with_given())), 0);
        let fruit = Bearer { organs: &[fruit], ..BEARER };
        assert_eq!(triangles(|cards| add_flowers(cards, &fruit, &look)), 7 * one);
    }

    #[test]
    fn a_share_of_the_places_bears_flowers() {
        let bearing = |own: f32, vigor| {
            let organ = OrganKind::Flower;
            let placing = Placing { organ, share: 0.5, place: Place::Wood, vigor, salt: FLOWER_SALT };
            (0..200).filter(|&row| Bearer { row, vigor: own, ..BEARER }.bears(&placing)).count()
        };
        assert!((75..125).contains(&bearing(0.0, 0.0)) && bearing(0.0, 0.0) == bearing(1.0, 0.0));
        assert!(bearing(1.0, 1.0) == 200 && bearing(0.0, 1.0) == 0 && bearing(0.0, -1.0) == 200);
    }
}
