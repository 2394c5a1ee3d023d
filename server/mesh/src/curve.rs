//! A smooth curve through the nodes of an axis: centripetal Catmull-Rom, which neither overshoots nor loops
//! where internodes differ in length.

use glam::Vec3;

use crate::course::Course;

/// Rings stand close enough that the curve turns by no more than this many radians between two,
const MOST_TURN: f32 = 0.3;
/// unless the way between two nodes has been halved this often.
const MOST_HALVINGS: u32 = 4;
/// Where rings stand on a flare, in lengths of its falloff.
const FLARE_RINGS: [f32; 4] = [0.0, 0.5, 1.0, 2.0];
/// A flare of less, in internodes, needs no rings of its own: most of a tree is twigs.
const LEAST_FLARE: f32 = 0.02;
/// Rings closer than this share of an internode merge.
const LEAST_GAP: f32 = 0.04;

/// Rings are apart by this share of the smaller one's radius where they are nearest.
const LEAST_CLEARANCE: f32 = 0.02;
/// Cosine of the most that a ring's axis leans away from the way to the next ring.
const LEAST_UPRIGHT: f32 = 0.3;

/// At most so many rings in a row are left out.
const MOST_SPARED: usize = 12;

/// One place on the curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    pub point: Vec3,
    /// Unit vector along the curve.
    pub tangent: Vec3,
    /// Length from the beginning.
    pub arc: f32,
    pub radius: f32,
}

/// Places for rings, at least two, on a curve that `smoothing` takes from a polyline (0) to a smooth one (1). No ring
/// reaches through another, so that the skin between two never folds; rings that lie within `tolerance` of the tube
/// between others are left out.
pub(crate) fn samples(course: &Course, smoothing: f32, tolerance: f32) -> Vec<Sample> {
    let all = on_curve(course, smoothing);
    if tolerance > 0.0 { apart(&needed(&all, tolerance)) } else { apart(&all) }
}

/// The places without which the tube would be off by more than `tolerance`, the first and the last among them.
fn needed(samples: &[Sample], tolerance: f32) -> Vec<Sample> {
    let mut kept: Vec<Sample> = samples.first().copied().into_iter().collect();
    let mut from = 0;
    for to in 1..samples.len() {
        let is_last = to + 1 == samples.len();
        let is_far = to - from >= MOST_SPARED || {
            let ends = [&samples[from], &samples[(to + 1).min(samples.len() - 1)]];
            samples[from + 1..=to].iter().any(|sample| sample.off(ends) > tolerance)
        };
        if is_last || is_far {
            kept.push(samples[to]);
            from = to;
        }
    }
    kept
}

/// As many of the places as can have rings that do not cross; the first and the last are always among them.
fn apart(samples: &[Sample]) -> Vec<Sample> {
    let mut kept: Vec<Sample> = Vec::with_capacity(samples.len());
    for (i, &sample) in samples.iter().enumerate() {
        if i + 1 == samples.len() {
            while kept.len() > 1 && kept.last().is_some_and(|below| below.crosses(&sample)) {
                kept.pop();
            }
        }
        let is_end = i == 0 || i + 1 == samples.len();
        if is_end || !kept.last().is_some_and(|below| below.crosses(&sample)) {
            kept.push(sample);
        }
    }
    if let [first, last] = &mut kept[..]
        && first.crosses(last)
    {
        // Parallel rings are apart however wide they are.
        let along = (last.point - first.point).normalize_or(first.tangent);
        (first.tangent, last.tangent) = (along, along);
    }
    kept
}

impl Sample {
    /// How far it lies off a straight tube between two others, in place or in radius.
    fn off(&self, [from, to]: [&Self; 2]) -> f32 {
        let share = (self.arc - from.arc) / (to.arc - from.arc).max(f32::MIN_POSITIVE);
        let radius = from.radius + (to.radius - from.radius) * share;
        self.point.distance(from.point.lerp(to.point, share)).max((self.radius - radius).abs())
    }

    /// Whether its ring and the next one's cross, or nearly do, or the skin between them would be sheared flat.
    fn crosses(&self, above: &Self) -> bool {
        let way = above.point - self.point;
        let tilt = self.tangent.cross(above.tangent).length();
        let least = (LEAST_CLEARANCE * self.radius.min(above.radius)).max(LEAST_UPRIGHT * way.length());
        way.dot(self.tangent) < above.radius * tilt + least
            || way.dot(above.tangent) < self.radius * tilt + least
    }
}

fn on_curve(course: &Course, smoothing: f32) -> Vec<Sample> {
    let nodes = &course.nodes;
    let last = nodes.len() - 1;
    let mut samples: Vec<Sample> = Vec::with_capacity(2 * nodes.len());
    for i in 0..last {
        let (from, to) = (nodes[i], nodes[i + 1]);
        let before = if i == 0 { course.before } else { nodes[i - 1] };
        let after = if i + 1 == last { 2.0 * to - from } else { nodes[i + 2] };
        let smooth = Piece::through(before, from, to, after);
        let piece = smooth.smoothed(smoothing);
        for u in parts(&piece, course, i) {
            let point = piece.point(u);
            let arc = samples.last().map_or(0.0, |s| s.arc + s.point.distance(point));
            let radius = course.radii[i] + (course.radii[i + 1] - course.radii[i]) * u + course.flare.at(arc);
            // At a node the ring lies between both ways, also where there is a corner.
            let tangent = if u < 1.0 && u > 0.0 { piece.tangent(u) } else { smooth.tangent(u) };
            samples.push(Sample { point, tangent, arc, radius });
        }
    }
    samples
}

/// Where between two nodes rings stand, 0 to 1; the first node only counts with the first piece.
fn parts(piece: &Piece, course: &Course, index: usize) -> Vec<f32> {
    let mut parts = Vec::new();
    piece.divide(0.0, 1.0, MOST_HALVINGS, &mut parts);
    if index > 0 {
        return parts;
    }
    parts.insert(0, 0.0);
    if course.flare.amount > LEAST_FLARE {
        let length = piece.chord.length();
        let wanted =
            FLARE_RINGS.map(|falloffs| (course.flare.hidden + falloffs * course.flare.falloff) / length);
        for part in wanted {
            let place = parts.partition_point(|&p| p < part);
            let is_free = |neighbour: Option<&f32>| neighbour.is_some_and(|n| (n - part).abs() >= LEAST_GAP);
            if place > 0 && is_free(parts.get(place - 1)) && is_free(parts.get(place)) {
                parts.insert(place, part);
            }
        }
    }
    parts
}

/// The curve between two nodes, in Hermite form.
struct Piece {
    from: Vec3,
    chord: Vec3,
    leaving: Vec3,
    arriving: Vec3,
}

impl Piece {
    fn through(before: Vec3, from: Vec3, to: Vec3, after: Vec3) -> Self {
        // Knots are the square roots of the distances; none is zero, for no internode has length zero.
        let knot = |a: Vec3, b: Vec3| a.distance(b).sqrt().max(1e-3);
        let (k0, k1, k2) = (knot(before, from), knot(from, to), knot(to, after));
        let chord = to - from;
        Self {
            from,
            chord,
            leaving: ((from - before) / k0 - (to - before) / (k0 + k1) + chord / k1) * k1,
            arriving: (chord / k1 - (after - from) / (k1 + k2) + (after - to) / k2) * k1,
        }
    }

    /// Between the straight way (0) and the whole curve (1).
    fn smoothed(&self, share: f32) -> Self {
        let [leaving, arriving] = [self.leaving, self.arriving].map(|way| self.chord.lerp(way, share));
        Self { from: self.from, chord: self.chord, leaving, arriving }
    }

    fn point(&self, u: f32) -> Vec3 {
        let (u2, u3) = (u * u, u * u * u);
        self.from
            + (u3 - 2.0 * u2 + u) * self.leaving
            + (3.0 * u2 - 2.0 * u3) * self.chord
            + (u3 - u2) * self.arriving
    }

    fn tangent(&self, u: f32) -> Vec3 {
        let u2 = u * u;
        let derivative = (3.0 * u2 - 4.0 * u + 1.0) * self.leaving
            + 6.0 * (u - u2) * self.chord
            + (3.0 * u2 - 2.0 * u) * self.arriving;
        derivative.try_normalize().unwrap_or_else(|| self.chord.normalize_or(Vec3::Y))
    }

    /// Adds places between `from` and `to`, the last of which is `to`.
    fn divide(&self, from: f32, to: f32, halvings: u32, parts: &mut Vec<f32>) {
        let middle = 0.5 * (from + to);
        // By way of the middle, for a curve like an S ends as it begins.
        let [a, b, c] = [from, middle, to].map(|u| self.tangent(u));
        if halvings == 0 || a.angle_between(b) + b.angle_between(c) <= MOST_TURN {
            parts.push(to);
        } else {
            self.divide(from, middle, halvings - 1, parts);
            self.divide(middle, to, halvings - 1, parts);
        }
    }
}

#[cfg(test)]
mod tests {
    use espalier_plant::{AxisId, MetamerId};

    use super::*;
    use crate::course::{End, Flare};

    fn course(nodes: &[Vec3]) -> Course {
        Course {
            seed: MetamerId::new(0),
            axis: AxisId::new(0),
            nodes: nodes.to_vec(),
            radii: vec![0.1; nodes.len()],
            before: 2.0 * nodes[0] - nodes[1],
            normal: Vec3::X,
            flare: Flare { amount: 0.0, hidden: 0.0, falloff: 1.0 },
            end: End::Grown,
        }
    }

    #[test]
    fn curve_goes_through_every_node() {
        let nodes = [Vec3::ZERO, Vec3::Y, Vec3::new(1.0, 1.5, 0.0), Vec3::new(1.2, 1.5, 2.0)];
        let samples = samples(&course(&nodes), 1.0, 0.0);
        for node in nodes {
            assert!(samples.iter().any(|s| s.point.distance(node) < 1e-5), "{node} is missed");
        }
        assert!(samples.is_sorted_by(|a, b| a.arc < b.arc));
    }

    #[test]
    fn straight_axis_needs_one_ring_a_node() {
        let samples = samples(&course(&[Vec3::ZERO, Vec3::Y, 3.0 * Vec3::Y, 3.5 * Vec3::Y]), 1.0, 0.0);
        assert_eq!(samples.len(), 4);
        assert!(samples.iter().all(|s| s.tangent.distance(Vec3::Y) < 1e-5));
        assert!((samples[3].arc - 3.5).abs() < 1e-5);
    }

    #[test]
    fn sharp_bend_gets_more_rings() {
        let samples = samples(&course(&[Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X]), 1.0, 0.0);
        assert!(samples.len() > 5);
        for pair in samples.windows(2) {
            assert!(pair[0].tangent.angle_between(pair[1].tangent) <= MOST_TURN);
        }
    }

    #[test]
    fn flare_declines_on_rings_of_its_own() {
        let mut course = course(&[Vec3::ZERO, Vec3::Y]);
        course.flare = Flare { amount: 0.1, hidden: 0.1, falloff: 0.1 };
        let radii: Vec<f32> = samples(&course, 1.0, 0.0).iter().map(|s| s.radius).collect();
        assert_eq!(radii.len(), 6);
        assert_eq!(radii[..2], [0.2, 0.2]);
        assert!(radii[1..].is_sorted_by(|a, b| a > b));
    }

    #[test]
    fn rings_of_a_sharp_bend_do_not_cross() {
        let mut course = course(&[Vec3::ZERO, Vec3::Y, Vec3::Y + 0.4 * Vec3::X, Vec3::X]);
        course.radii = vec![0.8, 0.8, 0.7, 0.6];
        assert!(on_curve(&course, 1.0).windows(2).any(|pair| pair[0].crosses(&pair[1])));
        let samples = samples(&course, 1.0, 0.0);
        assert!(samples.len() >= 2 && !samples.windows(2).any(|pair| pair[0].crosses(&pair[1])));
        assert_eq!(samples[samples.len() - 1].point, Vec3::X);
    }

    #[test]
    fn rings_are_left_out_where_nobody_would_see_it() {
        let straight = course(&[Vec3::ZERO, Vec3::Y, 2.0 * Vec3::Y, 3.0 * Vec3::Y]);
        assert_eq!(samples(&straight, 1.0, 0.01).len(), 2);
        let bent = course(&[Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X]);
        let [all, some] = [0.0, 0.05].map(|tolerance| samples(&bent, 1.0, tolerance));
        assert!(2 < some.len() && some.len() < all.len(), "{} of {}", some.len(), all.len());
        for sample in &all {
            let off = some.windows(2).map(|pair| sample.off([&pair[0], &pair[1]])).fold(f32::MAX, f32::min);
            assert!(off <= 0.05 + 1e-5, "{off}");
        }
    }

    #[test]
    fn a_polyline_has_no_more_rings_than_nodes() {
        let samples = samples(&course(&[Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X]), 0.0, 0.0);
        assert_eq!(
            samples.iter().map(|s| s.point).collect::<Vec<_>>(),
            [Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X]
        );
    }
}
