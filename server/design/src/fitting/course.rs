//! Courses of axes, and functions along them.

use glam::Vec3;

use crate::{
    function::Function,
    key::Key,
    places::{MOST_LATERALS, Places},
};

/// Parts of an axis in which laterals are counted.
const BINS: usize = 8;
/// Places at which a radius, or an angle, is fitted.
pub(super) const KNOTS: usize = 5;
/// How much wider a zone is than it must be for as many laterals as there are.
const ROOM: f32 = 1.2;
/// Places at which a function of one axis is known, both ends left out.
const MOST_POINTS: usize = 14;
/// Places that are nearer to each other are one.
const NEAREST: f32 = 0.004;
/// Places at which courses are compared, the base and the tip included.
pub(super) const SAMPLES: usize = 9;

/// Values of weights, in the middle of all weight.
pub(super) fn median(mut numbers: Vec<(f32, f32)>) -> Option<f32> {
    numbers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * numbers.iter().map(|number| number.1).sum::<f32>();
    let mut passed = 0.0;
    for &(number, weight) in &numbers {
        passed += weight;
        if passed >= half {
            return Some(number);
        }
    }
    None
}

/// A function by least squares, linear between even places; parts without samples go on as those beside them.
pub(super) fn fitted(
    samples: impl Iterator<Item = (f32, f32)>,
    (least, most): (f32, f32),
) -> Option<Function> {
    // Normal equations of hat functions have three diagonals; a little stiffness fills what is empty.
    let (mut middle, mut beside, mut right) = ([0.0f64; KNOTS], [0.0f64; KNOTS], [0.0f64; KNOTS]);
    let mut count = 0u32;
    for (t, value) in samples {
        let place = t.clamp(0.0, 1.0) * (KNOTS - 1) as f32;
        let knot = (place as usize).min(KNOTS - 2);
        let (b, value) = (f64::from(place - knot as f32), f64::from(value));
        let a = 1.0 - b;
        middle[knot] += a * a;
        middle[knot + 1] += b * b;
        beside[knot] += a * b;
        right[knot] += a * value;
        right[knot + 1] += b * value;
        count += 1;
    }
    if count == 0 {
        return None;
    }
    let stiff = 0.02 * f64::from(count);
    for knot in 0..KNOTS - 1 {
        middle[knot] += stiff;
        middle[knot + 1] += stiff;
        beside[knot] -= stiff;
    }
    for knot in 1..KNOTS {
        let share = beside[knot - 1] / middle[knot - 1];
        middle[knot] -= share * beside[knot - 1];
        right[knot] -= share * right[knot - 1];
    }
    let mut values = [0.0; KNOTS];
    for knot in (0..KNOTS).rev() {
        let above = if knot + 1 < KNOTS { beside[knot] * values[knot + 1] } else { 0.0 };
        values[knot] = (right[knot] - above) / middle[knot];
    }
    let point =
        |(knot, &value): (usize, &f64)| (knot as f32 / (KNOTS - 1) as f32, (value as f32).clamp(least, most));
    let points: Vec<_> = values.iter().enumerate().map(point).collect();
    Function::new(&points).ok()
}

/// A function that is at each place what it is there, as nearly as so few points can say: samples are places, values and
/// weights. Neighbours that are most alike are taken together.
pub(super) fn along(mut samples: Vec<(f32, f32, f32)>, (least, most): (f32, f32)) -> Option<Function> {
    samples.retain(|sample| sample.2 > 0.0);
    samples.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let cost = |pair: &[(f32, f32, f32)]| {
        let ((at, a, weight), (next, b, other)) = (pair[0], pair[1]);
        let is_one = next - at < NEAREST;
        // What stands at one place can only say one thing.
        (!is_one, weight * other / (weight + other) * (a - b) * (a - b))
    };
    while let Some(at) = (0..samples.len().saturating_sub(1))
        .map(|at| (at, cost(&samples[at..at + 2])))
        .filter(|(_, (is_apart, _))| !is_apart || samples.len() > MOST_POINTS)
        .min_by(|a, b| a.1.0.cmp(&b.1.0).then(a.1.1.total_cmp(&b.1.1)))
        .map(|(at, _)| at)
    {
        let (a, b) = (samples[at], samples.remove(at + 1));
        let weight = a.2 + b.2;
        let mean = |a_is: f32, b_is: f32| (a_is * a.2 + b_is * b.2) / weight;
        samples[at] = (mean(a.0, b.0), mean(a.1, b.1), weight);
    }
    let (first, last) = (samples.first()?, samples.last()?);
    let point = |t: f32, value: f32| (t, value.clamp(least, most));
    let mut points: Vec<(f32, f32)> = Vec::new();
    if first.0 > NEAREST {
        points.push(point(0.0, first.1));
    }
    let (from, to) = (first.0, last.0);
    for &(t, value, _) in &samples {
        let t = if t == from && t <= NEAREST {
            0.0
        } else if t == to && t >= 1.0 - NEAREST {
            1.0
        } else {
            t
        };
        points.push(point(t, value));
    }
    if last.0 < 1.0 - NEAREST {
        points.push(point(1.0, last.1));
    }
    if points.len() == 1 {
        return Some(Function::constant(points[0].1));
    }
    Function::new(&points).ok()
}

/// How far two functions are from each other, as a share of the greater (L₂).
pub(super) fn difference(a: &Function, b: &Function) -> f32 {
    let (mut off, mut all) = (0.0, 0.0f32);
    for step in 0..=16u8 {
        let t = f32::from(step) / 16.0;
        let (a, b) = (a.at(t), b.at(t));
        off += (a - b) * (a - b);
        all += (a * a).max(b * b);
    }
    if all > 0.0 { (off / all).sqrt() } else { 0.0 }
}

/// Where laterals begin and end, so that as many at even places would stand where these do.
pub(super) fn zone(places: &[f32]) -> (f32, f32) {
    let (Some(&first), Some(&last)) = (places.first(), places.last()) else { return (0.15, 0.95) };
    let gap = (last - first).max(0.02) / (places.len() as f32 - 1.0).max(1.0);
    let last = (last + gap).clamp(0.02, 1.0);
    // Many in one place need room for their number, for no density is greater than it may be.
    let room = ROOM * places.len() as f32 / Key::Density.row().range.1;
    ((first - gap).min(last - room).clamp(0.0, 0.98), last)
}

/// A density that lays down so many laterals in a zone, in the proportions in which these places are taken.
pub(super) fn density(places: &[f32], count: f32, zone: (f32, f32), most: f32) -> Function {
    let count = count.round().min(MOST_LATERALS as f32);
    if count < 1.0 {
        return Function::constant(0.0);
    }
    let mut bins = [0.0f32; BINS];
    let width = (zone.1 - zone.0).max(0.02);
    for &place in places {
        let at = ((place - zone.0) / width).clamp(0.0, 0.999) * BINS as f32;
        bins[at as usize] += 1.0;
    }
    // What little there is says nothing of proportions.
    let even = 0.05 * places.len() as f32 + 0.5;
    let smooth = |bin: usize| {
        let [below, above] = [bin.saturating_sub(1), (bin + 1).min(BINS - 1)].map(|bin| bins[bin]);
        0.25 * below + 0.5 * bins[bin] + 0.25 * above + even
    };
    let function = |factor: f32| {
        let inner = (0..BINS).map(|bin| {
            let t = zone.0 + width * (bin as f32 + 0.5) / BINS as f32;
            (t.clamp(1e-3, 0.999), (smooth(bin) * factor).min(most))
        });
        let inner: Vec<_> = inner.collect();
        let (first, last) = ((0.0, inner[0].1), (1.0, inner[BINS - 1].1));
        let points: Vec<_> = [first].into_iter().chain(inner).chain([last]).collect();
        Function::new(&points).unwrap_or_else(|_| Function::constant(factor))
    };
    let mut factor = count / (width * (0..BINS).map(smooth).sum::<f32>() / BINS as f32);
    let mut found = function(factor);
    // Rounding, and the greatest density, may cost a lateral.
    for _ in 0..12 {
        let laterals = Places::of(&found, zone, 1).laterals() as f32;
        if laterals == count {
            break;
        }
        factor *= (count + 0.25 * (count - laterals).signum()) / laterals.max(0.5);
        found = function(factor);
    }
    found
}

/// Mean distance of two courses, and the greatest.
pub(super) fn apart(a: &[Vec3; SAMPLES], b: &[Vec3; SAMPLES]) -> (f32, f32) {
    let off = || a.iter().zip(b).map(|(a, b)| a.distance(*b));
    (off().sum::<f32>() / SAMPLES as f32, off().fold(0.0, f32::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_fitted_by_itself() {
        let samples = (0..40u8).map(|at| f32::from(at) / 39.0).map(|t| (t, 2.0 - t));
        let found = fitted(samples, (0.0, 4.0)).expect("there are samples");
        assert!(difference(&found, &Function::line(2.0, 1.0)) < 0.02, "{:?}", found.points());
        assert_eq!(fitted(std::iter::empty(), (0.0, 1.0)), None);
    }

    #[test]
    fn along_an_axis_a_function_is_at_each_place_what_it_is_there() {
        let places: Vec<(f32, f32, f32)> =
            (1..=8u8).map(|at| (f32::from(at) / 9.0, f32::from(at * 7 % 50), 1.0)).collect();
        let found = along(places.clone(), (0.0, 90.0)).expect("there are samples");
        for (t, value, _) in places {
            assert!((found.at(t) - value).abs() < 4.0, "{t}: {} for {value}", found.at(t));
        }
        let many =
            (0..60u8).map(|at| (f32::from(at) / 59.0, if at < 30 { 10.0 } else { 80.0 }, 1.0)).collect();
        let found = along(many, (0.0, 90.0)).expect("there are samples");
        assert!((found.at(0.2) - 10.0).abs() < 0.1 && (found.at(0.8) - 80.0).abs() < 0.1);
        assert_eq!(along(Vec::new(), (0.0, 90.0)), None);
    }

    #[test]
    fn many_in_one_place_have_room_for_their_number() {
        for count in 1..20u8 {
            let places = vec![1.0; usize::from(count)];
            let zone = zone(&places);
            let found = density(&places, count.into(), zone, Key::Density.row().range.1);
            assert_eq!(Places::of(&found, zone, 1).laterals(), usize::from(count), "{zone:?}");
        }
    }

    #[test]
    fn a_density_lays_down_as_many_as_were_counted() {
        for count in 1..60u8 {
            let places: Vec<f32> =
                (0..count).map(|at| 0.3 + 0.6 * f32::from(at) / f32::from(count)).collect();
            let zone = zone(&places);
            let found = density(&places, count.into(), zone, 200.0);
            assert_eq!(Places::of(&found, zone, 1).laterals(), usize::from(count), "{zone:?}");
        }
    }

    #[test]
    fn the_middle_is_that_of_the_weights() {
        assert_eq!(median(vec![(3.0, 1.0), (1.0, 1.0), (2.0, 1.0)]), Some(2.0));
        assert_eq!(median(vec![(3.0, 5.0), (1.0, 1.0), (2.0, 1.0)]), Some(3.0));
        assert_eq!(median(Vec::new()), None);
    }
}
