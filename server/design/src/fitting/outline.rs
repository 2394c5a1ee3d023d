//! Outlines around nodes, and how much two outlines differ.

use glam::{Vec2, Vec3};

use crate::envelope::{self, Envelope, FARTHEST, RADII};

/// Share of the nodes below the bottom, and above the top.
const ENDS: f32 = 0.02;
/// Share of a quadrant's nodes within its radius.
const WIDEST: f32 = 0.95;
/// The outermost share of a quadrant's nodes, which says how high it is widest.
const OUTERMOST: f32 = 0.15;
/// Share of a ring's nodes below the surface.
const HIGHEST: f32 = 0.9;
/// So deep within an outline is a place that it must not leave out.
const WITHIN: f32 = 0.01;
/// By how much an outline grows at a time, and most times that it does.
const WIDER: f32 = 1.05;
const MOST_GROWTH: usize = 24;
/// By how much each number of an outline is changed at first: places and heights by so much, radii and exponents by a share.
const FIRST_STEPS: [f32; 16] = [0.1; 16];
/// How often each is changed.
const SWEEPS: usize = 12;
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
    let extents = extents(places);
    for quadrant in 0..4 {
        let mut out: Vec<(f32, f32)> = (places.iter())
            .filter(|place| quadrant_of(place, &extents) == quadrant)
            .map(|place| (out_of(place, &extents), place.y))
            .collect();
        if out.is_empty() {
            continue;
        }
        out.sort_by(|a, b| a.0.total_cmp(&b.0));
        let widest = ((out.len() - 1) as f32 * WIDEST) as usize;
        envelope.radii[quadrant] = (out[widest].0 * extents[quadrant]).clamp(RADII.0, RADII.1);
        let outermost = &out[((out.len() as f32 * (1.0 - OUTERMOST)) as usize).min(out.len() - 1)..];
        let height = outermost.iter().map(|place| place.1).sum::<f32>() / outermost.len() as f32;
        envelope.heights[quadrant] = height.clamp(bottom + 0.02, top - 0.02);
    }
    (envelope.upper, envelope.lower) = shapes(&envelope, places);
    envelope
}

/// Lets an outline reach around places that it must not leave out, as far as it can, and no farther than it must.
pub(super) fn reach_around(envelope: &mut Envelope, inner: &[Vec3]) {
    for _ in 0..MOST_GROWTH {
        let (mut wider, mut higher, mut lower) = ([false; 4], false, false);
        for &place in inner.iter().filter(|&&place| envelope.depth(place) < WITHIN) {
            let [above, below] = [envelope.top, envelope.bottom].map(|pole| envelope.out(place, pole).0);
            if above.max(below) > 1.0 - WITHIN {
                // An ellipse of two radii passes there.
                wider[if place.x >= 0.0 { 0 } else { 2 }] = true;
                wider[if place.z >= 0.0 { 1 } else { 3 }] = true;
            } else if 2.0 * place.y > envelope.top.y + envelope.bottom.y {
                higher = true;
            } else {
                lower = true;
            }
        }
        if !(wider.contains(&true) || higher || lower) {
            return;
        }
        for (radius, _) in envelope.radii.iter_mut().zip(wider).filter(|(_, wider)| *wider) {
            *radius = (*radius * WIDER).min(RADII.1);
        }
        let room = 0.02 * (envelope.top.y - envelope.bottom.y);
        if higher {
            envelope.upper = (envelope.upper * WIDER).min(envelope::SHAPES.1);
            envelope.top.y = (envelope.top.y + room).min(FARTHEST);
        }
        if lower {
            envelope.lower = (envelope.lower * WIDER).min(envelope::SHAPES.1);
            envelope.bottom.y = (envelope.bottom.y - room).max(-FARTHEST);
        }
    }
}

/// A limb as its bearer's outline sees it: in that one's frame and lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub from: Vec3,
    pub direction: Vec3,
    /// How far its tip is.
    pub length: f32,
    pub weight: f32,
}

/// How far off tips are from an outline, on the whole.
fn off(envelope: &Envelope, rays: &[Ray]) -> f32 {
    let off = |ray: &Ray| {
        let way = envelope.distance(ray.from, ray.direction).unwrap_or(0.0);
        ray.weight * (way - ray.length).abs()
    };
    rays.iter().map(off).sum()
}

/// The outline near another one on which most tips lie.
pub(super) fn through(envelope: &mut Envelope, rays: &[Ray]) {
    let (first, mut steps) = (off(envelope, rays), FIRST_STEPS);
    let mut least = first;
    for _ in 0..SWEEPS {
        for (number, step) in steps.iter_mut().enumerate() {
            let tried = [1.0, -1.0].map(|way| {
                let mut other = envelope.clone();
                nudge(&mut other, number, way * *step);
                let off = if other.check().is_ok() { off(&other, rays) } else { f32::INFINITY };
                (other, off)
            });
            match tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some((other, off)) if off < least => (*envelope, least) = (other, off),
                _ => *step *= 0.5,
            }
        }
    }
}

/// Changes one of the numbers of an outline.
fn nudge(envelope: &mut Envelope, number: usize, by: f32) {
    let factor = libm::expf(by);
    match number {
        0..3 => envelope.top[number] += by,
        3..6 => envelope.bottom[number - 3] += by,
        6..10 => envelope.radii[number - 6] *= factor,
        10..14 => envelope.heights[number - 10] += by,
        14 => envelope.upper *= factor,
        _ => envelope.lower *= factor,
    }
}

/// How far places reach along +X, +Z, −X and −Z.
fn extents(places: &[Vec3]) -> [f32; 4] {
    let along: [fn(&Vec3) -> f32; 4] = [|place| place.x, |place| place.z, |place| -place.x, |place| -place.z];
    along.map(|along| {
        let mut far: Vec<f32> = places.iter().map(along).filter(|&far| far > 0.0).collect();
        quantile(&mut far, WIDEST).max(RADII.0)
    })
}

/// How far out a place is between two extents, 1 on the ellipse through both.
fn out_of(place: &Vec3, extents: &[f32; 4]) -> f32 {
    let x = place.x / extents[if place.x >= 0.0 { 0 } else { 2 }];
    let z = place.z / extents[if place.z >= 0.0 { 1 } else { 3 }];
    Vec2::new(x, z).length()
}

/// The extent, 0 to 3 for +X, +Z, −X and −Z, that a place reaches the largest share of.
fn quadrant_of(place: &Vec3, extents: &[f32; 4]) -> usize {
    let shares = [place.x, place.z, -place.x, -place.z];
    let share = |&quadrant: &usize| shares[quadrant] / extents[quadrant];
    (0..4).max_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(0)
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
            prop_assert!(off < 0.42, "{} of {:?} for {:?}", off, found, wanted);
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
