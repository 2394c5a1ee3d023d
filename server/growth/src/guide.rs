//! Leading: one axis follows the finger.
//!
//! Markers alone cannot do this: a narrow brush has none left to sow, and buds turn to a cloud of markers as their
//! habit lets them, which loses strokes that go down, back or around. So a brush also leads: the bud nearest to where
//! the stroke begins becomes its leader and grows from point to point of the path. How strongly it is led falls from 1,
//! where the brush is half as wide as a zone, to [`LEAST_WEIGHT`] where it is as wide or wider; there the axis' own
//! habit bends it, but never so far that it would not come nearer to its next point.
//!
//! An axis leads one stroke at a time, or two would pull it to and fro between them. A stroke that finds every bud in
//! reach leading another waits until there are more. Where the paths of several strokes run together, one of them
//! leads, and the others branch off where their paths part.

use std::collections::{BTreeSet, VecDeque};

use espalier_plant::{AxisId, MetamerId};
use glam::Vec3;

use crate::{
    brush::BrushSample,
    obstacles::{CLEARANCE, Obstacles},
    shoot::GROUND_CLEARANCE,
    space::Space,
    sweep::Sweep,
};

/// A point of the path still ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// Where.
    pub position: Vec3,
    /// How strongly it leads, 0 to 1.
    pub weight: f32,
}

/// One stroke: the path that its leader has not yet followed, and what the brush has swept.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// The axis that follows the path, once it is chosen.
    pub leader: Option<AxisId>,
    /// What lies ahead of it.
    pub path: VecDeque<Waypoint>,
    /// Where the brush has been.
    pub sweep: Sweep,
    /// Metamers from this one on were born after the stroke had begun.
    pub first_born: MetamerId,
    /// Whether nothing has come to the path yet.
    pub is_connecting: bool,
    /// Whether no bud was near when a leader was last asked for.
    pub is_out_of_reach: bool,
}

/// A leader that heeds its path less than this might turn away from it: with it, no habit takes an axis more than 42°
/// off the way to its next point.
const LEAST_WEIGHT: f32 = 0.6;
/// A node must lie this near to the end of the path for it to be followed.
const ARRIVED: f32 = 0.5;
/// Points nearer together than this say nothing new.
const LEAST_SPACING: f32 = 0.05;
/// Path needed before a narrow stroke's direction is known, in internodes.
const ASSURED_LENGTH: f32 = 0.5;
/// Points remembered at most: a leader that cannot follow is not waited for.
const MAX_WAYPOINTS: usize = 4096;
/// How far from a bud a stroke may begin, in internodes: so far, a limb grows to where it begins.
pub const REACH: f32 = 25.0;
/// What a turn by a right angle counts for, and an obstacle in between, when a leader is chosen; in internodes.
const TURN_COST: f32 = 0.75;
const OBSTACLE_COST: f32 = 10.0;
/// Path that is given up at a time where the leader is blocked, in internodes.
const SKIPPED: f32 = 1.0;
/// Paths that are nearer to each other run together, in internodes.
const TOGETHER: f32 = 1.0;

impl Guide {
    /// A stroke that begins now, in a plant with so many metamers.
    pub fn new(metamers: usize) -> Self {
        Self {
            leader: None,
            path: VecDeque::new(),
            sweep: Sweep::default(),
            first_born: MetamerId::new(metamers),
            is_connecting: true,
            is_out_of_reach: false,
        }
    }

    /// How strongly a brush of this radius leads.
    pub(crate) fn weight(radius: f32, occupancy_radius: f32) -> f32 {
        (1.5 - radius / occupancy_radius).clamp(LEAST_WEIGHT, 1.0)
    }

    /// Takes in more of the stroke. Where the finger goes below the ground, the path goes along it.
    pub(crate) fn follow(&mut self, sample: BrushSample, occupancy_radius: f32) {
        self.sweep.add(sample);
        let BrushSample { position, radius } = sample;
        let position = above_ground(position);
        let apart = self.path.back().is_none_or(|last| last.position.distance(position) > LEAST_SPACING);
        if apart {
            if self.path.len() >= MAX_WAYPOINTS {
                self.path.pop_front();
            }
            self.path.push_back(Waypoint { position, weight: Self::weight(radius, occupancy_radius) });
        }
    }

    /// Whether the brush is wider than a zone where its path goes on, so that it fills space rather than draws a line.
    pub(crate) fn is_wide(&self, occupancy_radius: f32) -> bool {
        let brush = self.sweep.places().last();
        brush.is_some_and(|brush| brush.radius > occupancy_radius)
    }

    /// Forgets the points ahead that a wide brush would find filled by wood older than the stroke: it leads on from
    /// what is nearest to the first that is free.
    pub(crate) fn skip_filled(&mut self, space: &Space, occupancy_radius: f32) {
        if !self.is_wide(occupancy_radius) {
            return;
        }
        let is_old = |id: MetamerId| id < self.first_born;
        let filled = |point: &&Waypoint| space.is_occupied(point.position, occupancy_radius, is_old);
        let count = self.path.iter().take_while(filled).count();
        if count > 0 {
            self.path.drain(..count);
            self.leader = None;
        }
    }

    /// Forgets the points ahead up to where the path parts from those of others that have leaders. Returns whether it
    /// runs together with them to its end.
    pub(crate) fn runs_along<'a>(&mut self, others: impl Iterator<Item = &'a Self>) -> bool {
        let others: Vec<&Sweep> =
            others.filter(|other| other.leader.is_some()).map(|other| &other.sweep).collect();
        let is_shared =
            |point: &&Waypoint| others.iter().any(|other| other.distance_to_path(point.position) < TOGETHER);
        let count = self.path.iter().take_while(is_shared).count();
        // The stroke branches off at the last shared point.
        self.path.drain(..count.saturating_sub(1));
        count > 0 && self.path.len() == 1
    }

    /// Chooses the leader, once the stroke's direction is known if it is a line: a near bud that may lead, is not
    /// `leading` another stroke, points along this one and sees where it begins.
    pub(crate) fn choose_leader(
        &mut self,
        space: &Space,
        obstacles: &Obstacles,
        occupancy_radius: f32,
        may_lead: impl Fn(AxisId) -> bool,
        leading: &BTreeSet<AxisId>,
    ) {
        let (Some(first), Some(last)) = (self.path.front(), self.path.back()) else { return };
        let is_vague = !self.is_assured();
        if self.leader.is_some() || (is_vague && !self.is_wide(occupancy_radius)) {
            return;
        }
        let towards = if is_vague { Vec3::ZERO } else { (last.position - first.position).normalize() };
        let mut best: Option<(f32, AxisId)> = None;
        let mut is_any_leading = false;
        space.visit_buds(first.position, REACH, |axis, bud, distance_squared| {
            let turn = TURN_COST * (1.0 - bud.direction.dot(towards));
            let least = distance_squared.sqrt() + turn;
            if best.is_some_and(|(cost, other)| (cost, other) <= (least, axis)) || !may_lead(axis) {
                return;
            }
            if leading.contains(&axis) {
                is_any_leading = true;
                return;
            }
            let is_hidden = obstacles.hides(bud.position, first.position);
            let cost = least + if is_hidden { OBSTACLE_COST } else { 0.0 };
            if best.is_none_or(|(c, a)| (cost, axis) < (c, a)) {
                best = Some((cost, axis));
            }
        });
        self.leader = best.map(|(_, axis)| axis);
        self.is_out_of_reach = best.is_none() && !is_any_leading;
        if self.is_out_of_reach {
            // The stroke leads from where it first passes a bud.
            let behind = self.path.len() - 1;
            self.path.drain(..behind);
        }
    }

    /// Gives up a leader that is blocked, and the next piece of the path.
    pub(crate) fn go_past(&mut self) {
        self.leader = None;
        let Some(stuck) = self.path.front().map(|point| point.position) else { return };
        let near = |point: &&Waypoint| point.position.distance(stuck) < SKIPPED;
        let count = self.path.iter().take_while(near).count();
        self.path.drain(..count);
    }

    /// Whether its direction is known, so that it can be led along a line.
    fn is_assured(&self) -> bool {
        let (first, last) = (self.path.front(), self.path.back());
        first.zip(last).is_some_and(|(first, last)| first.position.distance(last.position) >= ASSURED_LENGTH)
    }

    /// Whether all buds that are near lead other strokes. One out of reach, or that runs together with others, has but
    /// one point ahead.
    pub fn is_waiting(&self) -> bool {
        self.leader.is_none() && self.is_assured()
    }

    /// Where its path ends: the last place of the brush, above ground. None before there is any.
    pub fn end(&self) -> Option<Vec3> {
        self.sweep.places().last().map(|place| above_ground(place.position))
    }

    /// Whether any of the path lies ahead of a leader whose tip is at `tip`.
    pub(crate) fn is_ahead(&self, tip: Vec3) -> bool {
        self.path.back().is_some_and(|end| self.path.len() > 1 || end.position.distance(tip) >= ARRIVED)
    }

    /// The next node of a leader whose tip is at `tip`: the point one internode away on the path ahead, or on
    /// the way to it. None once the path is followed. Points passed are forgotten, and those that no wood can
    /// reach while there are others beyond.
    pub(crate) fn next_node(&mut self, tip: Vec3, obstacles: &Obstacles) -> Option<Waypoint> {
        // The path leaves the unit sphere around the tip for good behind the last point inside.
        while self.path.len() >= 2 && self.path[1].position.distance(tip) < 1.0 {
            self.path.pop_front();
        }
        let is_blocked = |place| obstacles.blocks(place, place, CLEARANCE);
        while self.path.len() >= 2 && is_blocked(self.path[0].position) {
            self.path.pop_front();
        }
        self.go_around(tip, obstacles);
        let front = *self.path.front()?;
        if front.position.distance(tip) >= 1.0 {
            return Some(front);
        }
        self.is_connecting = false;
        match self.path.get(1) {
            Some(&beyond) => {
                // What lies before the next node is followed; the path now begins there.
                let ahead = leave_sphere(front, beyond, tip);
                self.path[0] = ahead;
                Some(ahead)
            }
            None if front.position.distance(tip) >= ARRIVED => {
                // The last internode. It ends the path even if it misses the end by more than `ARRIVED`: asked once more,
                // the leader would turn back to it.
                self.path.pop_front();
                Some(front)
            }
            None => None,
        }
    }

    /// Puts a way around in front of the point ahead that an obstacle hides from the tip; where there is none, in front of
    /// the end of the path. Where no way leads there either, the path is given up.
    fn go_around(&mut self, tip: Vec3, obstacles: &Obstacles) {
        let is_passing = self.path.front().is_some_and(|front| front.position.distance(tip) < 1.0);
        let next = usize::from(is_passing);
        let is_hidden = |point: &Waypoint| obstacles.hides(tip, point.position);
        if !self.path.get(next).is_some_and(is_hidden) {
            return;
        }
        let end = self.path.len() - 1;
        let way = |to: usize| Some((to, obstacles.detour(tip, self.path[to].position)?));
        let found = way(next).or_else(|| if end > next { way(end) } else { None });
        let (passed, way) = found.unwrap_or_else(|| (self.path.len(), Vec::new()));
        self.path.drain(..passed);
        for position in way.into_iter().rev() {
            self.path.push_front(Waypoint { position, weight: 1.0 });
        }
    }
}

fn above_ground(place: Vec3) -> Vec3 {
    place.with_y(place.y.max(GROUND_CLEARANCE))
}

/// Where the segment from a point inside the unit sphere around `centre` to one outside leaves it.
fn leave_sphere(inside: Waypoint, outside: Waypoint, centre: Vec3) -> Waypoint {
    let along = outside.position - inside.position;
    let from = inside.position - centre;
    let (a, b, c) = (along.length_squared(), from.dot(along), from.length_squared() - 1.0);
    let t = ((-b + (b * b - a * c).max(0.0).sqrt()) / a).clamp(0.0, 1.0);
    Waypoint {
        position: inside.position + along * t,
        weight: inside.weight + (outside.weight - inside.weight) * t,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guide(points: &[Vec3]) -> Guide {
        let mut guide = Guide::new(0);
        for &position in points {
            guide.follow(BrushSample { position, radius: 0.0 }, 2.0);
        }
        guide
    }

    /// Nodes of a leader that starts at `tip` and obeys fully.
    fn nodes(mut guide: Guide, mut tip: Vec3) -> Vec<Vec3> {
        let mut nodes = Vec::new();
        while let Some(target) = guide.next_node(tip, &Obstacles::default()) {
            tip += (target.position - tip).normalize();
            nodes.push(tip);
            assert!(nodes.len() < 1000, "the path has an end");
        }
        nodes
    }

    #[test]
    fn nodes_lie_on_a_spiral_path() {
        let path: Vec<Vec3> = (0..400)
            .map(|i| {
                let (sin, cos) = libm::sincosf(i as f32 * 0.05);
                Vec3::new(6.0 * cos, 0.1 * i as f32, 6.0 * sin)
            })
            .collect();
        let start = path[0];
        for node in nodes(guide(&path), start) {
            let nearest = path.iter().map(|p| p.distance(node)).fold(f32::MAX, f32::min);
            assert!(nearest < 0.2, "{node} is {nearest} off the path");
        }
    }

    #[test]
    fn a_sharp_corner_is_not_cut() {
        let nodes = nodes(guide(&[Vec3::ZERO, Vec3::Y * 10.0, Vec3::new(10.0, 10.0, 0.0)]), Vec3::ZERO);
        let corner = Vec3::Y * 10.0;
        assert!(nodes.iter().any(|n| n.distance(corner) < 0.5));
        assert!(nodes.last().expect("it grew").distance(Vec3::new(10.0, 10.0, 0.0)) <= 0.5);
    }

    #[test]
    fn a_stroke_starting_away_is_walked_to() {
        let nodes = nodes(guide(&[Vec3::new(3.0, 4.0, 0.0), Vec3::new(3.0, 9.0, 0.0)]), Vec3::ZERO);
        assert!(nodes.iter().any(|n| n.distance(Vec3::new(3.0, 4.0, 0.0)) < 1.0));
    }

    #[test]
    fn weight_passes_from_brush_to_pencil() {
        assert_eq!(
            [0.0, 1.0, 1.5, 2.0, 2.1, 9.0].map(|r| Guide::weight(r, 2.0)),
            [1.0, 1.0, 0.75, 0.6, 0.6, 0.6]
        );
    }
}
