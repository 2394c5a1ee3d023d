//! Which way limbs go from their bearers, and what draws them.

use glam::Vec3;

use super::course::fitted;
use crate::{axis::Node, function::Function, key::Key};

/// What draws limbs must take away so much of the scatter of their angles, leaving this share.
const DRAWN: f32 = 0.7;
/// Fewer limbs say nothing of what draws them, and more than that many nothing new.
const LEAST_DRAWN: usize = 6;
const MOST_DRAWN: usize = 256;
/// Degrees by which a limb counts as off that cannot have been drawn so.
const LOST: f32 = 60.0;

/// Which way a limb goes from a node of its bearer.
pub(super) struct Going {
    pub limb: usize,
    pub t: f32,
    pub node: Node,
    pub direction: Vec3,
    /// Degrees around its bearer from the side that looked up.
    pub azimuth: f32,
    /// Degrees to its bearer.
    pub angle: f32,
}

impl Going {
    pub(super) fn of(limb: usize, t: f32, node: Node, chord: Vec3) -> Self {
        let direction = chord.normalize_or(node.side);
        let mut going = Self { limb, t, node, direction, azimuth: 0.0, angle: 0.0 };
        going.draw(Vec3::ZERO);
        going
    }

    /// Where it would go if nothing drew it there; none where what draws is so strong that it cannot be what did.
    fn free(&self, pull: Vec3) -> Option<Vec3> {
        let along = self.direction.dot(pull);
        let square = along * along - pull.length_squared() + 1.0;
        let share = along + square.max(0.0).sqrt();
        (square >= 0.0 && share > 0.0).then(|| self.direction * share - pull)
    }

    /// Finds the angles at which it goes there although something draws it.
    pub(super) fn draw(&mut self, pull: Vec3) {
        let free = self.free(pull).unwrap_or(self.direction);
        let Node { heading, side, .. } = self.node;
        self.azimuth = libm::atan2f(free.dot(side.cross(heading)), free.dot(side)).to_degrees();
        self.angle = angle_between(free, heading);
    }

    /// Where it would go at another angle.
    pub(super) fn unturned(&self, angle: f32, pull: Vec3) -> Vec3 {
        let (sin, cos) = libm::sincosf(angle.to_radians());
        let (sin_around, cos_around) = libm::sincosf(self.azimuth.to_radians());
        let Node { heading, side, .. } = self.node;
        let free = heading * cos + (side * cos_around + side.cross(heading) * sin_around) * sin;
        (free + pull).normalize_or(free)
    }
}

/// At which angle a limb leaves its bearer, and how much stands on it.
pub(super) struct Angle {
    pub t: f32,
    pub degrees: f32,
    /// Nodes by the length of the limb.
    pub force: f32,
    pub length: f32,
}

impl Angle {
    /// Its place and itself, with the weight of its square.
    pub(super) fn weighed(&self) -> (f32, f32, f32) {
        (self.t, self.degrees, self.force * self.length)
    }

    /// How much wood stands elsewhere, times how far, at the angle that is usual.
    pub(super) fn off(&self, usual: &Function) -> f32 {
        self.force * (self.degrees - usual.at(self.t)).abs().to_radians()
    }
}

fn angle_between(a: Vec3, b: Vec3) -> f32 {
    libm::atan2f(a.cross(b).length(), a.dot(b)).to_degrees()
}

/// Mean square of what angles to bearers are off those of their places, in degrees, where something draws limbs.
fn scatter(all: &[(&Going, f32)], pull: Vec3) -> f32 {
    let angle = |going: &Going| {
        let free = going.free(pull)?;
        // What is drawn turns by less, or by more, than its angle does.
        Some((angle_between(free, going.node.heading), (free + pull).length().max(0.1)))
    };
    let found: Vec<Option<(f32, f32)>> = all.iter().map(|(going, _)| angle(going)).collect();
    let samples = all.iter().zip(&found).filter_map(|((going, _), angle)| Some((going.t, (*angle)?.0)));
    let Some(usual) = fitted(samples, Key::BranchingAngle.row().range) else { return f32::INFINITY };
    let (mut sum, mut weights) = (0.0, 0.0);
    for ((going, weight), angle) in all.iter().zip(&found) {
        let off = angle.map_or(LOST, |(angle, share)| (angle - usual.at(going.t)) / share);
        sum += weight * off * off;
        weights += weight;
    }
    sum / weights.max(1e-3)
}

/// What draws limbs, if with it they leave their bearers at more even angles.
pub(super) fn pull(all: &[(&Going, f32)]) -> Vec3 {
    let sample: Vec<_> = all.iter().copied().step_by(all.len().div_ceil(MOST_DRAWN).max(1)).collect();
    let without = scatter(&sample, Vec3::ZERO);
    if sample.len() < LEAST_DRAWN {
        return Vec3::ZERO;
    }
    let (mut best, mut least, mut step) = (Vec3::ZERO, without, 1.0);
    while step > 0.05 {
        let ways = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
        let tried = ways.map(|way| (best + way * step).clamp(Vec3::splat(-8.0), Vec3::splat(8.0)));
        let found = tried.map(|pull| (pull, scatter(&sample, pull)));
        match found.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((pull, scatter)) if scatter < least => (best, least) = (pull, scatter),
            _ => step *= 0.5,
        }
    }
    if least < DRAWN * without { best } else { Vec3::ZERO }
}
