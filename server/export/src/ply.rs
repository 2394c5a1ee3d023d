//! A point cloud of wood, leaves, flowers and fruits, as a scanner without noise would see it, with what each point lies on.

use std::f64::consts::{PI, TAU};

use espalier_mesh::Style;
use espalier_plant::{MetamerId, Plant, hash::StableHash};
use espalier_settings::Appearance;
use glam::{DVec2, DVec3};

use crate::{
    ExportError, Sink,
    foliage::{Foliage, cards::Cards, living},
    painted::Painted,
    structure::{Structure, z_up},
};

const WOOD: u8 = 0;
const LEAF: u8 = 1;
const FLOWER: u8 = 2;
const FRUIT: u8 = 3;
/// Parts of each side of a triangle of a card; whether anything is there is asked in the middle of each.
const PARTS: u16 = 4;

/// How a plant is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// Points in the cloud.
    pub points: u32,
    /// The seed of where they lie.
    pub seed: u32,
}

/// So many points, spread evenly over the area of wood and all that it bears, in metres, Z up; see `docs/formats.md`. A plant
/// without wood has none.
///
/// # Errors
/// Where an internode cannot be as long as that, or the file cannot be written.
pub fn ply(
    plant: &Plant,
    style: &Style,
    looks: &Appearance,
    metres_per_internode: f32,
    Sampling { points, seed }: Sampling,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let structure = Structure::of(plant, style, metres_per_internode)?;
    let foliage = Foliage::of(plant, style, looks, 0);
    let kinds = Kind::all(&foliage);
    let patches = || patches(&structure, &foliage, &kinds);
    let total: f64 = patches().map(|patch| patch.area).sum();
    let points = if total > 0.0 { points } else { 0 };
    out.write_all(head(points).as_bytes())?;
    let (mut below, mut next) = (0.0, 0);
    for patch in patches() {
        below += patch.area;
        // Each point has the same share of the area, and lies on what is in the middle of its share. The sum is the
        // same as that of the total, so that no point is left over.
        while next < points && (f64::from(next) + 0.5) * total <= below * f64::from(points) {
            let (place, normal) = patch.sample(unit_square(seed, next));
            let [place, normal] =
                [z_up(place * structure.metres(1.0)), z_up(normal)].map(|v| v.as_vec3().to_array());
            for part in place.into_iter().chain(normal) {
                out.write_all(&part.to_le_bytes())?;
            }
            out.write_all(&[patch.label])?;
            out.write_all(&structure.number(patch.metamer).to_le_bytes())?;
            next += 1;
        }
    }
    Ok(())
}

fn head(points: u32) -> String {
    let mut head = format!(
        "ply\nformat binary_little_endian 1.0\n\
         comment Espalier: label {WOOD} is wood, {LEAF} a leaf, {FLOWER} a flower, {FRUIT} a fruit\n"
    );
    head += &format!("element vertex {points}\n");
    for property in ["x", "y", "z", "nx", "ny", "nz"] {
        head += &format!("property float {property}\n");
    }
    head + "property uchar label\nproperty uint metamer\nend_header\n"
}

/// A piece of surface, in internodes.
struct Patch {
    metamer: MetamerId,
    label: u8,
    area: f64,
    form: Form,
}

enum Form {
    /// The mantle of a frustum: where its axis begins and ends, and the radii there.
    Mantle([DVec3; 2], [f64; 2]),
    Triangle([DVec3; 3]),
}

/// All surfaces, wood first.
fn patches<'a>(
    structure: &'a Structure<'_>,
    foliage: &'a Foliage<'_>,
    kinds: &'a [Kind],
) -> impl Iterator<Item = Patch> + use<'a> {
    let wood = structure.metamers.iter().filter_map(|&id| mantle(structure, id));
    let borne = move |id| kinds.iter().flat_map(move |kind| kind.patches(id, foliage));
    wood.chain(living(structure.plant).flat_map(borne))
}

/// Leaves, flowers or fruits: what they are called, what is there of their cards, and what adds these.
struct Kind {
    label: u8,
    painted: Painted,
    add: fn(&Foliage<'_>, &mut Cards, MetamerId),
}

impl Kind {
    /// Those that a plant has.
    fn all(foliage: &Foliage<'_>) -> Vec<Self> {
        let look = foliage.look();
        let leaves = Self {
            label: LEAF,
            painted: Painted::leaf(look.leaves.shape),
            add: |foliage, cards, id| foliage.add_leaves(cards, id),
        };
        let flowers = Painted::flower(look.flowers.kind);
        let flowers = flowers.map(|painted| Self {
            label: FLOWER,
            painted,
            add: |foliage, cards, id| foliage.add_flowers(cards, id),
        });
        let fruits = Painted::fruit(look.fruits.kind);
        let fruits = fruits.map(|painted| Self {
            label: FRUIT,
            painted,
            add: |foliage, cards, id| foliage.add_fruits(cards, id),
        });
        [leaves].into_iter().chain(flowers).chain(fruits).collect()
    }

    /// What is there of the cards on a metamer.
    fn patches(&self, metamer: MetamerId, foliage: &Foliage<'_>) -> Vec<Patch> {
        let mut cards = Cards::default();
        (self.add)(foliage, &mut cards, metamer);
        covered(&cards, (metamer, self.label), &self.painted)
    }
}

/// What pictures cover of cards.
fn covered(cards: &Cards, (metamer, label): (MetamerId, u8), painted: &Painted) -> Vec<Patch> {
    let mesh = &cards.mesh;
    let mut patches = Vec::new();
    for &corners in mesh.indices.as_chunks::<3>().0 {
        let places = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
        let uvs = corners.map(|corner| mesh.uvs[corner as usize]);
        let [a, b, c] = places;
        let area = 0.5 * (b - a).cross(c - a).length() / f64::from(PARTS * PARTS);
        for part in parts() {
            let at = |[b, c]: [f64; 2]| places[0] * (1.0 - b - c) + places[1] * b + places[2] * c;
            let [b, c] = [0, 1].map(|i| part.iter().map(|corner| corner[i]).sum::<f64>() as f32 / 3.0);
            if painted.covers(uvs[0] * (1.0 - b - c) + uvs[1] * b + uvs[2] * c) {
                patches.push(Patch { metamer, label, area, form: Form::Triangle(part.map(at)) });
            }
        }
    }
    patches
}

/// The parts of a triangle, all alike: how far each corner is on the way to the second and the third corner of the whole.
fn parts() -> impl Iterator<Item = [[f64; 2]; 3]> {
    let at = |b: u16, c: u16| [b, c].map(|parts| f64::from(parts) / f64::from(PARTS));
    (0..PARTS).flat_map(move |b| {
        (0..PARTS - b).flat_map(move |c| {
            let upright = [at(b, c), at(b + 1, c), at(b, c + 1)];
            let turned = [at(b + 1, c), at(b + 1, c + 1), at(b, c + 1)];
            [Some(upright), (b + c + 1 < PARTS).then_some(turned)].into_iter().flatten()
        })
    })
}

fn mantle(structure: &Structure<'_>, metamer: MetamerId) -> Option<Patch> {
    let metamers = structure.plant.metamers();
    let parent = metamers.parent(metamer)?;
    let radius = f64::from(structure.radius(metamer));
    // A lateral begins as thick as it goes on, and so does a trunk.
    let is_first = structure.plant.is_seed(parent) || metamers.axis(parent) != metamers.axis(metamer);
    let base = if is_first { radius } else { structure.radius(parent).into() };
    let ends = [metamers.end(parent), metamers.end(metamer)].map(|end| end.as_dvec3());
    let slant = libm::hypot(ends[0].distance(ends[1]), base - radius);
    let (area, form) = (PI * (base + radius) * slant, Form::Mantle(ends, [base, radius]));
    Some(Patch { metamer, label: WOOD, area, form })
}

impl Patch {
    /// The point for a place in the unit square, and the unit normal there.
    fn sample(&self, at: DVec2) -> (DVec3, DVec3) {
        match self.form {
            Form::Mantle([from, to], [base, top]) => {
                // The share of the area below a cross-section grows with the square of the radius.
                let radius = libm::sqrt(base * base + at.x * (top * top - base * base));
                let along = if base == top { at.x } else { (radius - base) / (top - base) };
                let axis = (to - from).normalize_or(DVec3::Y);
                let (side, front) = axis.any_orthonormal_pair();
                let (sin, cos) = libm::sincos(TAU * at.y);
                let outward = side * cos + front * sin;
                let normal = outward * from.distance(to) + axis * (base - top);
                (from.lerp(to, along) + outward * radius, normal.normalize_or(outward))
            }
            Form::Triangle([a, b, c]) => {
                let root = libm::sqrt(at.x);
                let place = a * (1.0 - root) + b * (root * (1.0 - at.y)) + c * (root * at.y);
                (place, (b - a).cross(c - a).normalize_or(DVec3::Y))
            }
        }
    }
}

/// A place in the unit square, the same for the same seed and number.
fn unit_square(seed: u32, number: u32) -> DVec2 {
    let mut hash = StableHash::default();
    hash.word(u64::from(seed) << 32 | u64::from(number));
    let bits = hash.finish();
    let unit = |bits: u64| (bits as u32) as f64 / (1u64 << 32) as f64;
    DVec2::new(unit(bits), unit(bits >> 32))
}

#[cfg(test)]
mod tests {
    use espalier_mesh::StyleOptions;
    use espalier_plant::{AxisId, Internode};
    use espalier_settings::LeafKind;
    use glam::Vec3;

    use super::*;

    fn area([a, b, c]: [DVec3; 3]) -> f64 {
        0.5 * (b - a).cross(c - a).length()
    }

    #[test]
    fn leaves_are_where_their_pictures_cover_their_cards() {
        let mut plant = Plant::new(Vec3::ZERO);
        plant.begin_step();
        plant.extend(AxisId::new(0), &Internode { end: Vec3::Y, normal: Vec3::X, laterals: &[] });
        plant.end_step();
        let style = Style::new(StyleOptions { leaves_per_node: 4, ..StyleOptions::default() });
        let id = MetamerId::new(1);
        for &shape in LeafKind::ALL {
            let mut looks = Appearance::default();
            looks.leaves.shape = shape;
            let (foliage, painted) = (Foliage::of(&plant, &style, &looks, 0), Painted::leaf(shape));
            let mut cards = Cards::default();
            foliage.add_leaves(&mut cards, id);
            let triangles = cards.mesh.indices.as_chunks::<3>().0.iter();
            let all: f64 = triangles
                .map(|corners| area(corners.map(|corner| cards.mesh.positions[corner as usize].as_dvec3())))
                .sum();
            let patches = Kind::all(&foliage)[0].patches(id, &foliage);
            for patch in &patches {
                let Form::Triangle(corners) = patch.form else { panic!("a leaf is no mantle") };
                assert!((area(corners) / patch.area - 1.0).abs() < 1e-3, "{shape:?}");
            }
            let share = patches.iter().map(|patch| patch.area).sum::<f64>() / all;
            let texels = painted.colours.len() as f64;
            let covered = painted.colours.iter().filter(|texel| texel[3] >= 128).count() as f64 / texels;
            assert!((share / covered - 1.0).abs() < 0.4, "{shape:?}: {share} of {covered}");
        }
    }
}
