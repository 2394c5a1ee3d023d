//! One axis of wood: where it stands, how it goes, and where its laterals begin.

use std::sync::Arc;

use glam::{Mat3, Vec3};

use crate::{
    chance::{Chance, Purpose},
    frame::{across, of_tip, rolled, transported, turned, upward},
    key::Key,
    node::NodeId,
    resolution::Branch,
    table::Table,
};

/// The greatest bend by chance, as a share of the axis' length.
const BEND: f32 = 0.09;
/// Waves of which such a bend consists.
const WAVES: u32 = 3;
/// The greatest turn around the bearer by chance, in degrees.
const AZIMUTH: f32 = 40.0;
/// The greatest change of the branching angle by chance, in degrees.
const ANGLE: f32 = 20.0;
/// How far a place of laterals moves by chance, as a share of the way to the next one.
const PLACE: f32 = 0.35;
/// Places of laterals that are nearer to each other than this share of an internode are one node.
const ONE_NODE: f32 = 0.25;
/// Wood is never thinner, in internodes.
const THINNEST: f32 = 0.01;
/// A branch that would have fewer internodes is none.
const LEAST_INTERNODES: f32 = 1.5;
/// Length of a branch that begins outside its bearer's outline, in internodes.
pub(crate) const OUTSIDE: f32 = 2.0;

/// Where a branch stands, and how large it is: what its silhouette and its axis are drawn by.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The branch.
    pub node: NodeId,
    /// Its base, B.
    pub base: Vec3,
    /// X on the side that looks up, Y from its base to its tip, Z aside.
    pub frame: Mat3,
    /// From its base to its tip, |BT|, in internodes.
    pub length: f32,
    /// Radius at its base in internodes.
    pub radius: f32,
    /// Where on the bearer's axis it stands.
    pub t: f32,
    /// Where the bearer goes at that place.
    pub heading: Vec3,
    /// Whether it begins outside its bearer's outline, and so has no size from it.
    pub is_outside: bool,
    /// Where on its axis the highest of its branches stands; leaves stand above.
    pub leafy_from: f32,
    /// Its values.
    pub values: Arc<Table>,
}

impl Placed {
    /// The frame of its outline, and how many internodes one unit of it is.
    pub fn outline(&self) -> (Mat3, f32) {
        let envelope = self.values.envelope(Key::Silhouette);
        (self.frame * of_tip(envelope).transpose(), self.length / envelope.tip.length())
    }

    /// How far its outline is from a place within along a unit direction, in internodes; none from outside.
    pub fn distance(&self, from: Vec3, direction: Vec3) -> Option<f32> {
        let (frame, scale) = self.outline();
        let back = frame.transpose();
        let envelope = self.values.envelope(Key::Silhouette);
        envelope
            .distance(back * (from - self.base) / scale, back * direction)
            .map(|distance| distance * scale)
    }

    /// Leaves at an internode at place t.
    pub fn leaves(&self, t: f32) -> f32 {
        if t > self.leafy_from { self.values.function(Key::Leaves).at(t) } else { 0.0 }
    }

    /// Its radius at place t.
    pub fn radius_at(&self, t: f32) -> f32 {
        (self.radius * self.values.function(Key::Taper).at(t)).max(THINNEST)
    }

    /// Its length along its course, without what is cut off.
    pub(crate) fn course(&self) -> f32 {
        self.length * self.values.curve(Key::Axis).length() * self.values.scalar(Key::Cut)
    }
}

/// The stem of a plant.
pub(crate) fn stem(root: &Branch) -> Placed {
    let values = root.table();
    let tip = of_tip(values.envelope(Key::Silhouette));
    Placed {
        node: root.id(),
        base: Vec3::ZERO,
        frame: tip,
        length: values.scalar(Key::Height) * values.scalar(Key::Reach),
        radius: values.scalar(Key::Stem),
        t: 0.0,
        heading: Vec3::Y,
        is_outside: false,
        leafy_from: 0.0,
        values: values.clone(),
    }
}

/// A node of an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub place: Vec3,
    pub t: f32,
    pub heading: Vec3,
    /// The side that looked up at the base, carried along.
    pub side: Vec3,
}

/// An axis as nodes, and at which of them its laterals stand.
pub(crate) struct Laid<'a> {
    pub nodes: Vec<Node>,
    /// Laterals in order, each with the number of its node.
    pub laterals: Vec<(&'a Branch, usize)>,
    /// Branches that are not there, because they or their place were cut away.
    pub cut_away: usize,
}

/// Lays an axis down.
pub(crate) fn lay<'a>(branch: &'a Branch, placed: &Placed, seed: u32) -> Laid<'a> {
    let values = &placed.values;
    let (curve, cut) = (values.curve(Key::Axis), values.scalar(Key::Cut));
    let irregularity = values.scalar(Key::Irregularity);
    let course = curve.length() * placed.length;
    let internode = values.scalar(Key::Internode);
    let at = |t: f32| placed.base + placed.frame * ((curve.at(t) + waves(placed, seed, t)) * placed.length);
    // The axis is cut where laterals stand, and then into internodes.
    let nearest = ONE_NODE * internode / course;
    let mut laid = Laid { nodes: Vec::new(), laterals: Vec::new(), cut_away: 0 };
    let mut stops: Vec<(f32, Option<usize>)> = Vec::new();
    for (number, lateral) in branch.laterals().iter().enumerate() {
        let t = moved(branch, number, irregularity, seed).max(nearest);
        if t <= cut && lateral.values().scalar(Key::Shown) > 0.0 {
            stops.push((t, Some(number)));
        } else {
            laid.cut_away += lateral.count();
        }
    }
    stops.sort_by(|a, b| a.0.total_cmp(&b.0));
    stops.push((cut, None));
    let side = placed.frame.x_axis;
    let mut last = Node { place: placed.base, t: 0.0, heading: placed.frame.y_axis, side };
    for (t, lateral) in stops {
        if t - last.t >= nearest || (lateral.is_none() && laid.nodes.is_empty()) {
            let pieces = ((t - last.t) * course / internode - 1e-3).ceil().max(1.0);
            let from = last.t;
            for piece in 1..=pieces as usize {
                let t = if piece == pieces as usize { t } else { from + (t - from) * piece as f32 / pieces };
                let place = at(t);
                let way = place - last.place;
                if way.length() < espalier_plant::wood::SHORTEST {
                    last.t = t;
                    continue;
                }
                let heading = way.normalize();
                let carried = if laid.nodes.is_empty() {
                    across(side, heading)
                } else {
                    transported(last.side, last.heading, heading)
                };
                last = Node { place, t, heading, side: carried };
                laid.nodes.push(last);
            }
        }
        if let (Some(number), Some(node)) = (lateral, laid.nodes.len().checked_sub(1)) {
            laid.laterals.push((&branch.laterals()[number], node));
        }
    }
    laid
}

/// How far chance bends an axis at a place, in its frame and in its lengths.
pub(crate) fn waves(placed: &Placed, seed: u32, t: f32) -> Vec3 {
    let irregularity = placed.values.scalar(Key::Irregularity);
    let mut off = Vec3::ZERO;
    if irregularity == 0.0 {
        return off;
    }
    let bend = Chance::new(seed, placed.node, Purpose::Bend);
    for wave in 0..WAVES {
        let n = (wave + 1) as f32;
        let rise = libm::sinf(core::f32::consts::PI * n * t) * irregularity * BEND / n;
        off += Vec3::new(bend.signed(2 * wave), 0.0, bend.signed(2 * wave + 1)) * rise;
    }
    off
}

/// Where a lateral stands, chance included.
fn moved(branch: &Branch, number: usize, irregularity: f32, seed: u32) -> f32 {
    let laterals = branch.laterals();
    let lateral = &laterals[number];
    let t = lateral.t();
    if irregularity == 0.0 {
        return t;
    }
    // All of a whorl move as the first does, and nobody overtakes another.
    let first = laterals[..number].iter().rposition(|below| below.t() < t).map_or(0, |below| below + 1);
    let below = first.checked_sub(1).map_or(0.0, |below| laterals[below].t());
    let above = laterals[number..].iter().map(Branch::t).find(|&above| above > t).unwrap_or(1.0);
    let chance = Chance::new(seed, laterals[first].id(), Purpose::Place).signed(0) * irregularity;
    let room = if chance < 0.0 { t - below } else { above - t };
    t + chance * PLACE * room
}

/// Where a lateral stands that begins at a node of an axis; none where it would be too short to be seen.
pub(crate) fn place(lateral: &Branch, bearer: &Placed, node: &Node, seed: u32) -> Option<Placed> {
    let values = lateral.table();
    let direction = direction(lateral, bearer, node, seed);
    let distance = bearer.distance(node.place, direction);
    let is_outside = distance.is_none();
    let length = distance.unwrap_or(OUTSIDE) * values.scalar(Key::Reach);
    let radius = (values.scalar(Key::Girth) * bearer.radius_at(node.t)).max(THINNEST);
    let placed = Placed { radius, is_outside, ..placed_at(lateral, node, direction, length) };
    (placed.course() >= LEAST_INTERNODES * values.scalar(Key::Internode)).then_some(placed)
}

/// How a lateral of a direction and a length stands at a node, as thin as can be.
pub(crate) fn placed_at(lateral: &Branch, node: &Node, direction: Vec3, length: f32) -> Placed {
    let values = lateral.table();
    Placed {
        node: lateral.id(),
        base: node.place,
        frame: rolled(upward(direction, node.heading), values.scalar(Key::Roll)),
        length,
        radius: THINNEST,
        t: node.t,
        heading: node.heading,
        is_outside: false,
        leafy_from: 0.0,
        values: values.clone(),
    }
}

/// Where a lateral goes.
fn direction(lateral: &Branch, bearer: &Placed, node: &Node, seed: u32) -> Vec3 {
    let direction = unturned(lateral, bearer, node, seed);
    turned(direction, bearer.frame * lateral.values().vector(Key::Turn))
}

/// Where a lateral would go if nobody had turned it.
pub(crate) fn unturned(lateral: &Branch, bearer: &Placed, node: &Node, seed: u32) -> Vec3 {
    let values = &bearer.values;
    let chance = Chance::new(seed, lateral.id(), Purpose::Direction);
    let irregularity = values.scalar(Key::Irregularity);
    let azimuth = lateral.azimuth() + irregularity * AZIMUTH * chance.signed(0);
    let angle =
        values.function(Key::BranchingAngle).at(lateral.t()) + irregularity * ANGLE * chance.signed(1);
    let (sin_around, cos_around) = libm::sincosf(azimuth.to_radians());
    let (sin, cos) = libm::sincosf(angle.to_radians());
    let aside = node.side.cross(node.heading);
    let direction = node.heading * cos + (node.side * cos_around + aside * sin_around) * sin;
    let drawn = direction + lateral.values().vector(Key::Pull);
    // What draws it straight back leaves it as it goes.
    if drawn.length() > 1e-3 { drawn.normalize() } else { direction }
}
