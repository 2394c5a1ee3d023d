//! Obstacles: solids and sheets that wood does not grow through and light does not pass.
//!
//! A box, a sphere, the half-space behind a plane and a closed mesh are solid; an open mesh is a sheet. Wood
//! that stood there before an obstacle came stays, but does not grow on from inside a solid.

mod body;
mod checks;
mod detour;
mod mesh;
mod shape;
mod sky;
mod triangle;
mod triangle_grid;
mod way_around;

use glam::Vec3;

use body::Body;
pub use checks::ObstacleError;
pub use mesh::{MAX_TRIANGLES, TriangleMesh};
pub use shape::{Obstacle, Shape};
use sky::SkyMap;
pub(crate) use way_around::CLEARANCE;

/// All obstacles of a scene, ready to be asked.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    obstacles: Vec<Obstacle>,
    bodies: Vec<Body>,
    /// The box that holds each body.
    bounds: Vec<(Vec3, Vec3)>,
    sky: SkyMap,
}

/// Where a surface is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Contact {
    /// A point of the surface.
    pub point: Vec3,
    /// Its unit normal, to the side that is come from.
    pub normal: Vec3,
}

impl Obstacles {
    /// Makes obstacles ready.
    pub fn new(obstacles: Vec<Obstacle>) -> Self {
        let bodies: Vec<Body> = obstacles.iter().map(|obstacle| Body::new(obstacle.shape())).collect();
        let bounds = bodies.iter().map(Body::bounds).collect();
        Self { obstacles, bodies, bounds, sky: SkyMap::default() }
    }

    /// The obstacles.
    pub fn as_slice(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// Whether there are none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Whether a place lies in a solid.
    pub fn contains(&self, place: Vec3) -> bool {
        self.between(place, place).any(|body| body.contains(place))
    }

    /// Whether one of them, by its number from 0, is a solid that holds a place.
    pub fn holds(&self, number: usize, place: Vec3) -> bool {
        self.bodies.get(number).is_some_and(|body| body.contains(place))
    }

    /// Whether an obstacle stands between two places, or either lies in a solid.
    #[inline]
    pub fn hides(&self, from: Vec3, to: Vec3) -> bool {
        self.between(from, to).any(|body| body.hit(from, to).is_some())
    }

    /// Whether a straight piece of wood would meet an obstacle, or end nearer to one than `clearance`.
    pub fn blocks(&self, from: Vec3, to: Vec3, clearance: f32) -> bool {
        self.contact(from, to, clearance).is_some()
    }

    /// The surface that [`Obstacles::blocks`] such a piece of wood first.
    pub(crate) fn contact(&self, from: Vec3, to: Vec3, clearance: f32) -> Option<Contact> {
        let mut first: Option<(f32, Contact)> = None;
        for body in self.between(from, to) {
            if let Some((t, contact)) = body.hit(from, to)
                && first.is_none_or(|(least, _)| t < least)
            {
                first = Some((t, contact));
            }
        }
        if first.is_none() {
            let mut around = self.between(to - clearance, to + clearance);
            first = around.find_map(|body| Some((1.0, body.near(to, clearance)?)));
        }
        first.map(|(_, contact)| contact)
    }

    /// The bodies that the way from one place to another may meet, by their bounds.
    #[inline]
    fn between(&self, from: Vec3, to: Vec3) -> impl Iterator<Item = &Body> {
        let (least, most) = (from.min(to), from.max(to));
        let reaches = move |(low, high): &(Vec3, Vec3)| {
            // By coordinates: whole vectors would be compared to the end.
            least.x <= high.x
                && most.x >= low.x
                && least.z <= high.z
                && most.z >= low.z
                && least.y <= high.y
                && most.y >= low.y
        };
        self.bodies.iter().zip(&self.bounds).filter(move |(_, bounds)| reaches(bounds)).map(|(body, _)| body)
    }

    /// The share of the sky that is seen from a place, 0 to 1, each part weighted by the light it sheds on the
    /// ground; smoothed over a few internodes.
    pub fn sky_share(&self, place: Vec3) -> f32 {
        if self.is_empty() { 1.0 } else { self.sky.share(place, &self.bodies) }
    }

    /// Makes [`Obstacles::sky_share`] quick around a place.
    pub(crate) fn survey_sky(&mut self, place: Vec3) {
        if !self.is_empty() {
            self.sky.survey(place, &self.bodies);
        }
    }
}

#[cfg(test)]
mod tests;
