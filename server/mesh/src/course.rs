//! The way an axis takes: its nodes and the radii there.

use espalier_plant::{MetamerId, Plant};
use glam::Vec3;

use crate::{radius_code::MIN_RADIUS, style::Style};

/// The end of an axis is slimmer than its last node's tips make it, as long as nothing grows on from it.
const TIP_SHARE: f32 = 0.45;

/// One living axis, from the node that bears it to its tip.
#[derive(Clone, Debug)]
pub(crate) struct Course {
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
    /// A lateral of radius `own` on a bearer of radius `bearing`.
    fn collar(own: f32, bearing: f32) -> Self {
        // A collar as wide as its bearer would show through the bearer's flat sides.
        Self {
            amount: ((0.95 * bearing).min(1.8 * own) - own).max(0.0),
            hidden: 0.5 * bearing,
            falloff: 0.8 * bearing.min(2.5 * own),
        }
    }

    /// A trunk of radius `own` where it meets the ground.
    fn root(own: f32) -> Self {
        Self { amount: 0.65 * own, hidden: 0.0, falloff: 0.85 * own + 0.05 }
    }

    /// What it adds at a length from the beginning.
    pub fn at(&self, arc: f32) -> f32 {
        self.amount * libm::expf(-(arc - self.hidden).max(0.0) / self.falloff)
    }
}

/// The courses of all living axes that have wood, in the order of the axes.
pub(crate) fn courses(plant: &Plant, style: &Style) -> Vec<Course> {
    let metamers = plant.metamers();
    let mut course_of_axis: Vec<Option<Course>> = vec![None; plant.axis_count()];
    let mut bears = vec![false; plant.metamer_count()];
    let mut tip_of_axis = vec![0; plant.axis_count()];
    for index in 0..plant.metamer_count() {
        let id = MetamerId::new(index);
        let Some(parent) = metamers.parent(id).filter(|_| plant.is_alive(id)) else { continue };
        bears[parent.index()] = true;
        let axis = metamers.axis(id).index();
        let course = course_of_axis[axis].get_or_insert_with(|| begin(plant, style, parent, id));
        course.nodes.push(metamers.end(id));
        course.radii.push(radius(plant, style, id));
        tip_of_axis[axis] = index;
    }
    let slim_tips = |(course, tip): (Option<Course>, usize)| {
        let mut course = course?;
        if let Some(radius) = course.radii.last_mut().filter(|_| !bears[tip]) {
            *radius *= TIP_SHARE;
        }
        Some(course)
    };
    course_of_axis.into_iter().zip(tip_of_axis).filter_map(slim_tips).collect()
}

/// A course that begins at `bearer` with its first metamer `first`.
fn begin(plant: &Plant, style: &Style, bearer: MetamerId, first: MetamerId) -> Course {
    let metamers = plant.metamers();
    let start = metamers.end(bearer);
    let own = radius(plant, style, first);
    let below = metamers.parent(bearer).map(|below| metamers.end(below));
    Course {
        nodes: vec![start],
        radii: vec![own],
        // A lateral leaves along its bearer and bends away; a trunk comes out of the ground as it goes on.
        before: below.unwrap_or(2.0 * start - metamers.end(first)),
        normal: metamers.normal(first),
        flare: if below.is_some() {
            Flare::collar(own, radius(plant, style, bearer))
        } else {
            Flare::root(own)
        },
    }
}

fn radius(plant: &Plant, style: &Style, id: MetamerId) -> f32 {
    // Texture coordinates divide by it.
    style.girth().radius(plant.metamers().tips(id)).max(MIN_RADIUS)
}
