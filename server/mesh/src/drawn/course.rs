//! The way a limb takes: its nodes and how thick it is there.

use espalier_plant::{AxisId, MetamerId, Plant, Widths};
use espalier_settings::BarkLook;
use glam::Vec3;

use super::{Drawn, RISES, Shape};
use crate::{
    Limbs, RingTable, Rows,
    radius_code::{LOG_STEP, MIN_RADIUS},
    style::Style,
};

/// The end of a limb is slimmer than its last node's tips make it, as long as nothing grows on from it.
const TIP_SHARE: f32 = 0.45;
/// An end so much thicker than the thinnest wood has been cut off.
const THICK_END: f32 = 1.7;
/// How much a lateral leaves along what bears it.
const LEAVES_ALONG: f32 = 0.55;

/// A place on the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub place: Vec3,
    /// Unit vector across which the ring lies.
    pub direction: Vec3,
    /// Without the flare.
    pub radius: f32,
    /// How fast it changes, as a share of itself per internode.
    pub slope: f32,
}

/// One limb, from the node that bears it to its tip.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    /// The seed that it has grown from.
    pub seed: MetamerId,
    /// The axis that it begins with.
    pub axis: AxisId,
    /// Its metamers, each of which ends at a node.
    pub rows: Vec<MetamerId>,
    /// One more than rows; the first is where it begins.
    pub nodes: Vec<Node>,
    /// Vector across the first ring, or nearly so, from which turns around the wood are counted.
    pub normal: Vec3,
    /// How the beginning is thickened.
    pub flare: Flare,
    /// What the last node is.
    pub end: End,
}

/// How a limb ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// With a bud, or where laterals took over.
    Grown,
    /// With the face of a cut.
    Cut,
}

/// The swelling where a limb begins: a collar on its bearer, or roots that spread.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Flare {
    Collar {
        /// Added to the radius at the beginning.
        amount: f32,
        /// Length from the beginning over which it does not decline, for that is inside the bearer.
        hidden: f32,
        /// Length over which it declines to 1/e.
        falloff: f32,
    },
    Roots {
        /// How much of its flare a trunk has.
        share: f32,
        /// How thick it is.
        foot: f32,
    },
}

impl Flare {
    /// A lateral of radius `own` on a bearer of radius `bearing`; `share` is how much of its collar it has.
    fn collar(own: f32, bearing: f32, share: f32) -> Self {
        // A collar as wide as its bearer would show through the bearer's flat sides.
        Self::Collar {
            amount: ((0.95 * bearing).min((1.0 + 0.8 * share) * own) - own).max(0.0),
            hidden: 0.5 * bearing,
            falloff: 0.8 * bearing.min(2.5 * own),
        }
    }

    /// What it makes of a radius at a length from the beginning: the mean around the wood, and how far ribs rise from that
    /// where they are highest, of which [`ribs`] is the shape.
    pub(crate) fn at(&self, along: f32, radius: f32) -> [f32; 2] {
        match *self {
            Self::Collar { amount, hidden, falloff } => {
                [radius + amount * libm::expf(-(along - hidden).max(0.0) / falloff), 0.0]
            }
            Self::Roots { share, foot } => {
                let height = along.max(0.0) / (foot + 0.05);
                let (wide, low) = (libm::expf(-0.7 * height), libm::expf(-1.6 * height));
                [radius * (1.0 + share * (0.22 * wide + MEAN_RIB * low)), radius * share * low]
            }
        }
    }

    /// How far below the ground the foot of a trunk is carried that comes out of it in such a direction.
    pub(crate) fn sinks(&self, direction: Vec3) -> f32 {
        match *self {
            Self::Collar { .. } => 0.0,
            Self::Roots { foot, .. } => {
                let leaning = direction.x * direction.x + direction.z * direction.z;
                foot * (0.5 + 0.9 * leaning.sqrt() + 1.1 * leaning)
            }
        }
    }
}

/// What ribs add to a radius on the average around the wood.
const MEAN_RIB: f32 = 0.36;

/// The shape of the ribs of roots around a trunk, as turns go; its mean is 0.
pub(crate) fn ribs(turn: f32) -> f32 {
    let angle = std::f32::consts::TAU * turn;
    let wave = angle * 5.0 + 1.3 * libm::sinf(angle * 2.0) + 0.9 * libm::cosf(angle);
    let rib = 0.5 + 0.5 * libm::sinf(wave);
    0.08 + 0.66 * rib * rib.sqrt() - MEAN_RIB
}

/// All living wood as it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Courses {
    /// Of all limbs, those that bear before those that are borne.
    pub all: Vec<Course>,
    pub limbs: Limbs,
    /// Where the node of each metamer is drawn.
    pub places: Vec<Vec3>,
}

impl Courses {
    pub(crate) fn of(plant: &Plant, style: &Style, look: &BarkLook) -> Self {
        let mut table = RingTable::new();
        table.sync(plant, style, 1);
        let rows = Rows::of(&table);
        let limbs = Limbs::of(&rows);
        let (metamers, widths) = (plant.metamers(), Widths::of(plant, style.girth()));
        let ids = (0..plant.metamer_count()).map(MetamerId::new);
        let places: Vec<Vec3> = ids.clone().map(|id| metamers.end(id)).collect();
        let is_wood = |id: MetamerId| rows.is_wood(id.index());
        let radii: Vec<f32> =
            ids.map(|id| if is_wood(id) { widths.radius(id).max(MIN_RADIUS) } else { 0.0 }).collect();
        let shape = Shape { root_flare: look.root_flare, is_rounded: look.smoothing > 0.0 };
        let drawn = Drawn::of(&rows, &limbs, &places, &radii, shape);
        let thinnest = rows.radius.iter().copied().filter(|&code| code > 0).min().unwrap_or(0);
        let thick_end = thinnest + (libm::logf(THICK_END) / LOG_STEP).ceil() as u16;
        let (seeds, bears) = (seeds(plant), bears(&rows));
        let course = |number: u32| {
            let limb = limbs.all()[number as usize];
            let mut course = begin(plant, &drawn, limb.first, limb.node, look);
            course.seed = seeds[limb.first as usize];
            course.rows = limbs.rows(number).iter().map(|&row| MetamerId::new(row as usize)).collect();
            course.nodes.extend(limbs.rows(number).iter().map(|&row| node(&drawn, row)));
            if let Some(&tip) = course.rows.last() {
                // A cut is as thick as its wood, and so is a constrained tip.
                let is_cut = !plant.is_axis_alive(metamers.axis(tip)) && !bears[tip.index()];
                let is_cut = is_cut || rows.radius[tip.index()] > thick_end;
                course.end = if is_cut { End::Cut } else { End::Grown };
                let is_slim = !is_cut && !bears[tip.index()] && widths.effective(tip).is_none();
                if let Some(node) = course.nodes.last_mut().filter(|_| is_slim) {
                    node.radius *= TIP_SHARE;
                }
            }
            course
        };
        let all = (0..limbs.all().len() as u32).map(course).collect();
        Self { all, places: drawn.places, limbs }
    }
}

/// Which rows bear living wood.
fn bears(rows: &Rows) -> Vec<bool> {
    let mut bears = vec![false; rows.len()];
    for row in (0..rows.len()).filter(|&row| rows.is_wood(row)) {
        bears[rows.parent[row] as usize] = true;
    }
    bears
}

/// The seed that each metamer has grown from.
pub fn seeds(plant: &Plant) -> Vec<MetamerId> {
    let mut seeds: Vec<MetamerId> = Vec::with_capacity(plant.metamer_count());
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        // A parent is always older.
        seeds.push(plant.metamers().parent(id).map_or(id, |parent| seeds[parent.index()]));
    }
    seeds
}

fn node(drawn: &Drawn, row: u32) -> Node {
    let row = row as usize;
    Node {
        place: drawn.places[row],
        direction: drawn.directions[row],
        radius: drawn.radii[row],
        slope: drawn.slopes[row],
    }
}

/// The course of a limb that begins at the node of `bearer` with the metamer `first`.
fn begin(plant: &Plant, drawn: &Drawn, first: u32, bearer: u32, look: &BarkLook) -> Course {
    let (above, below) = (node(drawn, first), node(drawn, bearer));
    let from_seed = plant.is_seed(MetamerId::new(bearer as usize));
    let heading = (above.place - below.place).normalize_or(Vec3::Y);
    // A lateral leaves along its bearer and bends away; one from the ground comes up, one from a cliff straight out.
    let direction = if from_seed {
        heading + RISES as f32 * heading.y.max(0.0) * Vec3::Y
    } else {
        heading + LEAVES_ALONG * below.direction
    };
    let flare = if from_seed {
        Flare::Roots { share: look.root_flare, foot: above.radius }
    } else {
        Flare::collar(above.radius, below.radius, look.collar)
    };
    let normal = drawn.normals[first as usize];
    let first = MetamerId::new(first as usize);
    Course {
        seed: first,
        axis: plant.metamers().axis(first),
        rows: Vec::new(),
        nodes: vec![Node {
            place: below.place,
            direction: direction.normalize_or(heading),
            radius: above.radius,
            slope: 0.0,
        }],
        normal,
        flare,
        end: End::Grown,
    }
}
