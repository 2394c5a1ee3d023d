//! The brush: markers sown in a sphere that moves with the finger (TreeSketch §3.2, "Brushing and sketching").

use glam::Vec3;

use crate::{
    markers::{Marker, MarkerSource, Markers},
    parameters::Parameters,
    random::{Draw, Purpose},
};

/// Names a stroke while it lasts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct StrokeId(pub u32);

impl StrokeId {
    /// The stroke of a programme with this number, from 0. Those by hand are counted upwards from 1, these downwards
    /// from the end.
    pub fn of_programme(number: u32) -> Self {
        Self(u32::MAX - number)
    }

    /// Whether it is one of a programme.
    pub fn is_of_programme(self) -> bool {
        self.0 > u32::MAX / 2
    }
}

/// One place of the brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrushSample {
    /// Centre.
    pub position: Vec3,
    /// Radius; towards 0 the brush turns into a pencil.
    pub radius: f32,
}

/// What a brush does within one step: the path from its first sample to its last.
#[derive(Clone, Debug, PartialEq)]
pub struct BrushPiece {
    /// Which stroke this belongs to.
    pub stroke: StrokeId,
    /// At least one place.
    pub samples: Vec<BrushSample>,
}

/// The most markers one piece sows: a brush wide enough to exceed it sows more thinly, step after step.
const MAX_MARKERS: f32 = 4096.0;

impl BrushPiece {
    /// Length of the path.
    pub(crate) fn length(&self) -> f32 {
        self.samples.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum()
    }

    /// Unit direction from the first place to the last, if they differ.
    pub(crate) fn direction(&self) -> Option<Vec3> {
        let (first, last) = (self.samples.first()?, self.samples.last()?);
        (last.position - first.position).try_normalize()
    }

    /// The place at `distance` along the path.
    fn at(&self, distance: f32) -> BrushSample {
        let mut left = distance;
        for pair in self.samples.windows(2) {
            let length = pair[0].position.distance(pair[1].position);
            if left < length {
                let t = left / length;
                return BrushSample {
                    position: pair[0].position.lerp(pair[1].position, t),
                    radius: pair[0].radius + (pair[1].radius - pair[0].radius) * t,
                };
            }
            left -= length;
        }
        self.samples[self.samples.len() - 1]
    }

    /// Sows markers evenly in the volume the brush sweeps, above ground.
    pub(crate) fn sow(&self, markers: &mut Markers, seed: u32, tick: u32, parameters: &Parameters) {
        let radius = self.samples.iter().map(|s| s.radius).sum::<f32>() / self.samples.len() as f32;
        let length = self.length();
        let disc = core::f32::consts::PI * radius * radius;
        let expected = (parameters.marker_density * disc * (4.0 / 3.0 * radius + length)).min(MAX_MARKERS);
        let draw = Draw::new(seed, Purpose::Brush, self.stroke.0, tick);
        // One marker where the brush is: however few a narrow brush sows, there is always one to follow.
        let mut sow = |position: Vec3| {
            if position.y > 0.0 {
                markers.sow(Marker { position, born: tick, source: MarkerSource::Brush(self.stroke) });
            }
        };
        if radius > 0.0 {
            sow(self.at(length).position);
        }
        let count = (expected + draw.unit(0)) as u32;
        for marker in 0..count {
            let unit = |i| draw.unit(1 + 4 * marker + i);
            let centre = self.at(length * unit(0));
            let offset = sphere_point(unit(1), unit(2)) * (centre.radius * libm::cbrtf(unit(3)));
            sow(centre.position + offset);
        }
    }
}

/// A point on the unit sphere from two uniform numbers.
fn sphere_point(u: f32, v: f32) -> Vec3 {
    let y = 2.0 * u - 1.0;
    let (sin, cos) = libm::sincosf(core::f32::consts::TAU * v);
    let across = (1.0 - y * y).max(0.0).sqrt();
    Vec3::new(across * cos, y, across * sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(samples: &[(Vec3, f32)]) -> BrushPiece {
        let samples = samples.iter().map(|&(position, radius)| BrushSample { position, radius }).collect();
        BrushPiece { stroke: StrokeId(1), samples }
    }

    fn sown(piece: &BrushPiece) -> Vec<Vec3> {
        let mut markers = Markers::default();
        piece.sow(&mut markers, 7, 3, &Parameters::default());
        markers.as_slice().iter().map(|m| m.position).collect()
    }

    #[test]
    fn markers_stay_in_the_swept_volume() {
        let (a, b) = (Vec3::new(0.0, 20.0, 0.0), Vec3::new(10.0, 20.0, 0.0));
        let markers = sown(&piece(&[(a, 3.0), (b, 3.0)]));
        assert!(markers.len() > 30);
        for p in markers {
            let nearest = a + (b - a) * ((p - a).dot(b - a) / 100.0).clamp(0.0, 1.0);
            assert!(p.distance(nearest) <= 3.001);
        }
    }

    #[test]
    fn markers_fill_the_sphere_evenly() {
        let centre = Vec3::Y * 30.0;
        let markers = sown(&piece(&[(centre, 20.0)]));
        let inner = markers.iter().filter(|p| p.distance(centre) < 10.0).count();
        // Half the radius holds an eighth of the volume.
        let share = inner as f32 / markers.len() as f32;
        assert!((share - 0.125).abs() < 0.03, "{share}");
    }

    #[test]
    fn a_pencil_sows_nothing() {
        assert!(sown(&piece(&[(Vec3::Y, 0.0), (Vec3::Y * 9.0, 0.0)])).is_empty());
    }
}
