//! The curve of a limb from node to node, and where on it rings stand.

use espalier_plant::MetamerId;
use glam::Vec3;

use super::course::{Course, End, Flare, Node};

/// Rings stand close enough that the curve turns by no more than this many radians between two,
const MOST_TURN: f32 = 0.3;
/// unless the way between two nodes has been halved this often.
const MOST_HALVINGS: u32 = 4;
/// Where rings stand on a collar, in lengths of its falloff.
const COLLAR_RINGS: [f32; 4] = [0.0, 0.5, 1.0, 2.0];
/// Where they stand on spreading roots, in radii of the foot.
const ROOT_RINGS: [f32; 4] = [0.25, 0.6, 1.1, 2.0];
/// A flare of less, in internodes, needs no rings of its own: most of a tree is twigs.
const LEAST_FLARE: f32 = 0.02;
/// Rings closer than this share of an internode merge.
const LEAST_GAP: f32 = 0.04;
/// Thick wood, in radii an internode, turns its rings evenly from node to node: all of it, and from where on some.
const STOUT: [f32; 2] = [0.25, 0.6];

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
    /// Unit vector along the curve, or rather across the ring.
    pub tangent: Vec3,
    /// Length from the beginning.
    pub arc: f32,
    /// On the average around the wood.
    pub radius: f32,
    /// How far roots rise from that, by the shape of their ribs.
    pub ribs: f32,
    /// Whose surface it is.
    pub metamer: MetamerId,
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

/// How far ribs rise at most.
const HIGHEST_RIB: f32 = 0.38;

impl Sample {
    /// How far it lies off a straight tube between two others, in place or in radius.
    fn off(&self, [from, to]: [&Self; 2]) -> f32 {
        let share = (self.arc - from.arc) / (to.arc - from.arc).max(f32::MIN_POSITIVE);
        let radius = from.radius + (to.radius - from.radius) * share;
        self.point.distance(from.point.lerp(to.point, share)).max((self.radius - radius).abs())
    }

    /// How far its ring reaches from the curve.
    fn reach(&self) -> f32 {
        self.radius + HIGHEST_RIB * self.ribs
    }

    /// Whether its ring and the next one's cross, or nearly do, or the skin between them would be sheared flat.
    fn crosses(&self, above: &Self) -> bool {
        let way = above.point - self.point;
        let tilt = self.tangent.cross(above.tangent).length();
        let (below, above_reach) = (self.reach(), above.reach());
        let least = (LEAST_CLEARANCE * below.min(above_reach)).max(LEAST_UPRIGHT * way.length());
        way.dot(self.tangent) < above_reach * tilt + least || way.dot(above.tangent) < below * tilt + least
    }
}

fn on_curve(course: &Course, smoothing: f32) -> Vec<Sample> {
    let last = course.nodes.len() - 2;
    let mut samples: Vec<Sample> = Vec::with_capacity(2 * course.nodes.len());
    // Along the straight ways between nodes, by which the flare declines.
    let mut reached = 0.0;
    for (i, (pair, &metamer)) in course.nodes.windows(2).zip(&course.rows).enumerate() {
        let &[from, to] = pair else { continue };
        let piece = Piece::between(&from, &to, smoothing);
        let is_foot = i == 0 && matches!(course.flare, Flare::Roots { .. });
        let stout = if i == 0 && !is_foot { 0.0 } else { piece.stout(smoothing) };
        let sinks = if is_foot { course.flare.sinks(from.direction) } else { 0.0 };
        let taper = Taper::between(&from, &to, piece.length, i == last && course.end == End::Grown);
        for u in parts(&piece, course, i) {
            // The foot goes on into what it stands on, however that slopes; deeper where it leans, for it is round.
            let sunk = (1.0 - u) * (1.0 - u) * sinks;
            let point = piece.point(u) - sunk * from.direction;
            let arc = samples.last().map_or(0.0, |s| s.arc + s.point.distance(point));
            let [radius, ribs] = course.flare.at(reached + piece.length * u - sunk, taper.at(u));
            let tangent = match u {
                // At a node the ring lies between both ways, also where there is a corner.
                0.0 => from.direction,
                1.0 => to.direction,
                _ => piece.across(u, stout),
            };
            samples.push(Sample { point, tangent, arc, radius, ribs, metamer });
        }
        reached += piece.length;
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
    let wanted = match course.flare {
        Flare::Collar { amount, hidden, falloff } if amount > LEAST_FLARE => {
            COLLAR_RINGS.map(|falloffs| hidden + falloffs * falloff)
        }
        Flare::Roots { foot, .. } if foot > LEAST_FLARE => ROOT_RINGS.map(|radii| radii * foot),
        _ => return parts,
    };
    for part in wanted.map(|length| length / piece.length.max(f32::MIN_POSITIVE)) {
        let place = parts.partition_point(|&p| p < part);
        let is_free = |neighbour: Option<&f32>| neighbour.is_some_and(|n| (n - part).abs() >= LEAST_GAP);
        if place > 0 && is_free(parts.get(place - 1)) && is_free(parts.get(place)) {
            parts.insert(place, part);
        }
    }
    parts
}

/// How thick wood is between two nodes: widths meet without a corner at the joints, and the last metamer is a cone.
struct Taper {
    from: f32,
    drop: f32,
    /// At both nodes, in radii over the whole length.
    inclines: [f32; 2],
    is_cone: bool,
}

impl Taper {
    fn between(from: &Node, to: &Node, length: f32, is_cone: bool) -> Self {
        let drop = to.radius - from.radius;
        // Never beyond either: slopes are those of one girth, and the tip of a limb is slimmer.
        let incline = |node: &Node| {
            (node.slope * node.radius * length).clamp((3.0 * drop).min(0.0), (3.0 * drop).max(0.0))
        };
        Self { from: from.radius, drop, inclines: [incline(from), incline(to)], is_cone }
    }

    fn at(&self, u: f32) -> f32 {
        let (u2, u3) = (u * u, u * u * u);
        if self.is_cone {
            return self.from + self.drop * u2;
        }
        let [below, above] = self.inclines;
        self.from + self.drop * (3.0 * u2 - 2.0 * u3) + below * (u3 - 2.0 * u2 + u) + above * (u3 - u2)
    }
}

/// The curve between two nodes, in Hermite form.
struct Piece {
    from: Vec3,
    chord: Vec3,
    length: f32,
    heading: Vec3,
    /// Unit vectors along the curve at both nodes.
    leaves: Vec3,
    arrives: Vec3,
    /// Across which rings lie there.
    rings: [Vec3; 2],
    /// Radii at both, the larger one in internodes.
    thickness: f32,
}

impl Piece {
    /// Between the straight way (`smoothing` 0) and the whole curve (1).
    fn between(from: &Node, to: &Node, smoothing: f32) -> Self {
        let chord = to.place - from.place;
        let length = chord.length();
        let heading = chord.normalize_or(from.direction);
        let [leaves, arrives] =
            [from, to].map(|node| heading.lerp(node.direction, smoothing).normalize_or(heading));
        let thickness = from.radius.max(to.radius) / length.max(1e-3);
        let rings = [from.direction, to.direction];
        Self { from: from.place, chord, length, heading, leaves, arrives, rings, thickness }
    }

    /// How much its rings turn evenly: they would cross where the curve gathers its turn.
    fn stout(&self, smoothing: f32) -> f32 {
        let share = ((self.thickness - STOUT[0]) / (STOUT[1] - STOUT[0])).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share) * smoothing
    }

    fn point(&self, u: f32) -> Vec3 {
        let (u2, u3) = (u * u, u * u * u);
        self.from
            + (u3 - 2.0 * u2 + u) * self.length * self.leaves
            + (3.0 * u2 - 2.0 * u3) * self.chord
            + (u3 - u2) * self.length * self.arrives
    }

    fn tangent(&self, u: f32) -> Vec3 {
        let u2 = u * u;
        let derivative = (3.0 * u2 - 4.0 * u + 1.0) * self.leaves
            + 6.0 * (u - u2) * self.heading
            + (3.0 * u2 - 2.0 * u) * self.arrives;
        derivative.normalize_or(self.heading)
    }

    /// Across which a ring between the nodes lies.
    fn across(&self, u: f32, stout: f32) -> Vec3 {
        let tangent = self.tangent(u);
        let even = self.rings[0].lerp(self.rings[1], u).normalize_or(tangent);
        tangent.lerp(even, stout).normalize_or(tangent)
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
    use espalier_plant::AxisId;

    use super::{super::course::ribs, *};

    /// A limb from node to node, whose rings lie half-way between both ways.
    fn course(nodes: &[Vec3]) -> Course {
        let way = |i: usize| (nodes[i + 1] - nodes[i]).normalize();
        let node = |(i, &place): (usize, &Vec3)| {
            let direction = if i == 0 {
                way(0)
            } else if i + 1 == nodes.len() {
                way(i - 1)
            } else {
                (way(i - 1) + way(i)).normalize()
            };
            Node { place, direction, radius: 0.1, slope: 0.0 }
        };
        Course {
            seed: MetamerId::new(0),
            axis: AxisId::new(0),
            rows: (1..nodes.len()).map(MetamerId::new).collect(),
            nodes: nodes.iter().enumerate().map(node).collect(),
            normal: way(0).any_orthonormal_vector(),
            flare: Flare::Collar { amount: 0.0, hidden: 0.0, falloff: 1.0 },
            end: End::Cut,
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
        course.flare = Flare::Collar { amount: 0.1, hidden: 0.1, falloff: 0.1 };
        let radii: Vec<f32> = samples(&course, 1.0, 0.0).iter().map(|s| s.radius).collect();
        assert_eq!(radii.len(), 6);
        assert_eq!(radii[..2], [0.2, 0.2]);
        assert!(radii[1..].is_sorted_by(|a, b| a > b));
    }

    #[test]
    fn rings_of_a_sharp_bend_do_not_cross() {
        let mut course = course(&[Vec3::ZERO, Vec3::Y, Vec3::Y + 0.4 * Vec3::X, Vec3::X]);
        for (node, radius) in course.nodes.iter_mut().zip([0.8, 0.8, 0.7, 0.6]) {
            node.radius = radius;
        }
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

    #[test]
    fn a_foot_spreads_in_ribs_and_goes_into_the_ground() {
        let mut course = course(&[Vec3::ZERO, Vec3::Y, 2.0 * Vec3::Y, 3.0 * Vec3::Y]);
        course.nodes.iter_mut().for_each(|node| node.radius = 0.5);
        course.flare = Flare::Roots { share: 1.0, foot: 0.5 };
        let samples = samples(&course, 1.0, 0.0);
        assert!((samples[0].point.y + 0.25).abs() < 1e-6, "half a radius deep");
        assert!((samples[0].radius - 0.5 * 1.58).abs() < 1e-3 && samples[0].ribs == 0.5);
        assert!(samples.iter().map(|s| s.ribs).is_sorted_by(|a, b| a >= b));
        let mean = (0..720).map(|i| ribs(i as f32 / 720.0)).sum::<f32>() / 720.0;
        assert!(mean.abs() < 0.03, "{mean}");
        assert!((0..720).all(|i| ribs(i as f32 / 720.0) <= HIGHEST_RIB + 1e-4));
    }

    #[test]
    fn a_last_metamer_is_a_cone_and_joints_have_no_corner() {
        let taper = Taper { from: 1.0, drop: -0.5, inclines: [0.0; 2], is_cone: true };
        assert_eq!([0.0, 0.5, 1.0].map(|u| taper.at(u)), [1.0, 0.875, 0.5]);
        let taper = Taper { from: 1.0, drop: -0.5, inclines: [-0.5, -0.5], is_cone: false };
        assert_eq!([0.0, 0.5, 1.0].map(|u| taper.at(u)), [1.0, 0.75, 0.5]);
    }
}
