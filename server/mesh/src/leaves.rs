//! Where leaves are: rules LF1 to LF5 of the protocol, by which clients place them too.

use std::f64::consts::TAU;

use espalier_plant::{MetamerId, Organ, OrganKind, Plant, Stance, organs};
use glam::Vec3;

use crate::{foliage, ring_table, style::Style};

/// The angle in radians between one row's leaves and the next row's.
const GOLDEN_ANGLE: f64 = 2.399_963_23;
/// Cosine of the angle to a direction from which on a vector counts as parallel to it.
const PARALLEL: f32 = 0.99;

/// One leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// Where it sits on its metamer.
    pub base: Vec3,
    /// Unit vector from its base to its tip.
    pub direction: Vec3,
    /// Unit vector out of its upper side, perpendicular to its direction.
    pub normal: Vec3,
    /// Length in internodes.
    pub size: f32,
    /// A number from 0 to 1 of its own, by which its form varies.
    pub random: f32,
}

/// The leaves that a metamer bears in the present.
pub fn of(plant: &Plant, id: MetamerId, style: &Style) -> impl Iterator<Item = Leaf> + use<> {
    let to = plant.metamers().end(id);
    let from = plant.metamers().parent(id).map_or(to, |parent| plant.metamers().end(parent));
    of_between(plant, id, style, [from, to])
}

/// The same, where the metamer is drawn between other places.
pub fn of_between(
    plant: &Plant,
    id: MetamerId,
    style: &Style,
    [from, to]: [Vec3; 2],
) -> impl Iterator<Item = Leaf> + use<> {
    let size = style.options().leaf_size;
    let organs = ring_table::told(plant, id).filter(|_| plant.is_alive(id));
    let is_given = organs.is_some();
    let leaves = organs.map(|organs| organs.to_vec()).unwrap_or_default().into_iter();
    let leaves = leaves.filter(|organ| organ.kind == OrganKind::Leaf);
    let given = given_on_metamer(id.raw(), 0, from, to, leaves, size);
    let count = if is_given { 0 } else { foliage::leaves(plant, id, style) };
    on_metamer(id.raw(), 0, from, to, count, size).chain(given)
}

/// Organs of one kind that the metamer in `row`, which runs from `from` to `to`, is given (LF5); none on one without
/// length. Those without a length of their own are as long as by LF2.
pub fn given_on_metamer(
    row: u32,
    salt: u32,
    from: Vec3,
    to: Vec3,
    organs: impl Iterator<Item = Organ>,
    size: f32,
) -> impl Iterator<Item = Leaf> {
    let heading = (to - from).try_normalize();
    (0..).zip(organs).filter_map(move |(k, organ)| {
        let heading = heading?;
        let Stance { direction, normal } = organ.stance(heading, organs::shortest_sides(heading));
        let random = own_number(row, salt, k);
        let size = organ.length().unwrap_or(size * (0.75 + 0.5 * random));
        Some(Leaf { base: to, direction, normal, size, random })
    })
}

/// The number of its own of something that a row bears, 0 to 1.
fn own_number(row: u32, salt: u32, k: u32) -> f32 {
    hash((row ^ salt).wrapping_mul(16).wrapping_add(k)) as f32 / (1u64 << 32) as f32
}

/// The leaves of the metamer in `row`, which runs from `from` to `to`; none on one without length. A `salt` other
/// than 0 gives other things than leaves places and numbers of their own.
pub fn on_metamer(
    row: u32,
    salt: u32,
    from: Vec3,
    to: Vec3,
    count: u8,
    leaf_size: f32,
) -> impl Iterator<Item = Leaf> {
    let heading = (to - from).try_normalize();
    let count = if heading.is_some() { count } else { 0 };
    let heading = heading.unwrap_or(Vec3::Y);
    // LF1
    let u = heading.cross(if heading.y.abs() > PARALLEL { Vec3::X } else { Vec3::Y }).normalize();
    let w = heading.cross(u);
    (0..count).map(move |k| {
        // LF2. In 64 bits, for 32 do not hold the angle of a row in the hundred thousands.
        let azimuth =
            GOLDEN_ANGLE * f64::from(row) + f64::from(salt % 7) + TAU * f64::from(k) / f64::from(count);
        let (cos, sin) = (libm::cos(azimuth) as f32, libm::sin(azimuth) as f32);
        let direction = (0.5 * heading + 0.866 * (cos * u + sin * w) - 0.15 * Vec3::Y).normalize();
        let random = own_number(row, salt, u32::from(k));
        // LF4
        let up = if direction.y.abs() > PARALLEL { heading } else { Vec3::Y };
        Leaf {
            base: from + (to - from) * (f32::from(k + 1) / f32::from(count)),
            direction,
            normal: up.reject_from_normalized(direction).normalize(),
            size: leaf_size * (0.75 + 0.5 * random),
            random,
        }
    })
}

/// The hash of LF3.
pub fn hash(input: u32) -> u32 {
    let x = input.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let y = ((x >> ((x >> 28) + 4)) ^ x).wrapping_mul(277_803_737);
    (y >> 22) ^ y
}

#[cfg(test)]
mod tests {
    use std::{fmt::Write, fs, path::PathBuf};

    use super::*;

    /// Leaves of many rows and headings as JSON, a leaf on each line.
    fn placed() -> String {
        let headings =
            [[0.0, 1.0, 0.0], [0.6, 0.8, 0.0], [-0.7, -0.1, 0.5], [0.05, -0.9, 0.02], [0.0, 0.2, -1.3]];
        let mut lines = Vec::new();
        for (i, row) in [1, 7, 36, 5_000, 250_000, 3_999_999].into_iter().enumerate() {
            for (j, &to) in headings.iter().enumerate() {
                let from = [0.0, 0.25 * i as f32, 0.5];
                let (from, to) = (Vec3::from_array(from), Vec3::from_array(from) + Vec3::from_array(to));
                let (count, salt) = ([1, 2, 3, 15][(i + j) % 4], [0, 0x1f3d, 0x6b21][(i + 2 * j) % 3]);
                for (k, leaf) in on_metamer(row, salt, from, to, count, 1.0).enumerate().step_by(4) {
                    let Leaf { base, direction, normal, random, .. } = leaf;
                    let mut line =
                        format!(r#"{{"row":{row},"salt":{salt},"k":{k},"count":{count},"random":{random:?}"#);
                    let places = [
                        ("from", from),
                        ("to", to),
                        ("base", base),
                        ("direction", direction),
                        ("normal", normal),
                    ];
                    for (name, place) in places {
                        // Writing to a string cannot fail.
                        let _ = write!(line, r#","{name}":{:?}"#, place.to_array());
                    }
                    lines.push(line + "}");
                }
            }
        }
        format!("[\n{}\n]\n", lines.join(",\n"))
    }

    /// Clients place leaves by themselves: both must place those in `golden/leaves.json`.
    ///
    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-mesh leaves`.
    #[test]
    fn lf1_to_lf4_leaves_are_as_they_were_written_down() {
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/leaves.json");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, placed()).expect("the leaves can be written");
        }
        assert!(fs::read_to_string(&file).is_ok_and(|stored| stored == placed()), "leaves differ");
    }

    /// Organs on many headings as JSON, one on each line.
    fn given() -> String {
        let headings =
            [[0.0, 1.0, 0.0], [0.6, 0.8, 0.0], [-0.7, -0.1, 0.5], [0.05, -0.9, 0.02], [0.0, -1.3, 0.0]];
        let mut lines = Vec::new();
        for (i, number) in (0u32..24).map(|i| (i, i.wrapping_mul(0x9e37_79b9) & 0x3fff_ffff)) {
            let (from, to) = (Vec3::Z, Vec3::Z + Vec3::from_array(headings[i as usize % headings.len()]));
            let organ = Organ::from_number(number).expect("a leaf");
            for leaf in given_on_metamer(7, 0, from, to, [organ].into_iter(), 1.0) {
                let [from, to, direction, normal] =
                    [from, to, leaf.direction, leaf.normal].map(|place| place.to_array());
                assert_eq!(leaf.base.to_array(), to, "organs stand at the end");
                let length = organ.length().unwrap_or_default();
                lines.push(format!(
                    r#"{{"organ":{number},"from":{from:?},"to":{to:?},"direction":{direction:?},"normal":{normal:?},"length":{length:?}}}"#
                ));
            }
        }
        format!("[\n{}\n]\n", lines.join(",\n"))
    }

    /// Clients place organs by themselves: both must place those in `golden/organs.json`.
    ///
    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-mesh leaves`.
    #[test]
    fn lf5_organs_stand_as_they_were_written_down() {
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/organs.json");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, given()).expect("the organs can be written");
        }
        assert!(fs::read_to_string(&file).is_ok_and(|stored| stored == given()), "organs differ");
    }

    /// Numbers from a separate calculation in 64 bits.
    #[test]
    fn lf1_to_lf4_place_leaves_as_calculated() {
        let check = |[row, k, count]: [u32; 3],
                     [from, to]: [[f32; 3]; 2],
                     leaf_size,
                     placed: [[f32; 3]; 3],
                     size: f32| {
            let [from, to] = [from, to].map(Vec3::from_array);
            let leaf = on_metamer(row, 0, from, to, count as u8, leaf_size)
                .nth(k as usize)
                .expect("it has the leaf");
            for (is, should) in [leaf.base, leaf.direction, leaf.normal].into_iter().zip(placed) {
                assert!(is.distance(Vec3::from_array(should)) < 2e-5, "row {row}: {is} is not {should:?}");
            }
            assert!((leaf.size - size).abs() < 2e-5, "row {row}: {} is not {size}", leaf.size);
        };
        // An upright metamer, for which X takes the place of Y.
        let upright = [[0.0, 0.33333, 0.0], [-0.62628, 0.37471, 0.68365], [0.25311, 0.92714, -0.2763]];
        check([1, 0, 3], [[0.0; 3], [0.0, 1.0, 0.0]], 0.7, upright, 0.60488);
        let oblique = [[1.6, 2.8, 3.0], [0.86936, -0.18486, -0.4583], [0.16353, 0.98277, -0.08621]];
        check([7, 2, 3], [[1.0, 2.0, 3.0], [1.6, 2.8, 3.0]], 0.7, oblique, 0.58444);
        // A row whose angle would be off by degrees in 32 bits.
        let late = [[-0.48, 10.6, 0.64], [-0.29082, -0.47528, 0.83038], [-0.1571, 0.87984, 0.44856]];
        check([250_000, 4, 5], [[0.0, 10.0, 0.0], [-0.48, 10.6, 0.64]], 1.0, late, 0.97212);
        // A leaf that points straight up, for which the heading takes the place of Y.
        let vertical = [[0.8, 0.6, 0.0], [-0.14049, 0.99007, 0.00496], [0.99008, 0.14051, -0.00273]];
        check([36, 0, 1], [[0.0; 3], [0.8, 0.6, 0.0]], 0.0, vertical, 0.0);
    }

    #[test]
    fn lf3_hash_gives_the_calculated_values() {
        let inputs = [0, 1, 16, 4_000_004, u32::MAX];
        let hashes = [129_708_002, 2_831_084_092, 980_210_444, 1_907_982_162, 3_861_530_882];
        assert_eq!(inputs.map(hash), hashes);
    }

    #[test]
    fn metamer_without_length_bears_nothing() {
        assert_eq!(on_metamer(1, 0, Vec3::ONE, Vec3::ONE, 3, 1.0).count(), 0);
    }
}
