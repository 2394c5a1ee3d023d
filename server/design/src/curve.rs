//! The course of an axis, without its size.

use espalier_plant::hash::StableHash;
use espalier_reading::NotAllowed;
use glam::Vec3;

/// Intervals of the table by which a curve is evaluated.
const INTERVALS: usize = 64;
/// Steps along each piece between two points, from which the table is made.
const STEPS: usize = 16;
/// Most points of a curve.
pub const MOST_POINTS: usize = 24;
/// How far a coordinate may lie from the origin.
const FARTHEST: f32 = 4.0;
/// Two points that follow one another are at least so far apart.
const NEAREST: f32 = 1e-3;
/// How exactly a curve begins and ends where it must.
const EXACT: f32 = 1e-4;

/// A centripetal Catmull-Rom curve from the origin to (0, 1, 0): the chord of every axis is one unit along Y.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    points: Vec<Vec3>,
    /// Places at equal steps along it.
    table: Box<[Vec3; INTERVALS + 1]>,
    length: f32,
}

impl Curve {
    /// Through these points, 2 to 24; the first is the origin, the last (0, 1, 0).
    ///
    /// # Errors
    /// Where there are too few or too many points, one is out of range or upon the one before, or an end is elsewhere.
    pub fn new(points: &[Vec3]) -> Result<Self, NotAllowed> {
        if !(2..=MOST_POINTS).contains(&points.len()) {
            return Err(NotAllowed::new(format!("{} points", points.len()), "2 to 24 points"));
        }
        let refused = |at: usize, found: Vec3, allowed: &str| {
            let found = format!("[{}, {}, {}]", found.x, found.y, found.z);
            NotAllowed { at: format!("[{at}]"), ..NotAllowed::new(found, allowed) }
        };
        for (at, &point) in points.iter().enumerate() {
            if !(point.is_finite() && point.abs().max_element() <= FARTHEST) {
                return Err(refused(at, point, "coordinates from -4 to 4"));
            }
            if at > 0 && point.distance(points[at - 1]) < NEAREST {
                return Err(refused(at, point, "a place at least 0.001 from the point before"));
            }
        }
        let last = points.len() - 1;
        if points[0].length() > EXACT {
            return Err(refused(0, points[0], "[0, 0, 0], where the axis begins"));
        }
        if points[last].distance(Vec3::Y) > EXACT {
            return Err(refused(last, points[last], "[0, 1, 0], where the axis ends"));
        }
        Ok(Self::through(points.to_vec()))
    }

    /// A straight axis.
    pub fn straight() -> Self {
        Self::through(vec![Vec3::ZERO, Vec3::Y])
    }

    fn through(points: Vec<Vec3>) -> Self {
        let fine = fine(&points);
        let (table, length) = evenly(&fine);
        Self { points, table, length }
    }

    /// Its points.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Its length where its chord is 1.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// The place at a share t of its length, kept within [0, 1].
    pub fn at(&self, t: f32) -> Vec3 {
        let place = t.clamp(0.0, 1.0) * INTERVALS as f32;
        let interval = (place as usize).min(INTERVALS - 1);
        self.table[interval].lerp(self.table[interval + 1], place - interval as f32)
    }

    pub(crate) fn hash(&self, hash: &mut StableHash) {
        for &point in self.table.iter() {
            hash.vector(point);
        }
    }
}

/// The curve in short straight pieces.
fn fine(points: &[Vec3]) -> Vec<Vec3> {
    let last = points.len() - 1;
    if last == 1 {
        return points.to_vec();
    }
    // Beyond its ends the curve goes on as it began.
    let point = |at: isize| match at {
        at if at < 0 => points[0] * 2.0 - points[1],
        at if at as usize > last => points[last] * 2.0 - points[last - 1],
        at => points[at as usize],
    };
    let mut fine = vec![points[0]];
    for piece in 0..last {
        let [p0, p1, p2, p3] = [-1, 0, 1, 2].map(|beside| point(piece as isize + beside));
        let knot = |from: Vec3, to: Vec3| from.distance(to).sqrt().max(1e-4);
        let (a, b, c) = (knot(p0, p1), knot(p1, p2), knot(p2, p3));
        let out = (p1 - p0) / a - (p2 - p0) / (a + b) + (p2 - p1) / b;
        let into = (p2 - p1) / b - (p3 - p1) / (b + c) + (p3 - p2) / c;
        let (m1, m2) = (out * b, into * b);
        for step in 1..=STEPS {
            let s = step as f32 / STEPS as f32;
            let (s2, s3) = (s * s, s * s * s);
            fine.push(
                p1 * (2.0 * s3 - 3.0 * s2 + 1.0)
                    + m1 * (s3 - 2.0 * s2 + s)
                    + p2 * (3.0 * s2 - 2.0 * s3)
                    + m2 * (s3 - s2),
            );
        }
    }
    fine
}

/// Places at equal steps along a polyline, and its length.
pub(crate) fn evenly(fine: &[Vec3]) -> (Box<[Vec3; INTERVALS + 1]>, f32) {
    let length: f32 = fine.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let mut table = Box::new([fine[0]; INTERVALS + 1]);
    let (mut piece, mut passed) = (0, 0.0);
    for (at, place) in table.iter_mut().enumerate() {
        let wanted = length * at as f32 / INTERVALS as f32;
        loop {
            let span = fine[piece].distance(fine[piece + 1]);
            if passed + span >= wanted || piece + 2 == fine.len() {
                let share = if span > 0.0 { ((wanted - passed) / span).clamp(0.0, 1.0) } else { 0.0 };
                *place = fine[piece].lerp(fine[piece + 1], share);
                break;
            }
            passed += span;
            piece += 1;
        }
    }
    table[INTERVALS] = fine[fine.len() - 1];
    (table, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_through_its_points_at_even_speed() {
        let points = [Vec3::ZERO, Vec3::new(0.3, 0.4, 0.0), Vec3::new(-0.2, 0.8, 0.1), Vec3::Y];
        let curve = Curve::new(&points).expect("it is one");
        for point in points {
            let nearest =
                (0..=1000).map(|t| curve.at(t as f32 / 1000.0).distance(point)).fold(f32::MAX, f32::min);
            assert!(nearest < 0.01, "{point} is {nearest} away");
        }
        let steps: Vec<_> =
            (0..64).map(|at| curve.at(at as f32 / 64.0).distance(curve.at((at + 1) as f32 / 64.0))).collect();
        assert!(steps.iter().all(|step| (step - curve.length() / 64.0).abs() < 0.003), "{steps:?}");
        assert!((Curve::straight().length() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn points_that_make_no_axis_are_refused_where_they_stand() {
        for (points, at) in [
            (vec![], ""),
            (vec![Vec3::ZERO], ""),
            (vec![Vec3::Y; 25], ""),
            (vec![Vec3::X, Vec3::Y], "[0]"),
            (vec![Vec3::ZERO, Vec3::X], "[1]"),
            (vec![Vec3::ZERO, Vec3::ZERO, Vec3::Y], "[1]"),
            (vec![Vec3::ZERO, Vec3::X * 5.0, Vec3::Y], "[1]"),
            (vec![Vec3::ZERO, Vec3::NAN, Vec3::Y], "[1]"),
        ] {
            assert_eq!(Curve::new(&points).expect_err("it is refused").at, at, "{points:?}");
        }
    }
}
