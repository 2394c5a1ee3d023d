//! Rigid motions of wood.

use glam::{Quat, Vec3};

/// A turn about a place, and where that place goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Unit quaternion.
    pub rotation: Quat,
    /// The place it turns about, in internodes.
    pub from: Vec3,
    /// Where that place goes.
    pub to: Vec3,
}

impl Motion {
    /// Where a place goes.
    pub fn apply(&self, place: Vec3) -> Vec3 {
        self.rotation * (place - self.from) + self.to
    }

    /// Where a unit vector points then.
    pub fn turn(&self, direction: Vec3) -> Vec3 {
        (self.rotation * direction).normalize()
    }

    /// Whether nothing moves.
    pub fn is_rest(&self) -> bool {
        self.rotation == Quat::IDENTITY && self.from == self.to
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pivot_goes_where_it_is_told() {
        let rotation = Quat::from_xyzw(0.0, 0.6, 0.0, 0.8);
        let motion = Motion { rotation, from: Vec3::X, to: Vec3::new(2.0, 3.0, 4.0) };
        assert_eq!(motion.apply(Vec3::X), motion.to);
        assert!((motion.apply(Vec3::Y + Vec3::X) - motion.to - Vec3::Y).length() < 1e-6);
        assert!(!motion.is_rest());
        assert!(Motion { rotation: Quat::IDENTITY, from: Vec3::X, to: Vec3::X }.is_rest());
    }
}
