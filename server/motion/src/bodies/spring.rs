//! The spring between two bodies: stiff against bending, softer against twisting.

use glam::{DMat3, DQuat, DVec3};

use super::articulated::Joint;
use crate::wood::TWIST;

/// A spring between two bodies, in the frame of the lower one at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spring {
    /// Moment for a rotation vector φ: K, Nm.
    stiffness: DMat3,
}

impl Spring {
    /// Of a rod along a unit vector that resists bending with so many Nm for a radian.
    pub fn of(along: DVec3, bending: f64) -> Self {
        let lengthwise = DMat3::from_cols(along.x * along, along.y * along, along.z * along);
        Self { stiffness: (DMat3::IDENTITY - lengthwise * (1.0 - 1.0 / TWIST)) * bending }
    }

    /// ½ φ·Kφ.
    pub fn energy(&self, turn: DQuat) -> f64 {
        let turned = turn.to_scaled_axis();
        0.5 * turned.dot(self.stiffness * turned)
    }

    /// The moment it has `ahead` seconds from now, as a value and what an acceleration takes of it.
    pub fn ahead(&self, turn: DQuat, rate: DVec3, ahead: f64, damping: f64) -> Joint {
        let turned = turn.to_scaled_axis();
        let held = turned_back(turned, self.stiffness * turned);
        let gain = ahead + damping;
        Joint { moment: -held - self.stiffness * rate * gain, resistance: self.stiffness * (ahead * gain) }
    }
}

/// The gradient by angular velocity from that by rotation vector: the inverse of the transposed left Jacobian of the
/// exponential. Without it a spring that is stiffer one way than another would make energy when it turns far.
fn turned_back(turned: DVec3, gradient: DVec3) -> DVec3 {
    let squared = turned.length_squared();
    let factor = if squared < 1e-6 {
        1.0 / 12.0
    } else {
        let angle = squared.sqrt();
        let (sin, cos) = libm::sincos(angle);
        1.0 / squared - (1.0 + cos) / (2.0 * angle * sin)
    };
    gradient + 0.5 * turned.cross(gradient) + factor * turned.cross(turned.cross(gradient))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_the_gradient_of_the_energy() {
        let spring = Spring::of(DVec3::new(0.36, 0.8, 0.48), 30.0);
        for turned in [DVec3::new(0.3, -0.2, 0.9), DVec3::new(1e-5, 0.0, 0.0), DVec3::new(-1.0, 1.5, 0.4)] {
            let turn = DQuat::from_scaled_axis(turned);
            let moment = spring.ahead(turn, DVec3::ZERO, 0.0, 0.0).moment;
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let energy = |by: f64| spring.energy(DQuat::from_scaled_axis(by * axis) * turn);
                let slope = (energy(1e-5) - energy(-1e-5)) / 2e-5;
                assert!((slope + moment.dot(axis)).abs() < 1e-5, "{turned} by {axis}: {slope} for {moment}");
            }
        }
    }
}
