//! What a grammar may ask about the place where a module stands.

use glam::DVec3;

/// Where a module of the word stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Its place, in internodes from where the turtle begins.
    pub place: DVec3,
    /// Unit vector along the turtle's heading.
    pub heading: DVec3,
    /// Branches that it lies in.
    pub order: u16,
    /// Internodes below it.
    pub below: u32,
    /// The key of the branch that it belongs to; 0 for the trunk.
    pub branch: u64,
}

/// Answers about surroundings. Equal questions in one step have equal answers.
pub trait Environment {
    /// How much of full light comes to a place, 0 to 1.
    fn light(&self, stand: &Stand) -> f64;

    /// Unit vector to where more light comes from; none of any length where all is alike.
    fn brighter(&self, stand: &Stand) -> DVec3;

    /// Whether no wood of another branch lies within a radius, in internodes.
    fn is_free(&self, stand: &Stand, radius: f64) -> bool;

    /// Whether a body holds the place: 0 is the envelope that was drawn, others are obstacles. Where no envelope was
    /// drawn all space is its own.
    fn is_inside(&self, stand: &Stand, body: u32) -> bool;

    /// Whether there is such a body.
    fn has_body(&self, body: u32) -> bool;

    /// The vigor of the wood nearest to a place, as a share of the greatest, 0 to 1.
    fn vigor(&self, stand: &Stand) -> f64;
}

/// Nothing stands around, and the sky is open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OpenSky;

impl Environment for OpenSky {
    fn light(&self, _: &Stand) -> f64 {
        1.0
    }

    fn brighter(&self, _: &Stand) -> DVec3 {
        DVec3::ZERO
    }

    fn is_free(&self, _: &Stand, _: f64) -> bool {
        true
    }

    fn is_inside(&self, _: &Stand, body: u32) -> bool {
        body == 0
    }

    fn has_body(&self, _: u32) -> bool {
        false
    }

    fn vigor(&self, _: &Stand) -> f64 {
        1.0
    }
}
