//! A limb of a plant that grew, and the outline around it.

use espalier_plant::{Girth, MetamerId, Plant};
use glam::{Mat3, Vec3};

use super::{limbs::Rows, outline::around};
use crate::{
    envelope::{Envelope, RADII},
    frame::upward,
};

/// Fewer nodes than this say nothing of an outline.
const LEAST_NODES: usize = 8;
/// Most nodes that an outline is fitted to.
const MOST_NODES: usize = 4096;
/// As far as an outline reaches in its own units.
const ROOMY: f32 = 3.5;
/// The least distance of base and tip in these units.
const LEAST_CHORD: f32 = 0.1;
/// An outline is so wide at least, in internodes.
const LEAST_RADIUS: f32 = 0.75;
/// At most this share of the nodes stays outside.
const OUTSIDE: f32 = 0.04;
/// By how much an outline grows at a time, and most times that it does.
const WIDER: f32 = 1.04;
const MOST_GROWTH: usize = 24;

/// A limb that grew, with all that stands on it, and the outline around it.
#[derive(Clone, Debug, PartialEq)]
pub struct GrownLimb {
    /// The row that it begins with.
    pub first: MetamerId,
    /// The metamer that bears it; none for a trunk.
    pub bearer: Option<MetamerId>,
    /// Where it begins.
    pub base: Vec3,
    /// X on the side that looks up, Y from its base to its tip.
    pub frame: Mat3,
    /// From its base to its tip.
    pub length: f32,
    /// Its radius at its base.
    pub radius: f32,
    /// Where its bearer goes; up for a trunk.
    pub heading: Vec3,
    /// The outline in this frame, of which T is the tip.
    pub outline: Envelope,
    /// Branches that stand on its own axis.
    pub bears: u32,
}

impl GrownLimb {
    /// The limb that a living row lies on, where at each fork the thickest child goes on; none for a seed.
    pub fn around(plant: &Plant, girth: &Girth, row: MetamerId) -> Option<Self> {
        let metamers = plant.metamers();
        let seed = std::iter::successors(Some(row), |&at| metamers.parent(at)).last()?;
        if seed == row || !plant.is_alive(row) {
            return None;
        }
        let rows = Rows::of(plant, girth, seed);
        let number = |id: MetamerId| rows.all.binary_search(&id).ok();
        let mut first = number(row)?;
        let mut below = number(metamers.parent(row)?)?;
        while below > 0 && rows.heirs[below] == Some(first as u32) {
            first = below;
            below = number(metamers.parent(rows.all[first])?)?;
        }
        let base = rows.place(below as u32);
        let heading = if below == 0 { Vec3::Y } else { plant.heading(rows.all[below]) };
        let axis: Vec<u32> =
            std::iter::successors(Some(first as u32), |&row| rows.heirs[row as usize]).collect();
        let away = |row: &u32| rows.place(*row).distance_squared(base);
        let tip = axis.iter().copied().max_by(|a, b| away(a).total_cmp(&away(b)))?;
        let chord = rows.place(tip) - base;
        let length = chord.length().max(LEAST_RADIUS);
        let direction = chord.normalize_or(heading);
        let frame = upward(direction, if below == 0 { Vec3::X } else { heading });
        let nodes = rows.crown(first as u32, &axis);
        let unit = unit_of(&nodes, base, length);
        let outline = outline(&nodes, base, frame, unit, length);
        let forks = axis.iter().map(|&row| rows.children(row).len().saturating_sub(1));
        Some(Self {
            first: rows.all[first],
            bearer: (below > 0).then(|| rows.all[below]),
            base,
            frame,
            length,
            radius: rows.widths.radius(rows.all[first]),
            heading,
            outline,
            bears: forks.sum::<usize>() as u32,
        })
    }
}

/// Internodes to a unit of the outline: the way from base to tip, or more where the limb reaches much farther than that.
fn unit_of(nodes: &[Vec3], base: Vec3, length: f32) -> f32 {
    let extent = nodes.iter().map(|place| (*place - base).abs().max_element()).fold(0.0, f32::max);
    length.max(extent / ROOMY)
}

fn outline(nodes: &[Vec3], base: Vec3, frame: Mat3, unit: f32, length: f32) -> Envelope {
    let back = frame.transpose();
    let few = nodes.iter().step_by(nodes.len().div_ceil(MOST_NODES).max(1));
    let places: Vec<Vec3> = few.map(|place| back * (*place - base) / unit).collect();
    let tip = Vec3::Y * (length / unit).max(LEAST_CHORD);
    let fitted = (places.len() >= LEAST_NODES).then(|| around(&places, tip));
    let mut outline = match fitted.filter(|outline| outline.check().is_ok()) {
        Some(outline) => outline,
        None => scaled_ovoid(tip),
    };
    for radius in &mut outline.radii {
        *radius = radius.max(LEAST_RADIUS / unit).min(RADII.1);
    }
    for _ in 0..MOST_GROWTH {
        let outside = places.iter().filter(|place| !outline.contains(**place)).count();
        if outside as f32 <= OUTSIDE * places.len() as f32 {
            break;
        }
        let wider = grown(&outline);
        if wider.check().is_err() {
            break;
        }
        outline = wider;
    }
    outline
}

/// The usual outline, as long as its tip is away.
fn scaled_ovoid(tip: Vec3) -> Envelope {
    let (usual, length) = (Envelope::default(), tip.y);
    Envelope {
        top: usual.top * length,
        bottom: usual.bottom * length,
        radii: usual.radii.map(|radius| (radius * length).max(RADII.0)),
        heights: usual.heights.map(|height| height * length),
        tip,
        ..usual
    }
}

fn grown(outline: &Envelope) -> Envelope {
    let room = 0.5 * (WIDER - 1.0) * (outline.top.y - outline.bottom.y);
    Envelope {
        top: outline.top + Vec3::Y * room,
        bottom: outline.bottom - Vec3::Y * room,
        radii: outline.radii.map(|radius| (radius * WIDER).min(RADII.1)),
        ..outline.clone()
    }
}
