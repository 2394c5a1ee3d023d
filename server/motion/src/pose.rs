//! Where everything stands when joints are turned.

use glam::{DQuat, DVec3};

use crate::{NONE, joints::Joints, rides::Ride, wood::Wood};

/// The furthest that a joint is turned back to keep what it bears above the ground, radians.
const LIFT: f64 = 0.5;

/// How one joint stands: a node that rides on it goes from x to `turn` (x + its ride's shift by `bend`) + `shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Its own rotation at its tip, radians.
    pub bend: DVec3,
    /// How the node it stands on has turned.
    pub turn: DQuat,
    /// Where the origin has gone with that node, m.
    pub shift: DVec3,
}

/// How a node stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Where it is, m.
    pub place: DVec3,
    /// How it has turned from rest.
    pub turn: DQuat,
}

/// All joints as they stand at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose(Vec<Stand>);

impl Pose {
    /// From the rotations of all joints. What was above the ground is held there as far as its own joint can.
    pub fn of(joints: &Joints, wood: &Wood, bends: &[DVec3]) -> Self {
        let mut stands: Vec<Stand> = Vec::with_capacity(bends.len());
        for (joint, &bend) in joints.all().iter().zip(bends) {
            let root = wood.place[joint.node as usize];
            let mut stand = Stand { bend, turn: DQuat::IDENTITY, shift: DVec3::ZERO };
            if let Some(parent) = joint.parent {
                let node = stands[parent as usize].node(root, &joints.rides()[joint.node as usize]);
                stand.turn = node.turn;
                stand.shift = node.place - node.turn * root;
            }
            if joint.parent.is_some() {
                let lowest = wood.place[joint.lowest as usize];
                stand.bend = stand.held_up(lowest, &joints.rides()[joint.lowest as usize]);
            }
            stands.push(stand);
        }
        Self(stands)
    }

    /// How a row's node stands. What its joint cannot hold up lies on the ground, or as deep as it was at rest.
    pub fn node(&self, joints: &Joints, wood: &Wood, row: u32) -> Node {
        let ride = &joints.rides()[row as usize];
        let place = wood.place[row as usize];
        match ride.joint {
            NONE => Node { place, turn: DQuat::IDENTITY },
            joint => {
                let mut node = self.0[joint as usize].node(place, ride);
                node.place.y = node.place.y.max(place.y.min(0.0));
                node
            }
        }
    }

    /// By joint.
    pub fn stands(&self) -> &[Stand] {
        &self.0
    }
}

impl Stand {
    fn node(&self, rest: DVec3, ride: &Ride) -> Node {
        Node {
            place: self.turn * (rest + ride.shift(self.bend)) + self.shift,
            turn: self.turn * DQuat::from_scaled_axis(ride.weight * self.bend),
        }
    }

    /// The bend with which a node stays above the ground, if it was there at rest.
    fn held_up(&self, rest: DVec3, ride: &Ride) -> DVec3 {
        let mut held = *self;
        for _ in 0..2 {
            let sunk = rest.y.min(0.0) - held.node(rest, ride).place.y;
            // How the node rises with the bend: ((b × f)·u = b·(f × u)).
            let rise = ride.first.cross(self.turn.inverse() * DVec3::Y);
            if sunk <= 0.0 || rise.length_squared() < 1e-12 {
                break;
            }
            held.bend += rise * (sunk / rise.length_squared());
        }
        self.bend + (held.bend - self.bend).clamp_length_max(LIFT)
    }
}
