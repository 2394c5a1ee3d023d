//! Outlines around nodes, and how much two outlines differ.

use glam::{Vec2, Vec3};

use crate::envelope::{Envelope, FARTHEST, RADII};

/// Share of the nodes below the bottom, and above the top.
const ENDS: f32 = 0.02;
/// Share of a quadrant's nodes within its radius.
const WIDEST: f32 = 0.95;
/// The outermost share of a quadrant's nodes, which says how high it is widest.
const OUTERMOST: f32 = 0.15;
/// Share of a ring's nodes below the surface.
const HIGHEST: f32 = 0.9;
/// Where exponents are looked for.
const SHAPES: (f32, f32) = (0.3, 6.0);
/// Rings in which the profile of a crown is looked at.
const RINGS: usize = 16;
/// Steps of the search for an exponent.
const STEPS: usize = 16;
/// Places along each side of the grid by which outlines are compared.
const GRID: u8 = 8;

/// The outline of places in its frame, the base in the origin.
pub(super) fn around(places: &[Vec3], tip: Vec3) -> Envelope {
    let mut heights: Vec<f32> = places.iter().map(|place| place.y).collect();
    let bottom = quantile(&mut heights, ENDS).clamp(-FARTHEST, FARTHEST - 0.1);
    let top = quantile(&mut heights, 1.0 - ENDS).clamp(bottom + 0.05, FARTHEST);
    let middle = |is_end: &dyn Fn(f32) -> bool| {
        let (mut sum, mut count) = (Vec2::ZERO, 0.0f32);
        for place in places.iter().filter(|place| is_end(place.y)) {
            sum += Vec2::new(place.x, place.z);
            count += 1.0;
        }
        (sum / count.max(1.0)).clamp(Vec2::splat(-FARTHEST), Vec2::splat(FARTHEST))
    };
    let slice = 0.06 * (top - bottom);
    let (at_top, at_bottom) = (middle(&|y| y >= top - slice), middle(&|y| y <= bottom + slice));
    let mut envelope = Envelope {
        top: Vec3::new(at_top.x, top, at_top.y),
        bottom: Vec3::new(at_bottom.x, bottom, at_bottom.y),
        radii: [RADII.0; 4],
        heights: [0.5 * (top + bottom); 4],
        upper: 2.0,
        lower: 2.0,
        tip,
    };
    for quadrant in 0..4 {
        let mut out: Vec<(f32, f32)> = (places.iter())
            .filter(|place| in_quadrant(place, quadrant))
            .map(|place| (Vec2::new(place.x, place.z).length(), place.y))
            .collect();
        if out.is_empty() {
            continue;
        }
        out.sort_by(|a, b| a.0.total_cmp(&b.0));
        let widest = ((out.len() - 1) as f32 * WIDEST) as usize;
        envelope.radii[quadrant] = out[widest].0.clamp(RADII.0, RADII.1);
        let outermost = &out[((out.len() as f32 * (1.0 - OUTERMOST)) as usize).min(out.len() - 1)..];
        let height = outermost.iter().map(|place| place.1).sum::<f32>() / outermost.len() as f32;
        envelope.heights[quadrant] = height.clamp(bottom + 0.02, top - 0.02);
    }
    (envelope.upper, envelope.lower) = shapes(&envelope, places);
    envelope
}

/// Lets an outline reach around places that it must not leave out, as far as it can.
pub(super) fn reach_around(envelope: &mut Envelope, inner: &[Vec3]) {
    for _ in 0..16 {
        let outside: Vec<Vec3> =
            inner.iter().copied().filter(|&place| envelope.depth(place) < 0.01).collect();
        if outside.is_empty() {
            return;
        }
        let lowest = outside.iter().map(|place| place.y).fold(f32::INFINITY, f32::min);
        envelope.bottom.y = envelope.bottom.y.min(lowest - 0.03).max(-FARTHEST);
        for radius in &mut envelope.radii {
            *radius = (*radius * 1.05).min(RADII.1);
        }
        envelope.upper = (envelope.upper * 1.1).min(SHAPES.1);
        envelope.lower = (envelope.lower * 1.1).min(SHAPES.1);
    }
}

fn in_quadrant(place: &Vec3, quadrant: usize) -> bool {
    let (x, z) = (place.x, place.z);
    match quadrant {
        0 => x >= z.abs(),
        1 => z > x.abs(),
        2 => -x >= z.abs() && x < 0.0,
        _ => -z > x.abs(),
    }
}

/// The exponents above and below the periphery at which the area outside and the area uncovered are least.
fn shapes(envelope: &Envelope, places: &[Vec3]) -> (f32, f32) {
    // How near to the top, or to the bottom, nodes come in each ring.
    let mut rises: [[Vec<f32>; RINGS]; 2] = Default::default();
    for &place in places {
        for (half, rises) in rises.iter_mut().enumerate() {
            let pole = if half == 0 { envelope.top } else { envelope.bottom };
            let (share, height) = envelope.out(place, pole);
            let rise = (place.y - height) / (pole.y - height);
            if share < 1.0 && rise >= 0.0 && rise.is_finite() {
                rises[(share * RINGS as f32) as usize].push(rise.min(1.2));
            }
        }
    }
    let rings =
        rises.map(|half| half.map(|mut ring| (!ring.is_empty()).then(|| quantile(&mut ring, HIGHEST))));
    let shape = |rings: &[Option<f32>; RINGS]| {
        let area = |exponent: f32| {
            let off = |(ring, rise): (usize, &Option<f32>)| {
                let share = (ring as f32 + 0.5) / RINGS as f32;
                let surface = 1.0 - libm::powf(share, exponent);
                // A ring far out is larger; one without nodes is uncovered.
                share * (rise.unwrap_or(0.0) - surface).abs()
            };
            rings.iter().enumerate().map(off).sum::<f32>()
        };
        if rings.iter().all(Option::is_none) { 2.0 } else { least(SHAPES, area) }
    };
    (shape(&rings[0]), shape(&rings[1]))
}

/// Where a function is least, by golden section of the logarithm.
fn least((from, to): (f32, f32), of: impl Fn(f32) -> f32) -> f32 {
    const GOLDEN: f32 = 0.618_034;
    let value = |log: f32| of(libm::expf(log));
    let (mut from, mut to) = (libm::logf(from), libm::logf(to));
    let (mut low, mut high) = (to - GOLDEN * (to - from), from + GOLDEN * (to - from));
    let (mut at_low, mut at_high) = (value(low), value(high));
    for _ in 0..STEPS {
        if at_low < at_high {
            (to, high, at_high) = (high, low, at_low);
            low = to - GOLDEN * (to - from);
            at_low = value(low);
        } else {
            (from, low, at_low) = (low, high, at_high);
            high = from + GOLDEN * (to - from);
            at_high = value(high);
        }
    }
    libm::expf(0.5 * (from + to))
}

/// The volume that only one of two outlines holds, over the mean of both.
pub(super) fn difference(a: &Envelope, b: &Envelope) -> f32 {
    let ((low_a, high_a), (low_b, high_b)) = (a.bounds(), b.bounds());
    let (low, high) = (low_a.min(low_b), high_a.max(high_b));
    let step = (high - low) / f32::from(GRID);
    let (mut only, mut held) = (0u32, 0u32);
    for x in 0..GRID {
        for y in 0..GRID {
            for z in 0..GRID {
                let at = Vec3::new(f32::from(x), f32::from(y), f32::from(z)) + 0.5;
                let [in_a, in_b] = [a, b].map(|envelope| envelope.contains(low + step * at));
                only += u32::from(in_a != in_b);
                held += u32::from(in_a) + u32::from(in_b);
            }
        }
    }
    2.0 * only as f32 / held.max(1) as f32
}

/// A quantile; the numbers are put in order.
pub(super) fn quantile(numbers: &mut [f32], share: f32) -> f32 {
    numbers.sort_by(f32::total_cmp);
    let last = numbers.len().saturating_sub(1);
    numbers.get((last as f32 * share + 0.5) as usize).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Places within an outline, on a grid.
    fn filled(envelope: &Envelope) -> Vec<Vec3> {
        let (low, high) = envelope.bounds();
        let step = (high - low) / 24.0;
        let at = |x: u8, y: u8, z: u8| low + step * Vec3::new(f32::from(x), f32::from(y), f32::from(z));
        let all = (0..=24).flat_map(|x| (0..=24).flat_map(move |y| (0..=24).map(move |z| (x, y, z))));
        all.map(|(x, y, z)| at(x, y, z)).filter(|&place| envelope.contains(place)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn the_outline_of_what_fills_an_outline_is_that_one(
            radii in prop::array::uniform4(0.2f32..0.9),
            height in 0.3f32..0.7,
            upper in 0.8f32..4.0,
            lower in 0.8f32..4.0,
        ) {
            let wanted = Envelope { radii, heights: [height; 4], upper, lower, ..Envelope::default() };
            let found = around(&filled(&wanted), Vec3::Y);
            prop_assert_eq!(found.check(), Ok(()));
            let off = difference(&wanted, &found);
            prop_assert!(off < 0.35, "{} of {:?} for {:?}", off, found, wanted);
        }
    }

    #[test]
    fn outlines_differ_by_what_only_one_holds() {
        let one = Envelope::default();
        assert_eq!(difference(&one, &one), 0.0);
        let wider = Envelope { radii: [0.7; 4], ..Envelope::default() };
        // The wider one holds four times as much.
        assert!((difference(&one, &wider) - 1.2).abs() < 0.25, "{}", difference(&one, &wider));
    }
}
