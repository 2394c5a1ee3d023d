//! Where a brush has been: the volume that its sphere swept, in which the growth that it calls for stays.

use glam::Vec3;

use crate::brush::BrushSample;

/// Places nearer together than this share of the brush's radius say nothing new, nor do those this near.
const SPACING: (f32, f32) = (0.25, 0.25);
/// Places remembered: what lies farther back has long been grown into.
const MAX_PLACES: usize = 1024;

/// A chain of spheres and the cones between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sweep {
    places: Vec<BrushSample>,
}

impl Sweep {
    /// A sweep as it was written down once.
    pub fn from_places(places: Vec<BrushSample>) -> Self {
        Self { places }
    }

    /// Places of the brush from which it follows, in their order.
    pub fn places(&self) -> &[BrushSample] {
        &self.places
    }

    /// The brush has come to a place.
    pub(crate) fn add(&mut self, place: BrushSample) {
        if let [.., before, last] = &mut self.places[..] {
            let apart = before.position.distance(place.position).max((before.radius - place.radius).abs());
            if apart < SPACING.0.max(SPACING.1 * place.radius) {
                *last = place;
                return;
            }
        }
        if self.places.len() == MAX_PLACES {
            self.places.drain(..MAX_PLACES / 4);
        }
        self.places.push(place);
    }

    /// How far outside it a place lies; below 0 inside, infinite where nothing was swept.
    pub(crate) fn outside(&self, place: Vec3) -> f32 {
        self.least(place, |distance, radius| distance - radius)
    }

    /// How far from the brush's path a place lies, whatever its radius was.
    pub(crate) fn distance_to_path(&self, place: Vec3) -> f32 {
        self.least(place, |distance, _| distance)
    }

    /// The least value over the pieces of the path: of the distance from a place to its nearest point, and the radius
    /// there.
    fn least(&self, place: Vec3, value: impl Fn(f32, f32) -> f32) -> f32 {
        let along = |pair: &[BrushSample]| {
            let way = pair[1].position - pair[0].position;
            let length_squared = way.length_squared();
            let from = place - pair[0].position;
            let t = if length_squared > 0.0 { (from.dot(way) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
            value((from - way * t).length(), pair[0].radius + (pair[1].radius - pair[0].radius) * t)
        };
        match &self.places[..] {
            [only] => value(place.distance(only.position), only.radius),
            places => places.windows(2).map(along).fold(f32::INFINITY, f32::min),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(places: impl IntoIterator<Item = (Vec3, f32)>) -> Sweep {
        let mut sweep = Sweep::default();
        places.into_iter().for_each(|(position, radius)| sweep.add(BrushSample { position, radius }));
        sweep
    }

    #[test]
    fn outside_is_measured_from_the_swept_volume() {
        assert_eq!(sweep([]).outside(Vec3::ZERO), f32::INFINITY);
        assert_eq!(sweep([(Vec3::X, 2.0)]).outside(4.0 * Vec3::X), 1.0);
        let cone = sweep([(Vec3::ZERO, 2.0), (10.0 * Vec3::X, 4.0)]);
        assert_eq!(cone.outside(Vec3::new(5.0, 3.5, 0.0)), 0.5);
        assert_eq!(cone.outside(Vec3::new(13.0, 0.0, 0.0)), -1.0);
        assert_eq!(cone.distance_to_path(Vec3::new(5.0, 3.5, 0.0)), 3.5);
    }

    #[test]
    fn what_is_left_out_changes_little() {
        let path = |i: u16| Vec3::new(libm::sinf(0.01 * f32::from(i)), 0.02 * f32::from(i), 0.0) * 3.0;
        let sweep = sweep((0..1000).map(|i| (path(i), 3.0)));
        assert!(sweep.places().len() < 100, "{}", sweep.places().len());
        for i in 0..1000 {
            assert!((sweep.outside(path(i)) + 3.0).abs() < 0.1);
        }
    }

    #[test]
    fn a_long_stroke_is_remembered_from_its_end() {
        let long = sweep((0..3000u16).map(|i| (Vec3::X * f32::from(i), 1.0)));
        assert!(long.places().len() <= MAX_PLACES);
        assert_eq!(long.outside(2999.0 * Vec3::X), -1.0);
    }
}
