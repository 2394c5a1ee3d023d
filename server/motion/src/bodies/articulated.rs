//! A body with all that it bears, as the joint below feels it (Featherstone's articulated-body inertia).
//!
//! Moments and forces at the joint follow from its angular acceleration α and linear acceleration a:
//! n = A α + B a + p_n and f = Bᵀ α + C a + p_f. Everything is in the axes of the world.

use glam::{DMat3, DVec3};

/// What a joint does to the body above it: a moment, less what an acceleration takes of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    /// τ₀, Nm.
    pub moment: DVec3,
    /// S, kg m².
    pub resistance: DMat3,
}

impl Joint {
    /// The same in the axes of the world.
    pub fn turned(self, turn: glam::DQuat) -> Self {
        let frame = DMat3::from_quat(turn);
        Self { moment: frame * self.moment, resistance: frame * self.resistance * frame.transpose() }
    }
}

/// A body with all that it bears.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Articulated {
    angular: DMat3,
    coupling: DMat3,
    linear: DMat3,
    moment: DVec3,
    force: DVec3,
    freed: Freed,
}

/// What the forward pass needs of a joint that has been released.
#[derive(Clone, Copy, Debug, Default)]
struct Freed {
    /// (A + S)⁻¹.
    give: DMat3,
    /// τ₀ − p_n.
    drive: DVec3,
    /// From the joint below to this one.
    arm: DVec3,
    /// What the joint's own motion adds to the accelerations that come from below.
    angular: DVec3,
    linear: DVec3,
    /// Its accelerations, once they are known.
    acceleration: (DVec3, DVec3),
}

/// Turns v into u × v.
fn cross(u: DVec3) -> DMat3 {
    DMat3::from_cols(DVec3::new(0.0, u.z, -u.y), DVec3::new(-u.z, 0.0, u.x), DVec3::new(u.y, -u.x, 0.0))
}

impl Articulated {
    /// A body by itself that turns with `spin`: its inertia about the joint, and its centre seen from there.
    pub fn body(inertia: DMat3, mass: f64, centre: DVec3, spin: DVec3) -> Self {
        Self {
            angular: inertia,
            coupling: cross(centre) * mass,
            linear: DMat3::IDENTITY * mass,
            moment: spin.cross(inertia * spin),
            force: mass * spin.cross(spin.cross(centre)),
            freed: Freed::default(),
        }
    }

    /// A force from outside that acts so far from the joint.
    pub fn push(&mut self, force: DVec3, at: DVec3) {
        self.moment -= at.cross(force);
        self.force -= force;
    }

    /// Takes on what a joint above passes on.
    pub fn add(&mut self, other: &Self) {
        self.angular += other.angular;
        self.coupling += other.coupling;
        self.linear += other.linear;
        self.moment += other.moment;
        self.force += other.force;
    }

    /// Lets the joint give way; returns what the body below feels, at its own joint, `arm` away. That body turns with
    /// `spin`, and this one against it with `rate`.
    pub fn release(&mut self, joint: Joint, arm: DVec3, spin: DVec3, rate: DVec3) -> Self {
        let give = (self.angular + joint.resistance).inverse();
        let drive = joint.moment - self.moment;
        let (of_spin, of_arm) = (spin.cross(rate), spin.cross(spin.cross(arm)));
        self.freed = Freed { give, drive, arm, angular: of_spin, linear: of_arm, ..Freed::default() };
        let angular = self.angular - self.angular * give * self.angular;
        let coupling = self.coupling - self.angular * give * self.coupling;
        let linear = self.linear - self.coupling.transpose() * give * self.coupling;
        let moment = self.moment + self.angular * (give * drive) + angular * of_spin + coupling * of_arm;
        let force = self.force
            + self.coupling.transpose() * (give * drive + of_spin - give * (self.angular * of_spin))
            + linear * of_arm;
        let lever = cross(arm);
        let shifted = lever * linear;
        let turned = coupling * lever;
        Self {
            angular: angular - turned - turned.transpose() - shifted * lever,
            coupling: coupling + shifted,
            linear,
            moment: moment + arm.cross(force),
            force,
            freed: Freed::default(),
        }
    }

    /// Its accelerations from those of the body below at its joint; returns how its turning against that body speeds up.
    pub fn accelerate(&mut self, angular: DVec3, linear: DVec3) -> DVec3 {
        let Freed { give, drive, arm, .. } = self.freed;
        let linear = linear + angular.cross(arm) + self.freed.linear;
        let angular = angular + self.freed.angular;
        let gain = give * (drive - self.coupling * linear - self.angular * angular);
        self.freed.acceleration = (angular + gain, linear);
        gain
    }

    /// Its angular acceleration, and the linear one of its joint.
    pub fn acceleration(&self) -> (DVec3, DVec3) {
        self.freed.acceleration
    }
}
