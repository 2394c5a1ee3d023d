//! Functions of the place along an axis.

use espalier_plant::hash::StableHash;
use espalier_reading::NotAllowed;

/// Intervals of the table by which a function is evaluated.
const INTERVALS: usize = 64;
/// Most points of a function.
pub const MOST_POINTS: usize = 16;

/// A function of t in [0, 1]: a monotone cubic through its points, so that it goes beyond none of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    points: Vec<(f32, f32)>,
    table: Box<[f32; INTERVALS + 1]>,
}

impl Function {
    /// Through these points: 2 to 16, t rising from 0 to 1.
    ///
    /// # Errors
    /// Where there are too few or too many points, or they are not in order.
    pub fn new(points: &[(f32, f32)]) -> Result<Self, NotAllowed> {
        if !(2..=MOST_POINTS).contains(&points.len()) {
            return Err(NotAllowed::new(format!("{} points", points.len()), "2 to 16 points"));
        }
        let refused = |at: usize, part: usize, found: f32, allowed: &str| NotAllowed {
            at: format!("[{at}][{part}]"),
            ..NotAllowed::new(found.to_string(), allowed)
        };
        for (at, &(t, value)) in points.iter().enumerate() {
            let bounds = match at {
                0 => (0.0, 0.0, "0, where an axis begins"),
                last if last + 1 == points.len() => (1.0, 1.0, "1, where an axis ends"),
                _ => (0.0, 1.0, "a place between 0 and 1"),
            };
            if !(bounds.0..=bounds.1).contains(&t) {
                return Err(refused(at, 0, t, bounds.2));
            }
            if at > 0 && t <= points[at - 1].0 {
                return Err(refused(at, 0, t, "a place beyond that of the point before"));
            }
            if !value.is_finite() {
                return Err(refused(at, 1, value, "a number"));
            }
        }
        Ok(Self { table: tabulate(points), points: points.to_vec() })
    }

    /// The same value everywhere.
    pub fn constant(value: f32) -> Self {
        Self::line(value, value)
    }

    /// From one value at the base to another at the tip.
    pub fn line(base: f32, tip: f32) -> Self {
        let points = vec![(0.0, base), (1.0, tip)];
        Self { table: tabulate(&points), points }
    }

    /// Its points. Of a combination of functions they only lie near it.
    pub fn points(&self) -> &[(f32, f32)] {
        &self.points
    }

    /// The value at t, which is kept within [0, 1].
    pub fn at(&self, t: f32) -> f32 {
        let place = t.clamp(0.0, 1.0) * INTERVALS as f32;
        let interval = (place as usize).min(INTERVALS - 1);
        let (below, above) = (self.table[interval], self.table[interval + 1]);
        below + (above - below) * (place - interval as f32)
    }

    /// The least and the greatest value.
    pub fn bounds(&self) -> (f32, f32) {
        let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
        for &value in self.table.iter() {
            (least, most) = (least.min(value), most.max(value));
        }
        (least, most)
    }

    /// Both functions combined place by place, as a table; points are taken from it evenly.
    pub(crate) fn combined(&self, other: &Self, combine: impl Fn(f32, f32) -> f32) -> Self {
        let mut table = self.table.clone();
        for (value, &with) in table.iter_mut().zip(other.table.iter()) {
            *value = combine(*value, with);
        }
        let steps = MOST_POINTS - 1;
        let mut combined = Self { points: Vec::new(), table };
        let sample = |at: usize| {
            let t = at as f32 / steps as f32;
            (t, combined.at(t))
        };
        combined.points = (0..=steps).map(sample).collect();
        combined
    }

    pub(crate) fn hash(&self, hash: &mut StableHash) {
        for value in self.table.iter() {
            hash.word(value.to_bits().into());
        }
    }
}

fn tabulate(points: &[(f32, f32)]) -> Box<[f32; INTERVALS + 1]> {
    let slopes = slopes(points);
    let mut table = Box::new([0.0; INTERVALS + 1]);
    let mut segment = 0;
    for (place, value) in table.iter_mut().enumerate() {
        let t = place as f32 / INTERVALS as f32;
        while segment + 2 < points.len() && points[segment + 1].0 < t {
            segment += 1;
        }
        let ((t0, y0), (t1, y1)) = (points[segment], points[segment + 1]);
        let h = t1 - t0;
        let s = ((t - t0) / h).clamp(0.0, 1.0);
        let (d0, d1) = (slopes[segment] * h, slopes[segment + 1] * h);
        let cubic = d0 + d1 - 2.0 * (y1 - y0);
        let square = 3.0 * (y1 - y0) - 2.0 * d0 - d1;
        // Rounding alone may lead out of the points' range.
        *value = (y0 + s * (d0 + s * (square + s * cubic))).clamp(y0.min(y1), y0.max(y1));
    }
    table
}

/// Slopes at the points after Fritsch and Butland: harmonic means of the secants, by + − × ÷ alone.
fn slopes(points: &[(f32, f32)]) -> Vec<f32> {
    let secant = |at: usize| (points[at + 1].1 - points[at].1) / (points[at + 1].0 - points[at].0);
    let width = |at: usize| points[at + 1].0 - points[at].0;
    let last = points.len() - 1;
    if last == 1 {
        return vec![secant(0); 2];
    }
    let inner = |at: usize| {
        let (before, after) = (secant(at - 1), secant(at));
        if before * after <= 0.0 {
            return 0.0;
        }
        let first = 2.0 * width(at) + width(at - 1);
        let second = width(at) + 2.0 * width(at - 1);
        (first + second) / (first / before + second / after)
    };
    let end = |near: usize, far: usize| {
        let (h0, h1, s0, s1) = (width(near), width(far), secant(near), secant(far));
        let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
        if slope * s0 <= 0.0 {
            0.0
        } else if s0 * s1 <= 0.0 && slope.abs() > 3.0 * s0.abs() {
            3.0 * s0
        } else {
            slope
        }
    };
    (0..=last)
        .map(|at| match at {
            0 => end(0, 1),
            at if at == last => end(last - 1, last - 2),
            at => inner(at),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn it_goes_through_its_points_and_a_line_is_straight() {
        let function = Function::new(&[(0.0, 1.0), (0.25, 3.0), (0.5, 2.0), (1.0, 2.0)]).expect("it is one");
        for &(t, value) in function.points() {
            assert!((function.at(t) - value).abs() < 1e-6, "at {t}");
        }
        assert!(
            (0..=10)
                .map(|t| t as f32 / 10.0)
                .all(|t| (Function::line(2.0, 4.0).at(t) - 2.0 - 2.0 * t).abs() < 1e-5)
        );
    }

    #[test]
    fn points_that_make_no_function_are_refused_where_they_stand() {
        for (points, at) in [
            (vec![], ""),
            (vec![(0.0, 1.0)], ""),
            (vec![(0.0, 0.0); 17], ""),
            (vec![(0.1, 0.0), (1.0, 0.0)], "[0][0]"),
            (vec![(0.0, 0.0), (0.9, 0.0)], "[1][0]"),
            (vec![(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (1.0, 0.0)], "[2][0]"),
            (vec![(0.0, 0.0), (f32::NAN, 0.0), (1.0, 0.0)], "[1][0]"),
            (vec![(0.0, 0.0), (1.0, f32::INFINITY)], "[1][1]"),
        ] {
            assert_eq!(Function::new(&points).expect_err("it is refused").at, at, "{points:?}");
        }
    }

    proptest! {
        #[test]
        fn between_two_points_it_goes_beyond_neither(values in prop::collection::vec(-5.0f32..5.0, 2..16)) {
            let last = values.len() - 1;
            let points: Vec<_> = values.iter().enumerate().map(|(at, &value)| (at as f32 / last as f32, value)).collect();
            let function = Function::new(&points).expect("it is one");
            let (least, most) = function.bounds();
            let all = values.iter().copied();
            prop_assert!(least >= all.clone().fold(f32::INFINITY, f32::min) - 1e-5);
            prop_assert!(most <= all.fold(f32::NEG_INFINITY, f32::max) + 1e-5);
        }
    }
}
