//! Sketching: as the brush's radius goes to zero, one axis follows the finger exactly.
//!
//! Markers alone cannot do this: there are none left to sow in a sphere without volume, and an axis that
//! turns towards a cloud of markers cuts corners. So a narrow brush also leads: the bud nearest to where the
//! stroke begins becomes its leader and grows from point to point of the path. How strongly it is led rises from
//! one half, where the radius is the occupancy radius, to 1 at half of it; there both forces mix.
//! A leader that is led more weakly would lose the path, and wider brushes sow markers enough to do without.

use std::collections::VecDeque;

use espalier_plant::AxisId;
use glam::Vec3;

use crate::{brush::BrushSample, space::Space};

/// A point of the path still ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// Where.
    pub position: Vec3,
    /// How strongly it leads, 0 to 1.
    pub weight: f32,
}

/// The path of one stroke that its leader has not yet followed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guide {
    /// The axis that follows the path, once it is chosen.
    pub leader: Option<AxisId>,
    /// What lies ahead of it.
    pub path: VecDeque<Waypoint>,
}

/// A leader that heeds its path less than this would stray from it.
const LEAST_WEIGHT: f32 = 0.5;
/// A node must lie this near to the end of the path for it to be followed.
const ARRIVED: f32 = 0.5;
/// Points nearer together than this say nothing new.
const LEAST_SPACING: f32 = 0.05;
/// Path needed before a stroke's direction is known, in internodes.
const ASSURED_LENGTH: f32 = 0.5;
/// Points remembered at most: a leader that cannot follow is not waited for.
const MAX_WAYPOINTS: usize = 4096;

impl Guide {
    /// How strongly a brush of this radius leads.
    pub(crate) fn weight(radius: f32, occupancy_radius: f32) -> f32 {
        let weight = 1.0 + LEAST_WEIGHT - radius / occupancy_radius;
        if weight < LEAST_WEIGHT { 0.0 } else { weight.min(1.0) }
    }

    /// Takes in more of the stroke.
    pub(crate) fn follow(&mut self, sample: BrushSample, occupancy_radius: f32) {
        let weight = Self::weight(sample.radius, occupancy_radius);
        let apart =
            self.path.back().is_none_or(|last| last.position.distance(sample.position) > LEAST_SPACING);
        if weight > 0.0 && apart {
            if self.path.len() == MAX_WAYPOINTS {
                self.path.pop_front();
            }
            self.path.push_back(Waypoint { position: sample.position, weight });
        }
    }

    /// Chooses the leader once the stroke's direction is known: a near bud that may lead and points along it.
    pub(crate) fn choose_leader(&mut self, space: &Space, reach: f32, may_lead: impl Fn(AxisId) -> bool) {
        let (Some(first), Some(last)) = (self.path.front(), self.path.back()) else { return };
        if self.leader.is_some() || first.position.distance(last.position) < ASSURED_LENGTH {
            return;
        }
        let towards = (last.position - first.position).normalize();
        let mut best: Option<(f32, AxisId)> = None;
        space.visit_buds(first.position, reach, |axis, bud, distance_squared| {
            let turn = 1.0 - bud.direction.dot(towards);
            let cost = distance_squared.sqrt() + 0.75 * turn;
            if may_lead(axis) && best.is_none_or(|(c, a)| (cost, axis) < (c, a)) {
                best = Some((cost, axis));
            }
        });
        self.leader = best.map(|(_, axis)| axis);
        if self.leader.is_none() {
            // Nothing is near: the stroke leads from where it first passes a bud.
            self.restart();
        }
    }

    /// Gives up the leader and all of the path but its end.
    pub(crate) fn restart(&mut self) {
        self.leader = None;
        let behind = self.path.len().saturating_sub(1);
        self.path.drain(..behind);
    }

    /// The next node of a leader whose tip is at `tip`: the point one internode away on the path ahead, or on
    /// the way to it. None once the path is followed. Points passed are forgotten, and those that no wood can
    /// reach while there are others beyond.
    pub(crate) fn next_node(&mut self, tip: Vec3, is_blocked: impl Fn(Vec3) -> bool) -> Option<Waypoint> {
        // The path leaves the unit sphere around the tip for good behind the last point inside.
        while self.path.len() >= 2 && self.path[1].position.distance(tip) < 1.0 {
            self.path.pop_front();
        }
        while self.path.len() >= 2 && is_blocked(self.path[0].position) {
            self.path.pop_front();
        }
        let front = *self.path.front()?;
        if front.position.distance(tip) >= 1.0 {
            return Some(front);
        }
        match self.path.get(1) {
            Some(&beyond) => {
                // What lies before the next node is followed; the path now begins there.
                let ahead = leave_sphere(front, beyond, tip);
                self.path[0] = ahead;
                Some(ahead)
            }
            None if front.position.distance(tip) >= ARRIVED => Some(front),
            None => None,
        }
    }
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
        let mut guide = Guide::default();
        for &position in points {
            guide.follow(BrushSample { position, radius: 0.0 }, 2.0);
        }
        guide
    }

    /// Nodes of a leader that starts at `tip` and obeys fully.
    fn nodes(mut guide: Guide, mut tip: Vec3) -> Vec<Vec3> {
        let mut nodes = Vec::new();
        while let Some(target) = guide.next_node(tip, |_| false) {
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
            [1.0, 1.0, 0.75, 0.5, 0.0, 0.0]
        );
    }
}
