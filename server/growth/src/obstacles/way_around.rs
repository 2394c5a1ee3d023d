//! How a shoot that runs into an obstacle goes on: along its surface.

use glam::Vec3;

use super::{Contact, Obstacles};

/// Wood keeps this far from obstacles.
pub(crate) const CLEARANCE: f32 = 0.25;
/// Surfaces a shoot turns along before it gives up: in a corner there are three.
const TURNS: usize = 6;
/// A shoot meets a surface head-on if less than this of its heading goes along it.
const HEAD_ON: f32 = 0.1;
/// What a turned shoot keeps beyond the clearance, against rounding.
const MARGIN: f32 = 1.0e-3;

impl Obstacles {
    /// The unit heading for an internode from `base`: `heading` itself where nothing is in the way, else turned
    /// along the surfaces that are; none if there is no way. Met head-on, a shoot turns upwards, and under a
    /// ceiling in the horizontal direction `aside`.
    pub(crate) fn way_around(&self, base: Vec3, heading: Vec3, aside: impl Fn() -> Vec3) -> Option<Vec3> {
        if self.is_empty() {
            return Some(heading);
        }
        let mut turned = heading;
        for _ in 0..TURNS {
            match self.contact(base, base + turned, CLEARANCE) {
                None => return Some(turned),
                Some(contact) => turned = along_surface(base, turned, aside(), contact)?,
            }
        }
        None
    }
}

/// The heading nearest to `heading` that keeps an internode clear of the plane that touches a surface.
fn along_surface(base: Vec3, heading: Vec3, aside: Vec3, contact: Contact) -> Option<Vec3> {
    let Contact { point, normal } = contact;
    let gap = (base - point).dot(normal);
    let away = (CLEARANCE + MARGIN - gap).max(0.0);
    if away >= 1.0 {
        return None;
    }
    let across = |v: Vec3| v - normal * v.dot(normal);
    let tangent = [heading, Vec3::Y, aside, Vec3::X, Vec3::Z]
        .into_iter()
        .map(across)
        .find(|tangent| tangent.length_squared() > HEAD_ON * HEAD_ON)?;
    Some(tangent.normalize() * (1.0 - away * away).sqrt() + normal * away)
}
