//! The way an axis takes: its nodes and the radii there.

use espalier_plant::{AxisId, MetamerId, Plant, Widths};
use espalier_settings::BarkLook;
use glam::Vec3;

use crate::{radius_code::MIN_RADIUS, style::Style};

/// The end of an axis is slimmer than its last node's tips make it, as long as nothing grows on from it.
const TIP_SHARE: f32 = 0.45;

/// One axis with living wood, from the node that bears it to its tip.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    /// The seed that it has grown from.
    pub seed: MetamerId,
    pub axis: AxisId,
    /// At least two; the first is the bearer's node or the seed.
    pub nodes: Vec<Vec3>,
    /// Radius at each node, without the flare.
    pub radii: Vec<f32>,
    /// A point before the first node that gives the curve its direction there.
    pub before: Vec3,
    /// Unit vector across the first metamer.
    pub normal: Vec3,
    /// How the beginning is thickened.
    pub flare: Flare,
    /// What the last node is.
    pub end: End,
}

/// How an axis ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// With a bud, or where a lateral took over.
    Grown,
    /// With the face of a cut.
    Cut,
}

/// The swelling where an axis begins: a collar on its bearer, or roots that spread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flare {
    /// Added to the radius at the beginning.
    pub amount: f32,
    /// Length from the beginning over which it does not decline, for that is inside the bearer.
    pub hidden: f32,
    /// Length over which it declines to 1/e.
    pub falloff: f32,
}

impl Flare {
    /// A lateral of radius `own` on a bearer of radius `bearing`; `share` is how much of its collar it has.
    fn collar(own: f32, bearing: f32, share: f32) -> Self {
        // A collar as wide as its bearer would show through the bearer's flat sides.
        Self {
            amount: ((0.95 * bearing).min((1.0 + 0.8 * share) * own) - own).max(0.0),
            hidden: 0.5 * bearing,
            falloff: 0.8 * bearing.min(2.5 * own),
        }
    }

    /// A trunk of radius `own` where it meets the ground; `share` is how much of its flare it has.
    fn root(own: f32, share: f32) -> Self {
        Self { amount: 0.65 * share * own, hidden: 0.0, falloff: 0.85 * own + 0.05 }
    }

    /// What it adds at a length from the beginning.
    pub fn at(&self, arc: f32) -> f32 {
        self.amount * libm::expf(-(arc - self.hidden).max(0.0) / self.falloff)
    }
}

/// The courses of all axes that have living wood, in the order of the axes.
pub(crate) fn courses(plant: &Plant, style: &Style, look: &BarkLook) -> Vec<Course> {
    let metamers = plant.metamers();
    let widths = Widths::of(plant, style.girth());
    let mut course_of_axis: Vec<Option<Course>> = vec![None; plant.axis_count()];
    let mut bears = vec![false; plant.metamer_count()];
    let mut tip_of_axis = vec![MetamerId::new(0); plant.axis_count()];
    let seeds = seeds(plant);
    for id in (0..plant.metamer_count()).map(MetamerId::new) {
        let Some(parent) = metamers.parent(id).filter(|_| plant.is_alive(id)) else { continue };
        bears[parent.index()] = true;
        let axis = metamers.axis(id);
        let course = course_of_axis[axis.index()]
            .get_or_insert_with(|| begin(plant, &widths, look, [seeds[id.index()], parent, id]));
        course.nodes.push(metamers.end(id));
        course.radii.push(radius(&widths, id));
        tip_of_axis[axis.index()] = id;
    }
    let finish = |(course, tip): (Option<Course>, MetamerId)| {
        let mut course = course?;
        if !bears[tip.index()] {
            // A cut is as thick as its wood, and so is a constrained tip.
            let is_cut = !plant.is_axis_alive(metamers.axis(tip));
            course.end = if is_cut { End::Cut } else { End::Grown };
            let is_slim = !is_cut && widths.effective(tip).is_none();
            if let Some(radius) = course.radii.last_mut().filter(|_| is_slim) {
                *radius *= TIP_SHARE;
            }
        }
        Some(course)
    };
    course_of_axis.into_iter().zip(tip_of_axis).filter_map(finish).collect()
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

/// The course of a plant from `seed` that begins at `bearer` with its first metamer `first`.
fn begin(
    plant: &Plant,
    widths: &Widths<'_>,
    look: &BarkLook,
    [seed, bearer, first]: [MetamerId; 3],
) -> Course {
    let metamers = plant.metamers();
    let start = metamers.end(bearer);
    let own = radius(widths, first);
    let below = metamers.parent(bearer).map(|below| metamers.end(below));
    Course {
        seed,
        axis: metamers.axis(first),
        nodes: vec![start],
        radii: vec![own],
        // A lateral leaves along its bearer and bends away; a trunk comes out of the ground as it goes on.
        before: below.unwrap_or(2.0 * start - metamers.end(first)),
        normal: metamers.normal(first),
        flare: if below.is_some() {
            Flare::collar(own, radius(widths, bearer), look.collar)
        } else {
            Flare::root(own, look.root_flare)
        },
        end: End::Grown,
    }
}

fn radius(widths: &Widths<'_>, id: MetamerId) -> f32 {
    // Texture coordinates divide by it.
    widths.radius(id).max(MIN_RADIUS)
}
