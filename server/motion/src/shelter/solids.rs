//! What stands in the wind besides plants.

use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use super::triangles::{Ray, Triangles};

/// What an obstacle is around its own origin, in a unit of its own.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A box, by half its sides.
    Box(DVec3),
    /// A ball, by its radius.
    Ball(f64),
    /// Triangles.
    Mesh(Arc<Triangles>),
}

/// An obstacle in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    form: Form,
    /// Metres of its unit.
    unit: f64,
    /// From the axes of the world to its own.
    back: DMat3,
    /// Where its origin is, in its unit.
    place: DVec3,
    /// The middle of its box, in its unit and the world's axes, seen from its origin; and how far it reaches from there.
    middle: DVec3,
    reach: f64,
    /// How high it is, in its unit: what of it is above the ground.
    height: f64,
    /// Flat triangles below this are land, seen from its origin, in its unit.
    land: f64,
}

/// Flat triangles in the lowest part of an obstacle are the land that it stands on.
const LAND: f64 = 0.1;

impl Solid {
    /// None where it has nothing that is above the ground, or is not finite. `unit` has so many metres; the place is in it.
    pub fn new(form: Form, place: DVec3, turn: DQuat, unit: f64) -> Option<Self> {
        let turn = turned(turn)?;
        let back = turn.transpose();
        let spans = |half: DVec3| {
            let up = back.y_axis;
            (up.x * half.x).abs() + (up.y * half.y).abs() + (up.z * half.z).abs()
        };
        let (middle, reach, lowest, highest) = match &form {
            Form::Box(half) => (DVec3::ZERO, half.length(), -spans(*half), spans(*half)),
            Form::Ball(radius) => (DVec3::ZERO, *radius, -radius, *radius),
            Form::Mesh(triangles) if triangles.is_empty() => return None,
            Form::Mesh(triangles) => {
                let [low, high] = triangles.bounds();
                let heights = triangles.corners().map(|corner| back.y_axis.dot(corner));
                let (lowest, highest) = heights
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), height| {
                        (least.min(height), most.max(height))
                    });
                let middle = 0.5 * (low + high);
                (turn * middle, (high - middle).length(), lowest, highest)
            }
        };
        let foot = (place.y + lowest).max(0.0);
        let height = place.y + highest - foot;
        let land = foot + LAND * height - place.y;
        let numbers = [unit, reach, height, place.length_squared(), middle.length_squared()];
        let is_there = numbers.iter().all(|number| number.is_finite()) && height > 0.0 && unit > 0.0;
        is_there.then_some(Self { form, unit, back, place, middle, reach, height, land })
    }

    /// How high it is, m.
    pub fn height(&self) -> f64 {
        self.height * self.unit
    }

    /// How far it reaches from its middle, and the way there from a place, m.
    pub(super) fn seen_from(&self, place: DVec3) -> (f64, DVec3) {
        (self.reach * self.unit, (self.place + self.middle) * self.unit - place)
    }

    /// How far away it is, in metres, from a place in a direction; none where it is farther than `reach`.
    pub(super) fn first(&self, place: DVec3, way: DVec3, reach: f64) -> Option<f64> {
        let Self { back, unit, .. } = self;
        let from = *back * (place / *unit - self.place);
        let way = *back * way;
        let reach = reach / unit;
        let away = match &self.form {
            Form::Box(half) => side_of_box(*half, from, way)?,
            Form::Ball(radius) => side_of_ball(*radius, from, way)?,
            Form::Mesh(triangles) => {
                let ray = Ray { from, way, reach, up: back.y_axis, land: self.land };
                triangles.first(&ray)?
            }
        };
        (away < reach).then_some(away * unit)
    }
}

/// The matrix of a turn; none where it is none. Written out so that clients find the same bits.
fn turned(turn: DQuat) -> Option<DMat3> {
    let size = (turn.x * turn.x + turn.y * turn.y + turn.z * turn.z + turn.w * turn.w).sqrt();
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    let [x, y, z, w] = [turn.x / size, turn.y / size, turn.z / size, turn.w / size];
    Some(DMat3::from_cols(
        DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
        DVec3::new(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
        DVec3::new(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
    ))
}

/// Where a ray comes into a box, or leaves it from inside.
fn side_of_box(half: DVec3, from: DVec3, way: DVec3) -> Option<f64> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if way[axis] == 0.0 {
            if from[axis].abs() > half[axis] {
                return None;
            }
            continue;
        }
        let side = if way[axis] < 0.0 { -half[axis] } else { half[axis] };
        enters = enters.max((-side - from[axis]) / way[axis]);
        leaves = leaves.min((side - from[axis]) / way[axis]);
    }
    beyond(enters, leaves)
}

/// The same of a ball.
fn side_of_ball(radius: f64, from: DVec3, way: DVec3) -> Option<f64> {
    let towards = -from.dot(way);
    let squared = radius * radius - (from.dot(from) - towards * towards);
    if squared < 0.0 {
        return None;
    }
    let half = squared.sqrt();
    beyond(towards - half, towards + half)
}

fn beyond(enters: f64, leaves: f64) -> Option<f64> {
    let away = if enters > 0.0 { enters } else { leaves };
    (enters <= leaves && away > 0.0).then_some(away)
}
