//! What each limb of a plant is like, and what the limbs of one order are like on the whole.

use glam::{Mat3, Vec3};

use super::{
    course::{SAMPLES, fitted, median, zone},
    limbs::{Limb, Wood},
    outline::{Ray, around, reach_around, through},
};
use crate::{
    curve::Curve,
    envelope::Envelope,
    frame::{of_tip, upward},
    function::Function,
    hands,
    key::Key,
};

/// How far a fitted axis may be off its nodes, in internodes.
const EXACT: f32 = 0.05;
/// Most nodes that an outline is fitted to.
const MOST_NODES: usize = 4096;
/// Most limbs that an outline is fitted to.
const MOST_RAYS: usize = 128;
/// As far as an outline reaches in its own units.
const ROOMY: f32 = 3.5;
/// An outline is at least this share of a lateral's length from its base.
const NEAR: f32 = 0.4;
/// Wood counts as no thinner, in internodes.
const THINNEST: f32 = 1e-4;
/// How often tapers and radii at bases are fitted to each other.
const ROUNDS_OF_TAPER: usize = 4;
/// Steps of the search for an internode.
const STEPS_OF_INTERNODE: usize = 16;
/// A limb that has fewer nodes for each of its own has no outline of its own.
const LEAST_BORNE: f32 = 3.0;

/// One limb.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    /// X on the side that looks up, Y from base to tip.
    pub frame: Mat3,
    /// From base to tip.
    pub length: f32,
    /// Its course in its frame and lengths.
    pub course: [Vec3; SAMPLES],
    pub outline: Option<Envelope>,
    pub girth: f32,
}

impl Shape {
    pub(super) fn of(wood: &Wood, number: usize) -> Self {
        let limb = &wood.limbs[number];
        let chord = limb.chord();
        let length = chord.length().max(1e-3);
        let direction = chord.normalize_or(Vec3::Y);
        let frame = match limb.bearer {
            None => of_tip(&Envelope { tip: direction, ..Envelope::default() }),
            Some((bearer, at)) => upward(direction, wood.limbs[bearer].heading(at)),
        };
        let back = frame.transpose();
        let own = |place: Vec3| back * (place - limb.base()) / length;
        let course = std::array::from_fn(|at| own(limb.at(at as f32 / (SAMPLES - 1) as f32)));
        let is_bearer = limb.size() >= LEAST_BORNE * limb.line.len() as f32 && !limb.laterals.is_empty();
        let outline = (is_bearer && limb.order > 0).then(|| {
            let mut outline =
                around(&nodes(wood, limb, MOST_NODES / 4).map(own).collect::<Vec<_>>(), Vec3::Y);
            let inner: Vec<Vec3> = bases(wood, limb).map(own).collect();
            reach_around(&mut outline, &inner);
            through(&mut outline, &rays(wood, limb, limb.base(), frame, length).collect::<Vec<_>>());
            reach_around(&mut outline, &inner);
            outline
        });
        let base = limb.radii.first().copied().unwrap_or(1.0);
        Self {
            frame,
            length,
            course,
            outline: outline.filter(|outline| outline.check().is_ok()),
            girth: base / limb.bearer_radius.max(THINNEST),
        }
    }

    /// Its course as a curve of few points.
    pub(super) fn axis(&self, limb: &Limb) -> Curve {
        let back = self.frame.transpose();
        let own: Vec<Vec3> =
            limb.line.iter().map(|&place| back * (place - limb.base()) / self.length).collect();
        hands::fitted(&own, EXACT / self.length)
    }
}

/// Nodes of a limb and of what it bears, at most so many.
fn nodes<'a>(wood: &'a Wood, limb: &Limb, most: usize) -> impl Iterator<Item = Vec3> + use<'a> {
    // The bare part of a stem is none of its crown.
    let first = limb.places.first().copied().unwrap_or(0.0);
    let bare = match limb.order {
        0 => (1..limb.line.len()).filter(|&at| limb.share(at) < first).count(),
        _ => 0,
    };
    let within = &wood.places[limb.within.start + bare..limb.within.end];
    within.iter().copied().step_by(within.len().div_ceil(most).max(1))
}

/// Where laterals begin, and how far out the outline must be so that their reach can be said.
fn bases<'a>(wood: &'a Wood, limb: &'a Limb) -> impl Iterator<Item = Vec3> + use<'a> {
    let laterals = limb.laterals.iter().map(|&lateral| &wood.limbs[lateral]);
    laterals.flat_map(|lateral| [lateral.base(), lateral.base() + lateral.chord() * NEAR])
}

/// What a limb bears, as its outline sees it, in a frame whose unit is so many internodes.
fn rays<'a>(wood: &'a Wood, limb: &'a Limb, base: Vec3, frame: Mat3, unit: f32) -> impl Iterator<Item = Ray> {
    let back = frame.transpose();
    limb.laterals.iter().map(move |&lateral| {
        let lateral = &wood.limbs[lateral];
        let chord = lateral.chord();
        Ray {
            from: back * (lateral.base() - base) / unit,
            direction: back * chord.normalize_or(Vec3::Y),
            length: chord.length() / unit,
            weight: lateral.size() * unit,
        }
    })
}

/// How the stem stands in its outline.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stem {
    pub outline: Envelope,
    /// From base to tip, without what is cut off.
    pub height: f32,
    pub cut: f32,
}

impl Stem {
    pub(super) fn of(wood: &Wood) -> Self {
        let stem = &wood.limbs[0];
        let base = stem.base();
        let places: Vec<Vec3> = nodes(wood, stem, MOST_NODES).map(|place| place - base).collect();
        let extent = places.iter().map(|place| place.abs().max_element()).fold(1.0, f32::max);
        let chord = stem.chord();
        // A stem that is all but none is a longer one, cut off.
        let (least, most) = Key::Height.row().range;
        let unit = chord.length().max(extent.max(least) / ROOMY);
        let height = chord.length().max(least).max(0.06 * unit).min(most);
        let cut = (chord.length() / height).min(1.0);
        let tip = chord.normalize_or(Vec3::Y) * (height / unit);
        let own: Vec<Vec3> = places.iter().map(|&place| place / unit).collect();
        let mut outline = around(&own, tip);
        let inner: Vec<Vec3> = bases(wood, stem).map(|place| (place - base) / unit).collect();
        reach_around(&mut outline, &inner);
        through(&mut outline, &rays(wood, stem, base, Mat3::IDENTITY, unit).collect::<Vec<_>>());
        reach_around(&mut outline, &inner);
        Self { outline, height, cut }
    }
}

/// What limbs of one order are like on the whole.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Usual {
    pub course: [Vec3; SAMPLES],
    pub axis: Curve,
    pub outline: Option<Envelope>,
    pub zone: (f32, f32),
    /// Laterals of one limb.
    pub laterals: f32,
    pub girth: f32,
    pub taper: Option<Function>,
    pub internode: f32,
    /// Nodes of foliage for each of their own.
    pub foliage: f32,
}

impl Usual {
    pub(super) fn of(wood: &Wood, shapes: &mut [Shape], order: u8) -> Option<Self> {
        let taper = taper(wood, shapes, order);
        let all: Vec<(&Limb, &Shape)> =
            wood.limbs.iter().zip(&*shapes).filter(|(limb, _)| limb.order == order).collect();
        if all.is_empty() {
            return None;
        }
        let weight: f32 = all.iter().map(|(limb, _)| limb.size()).sum();
        let mean = |of: &dyn Fn(&Limb, &Shape) -> f32| {
            all.iter().map(|(limb, shape)| of(limb, shape) * limb.size()).sum::<f32>() / weight
        };
        let mut course = [Vec3::ZERO; SAMPLES];
        for (limb, shape) in &all {
            for (sum, &place) in course.iter_mut().zip(&shape.course) {
                *sum += place * (limb.size() / weight);
            }
        }
        let axis = hands::fitted(&course, 0.02);
        let each = MOST_NODES.div_ceil(all.len()).max(8);
        let bearers = all.iter().filter(|(_, shape)| shape.outline.is_some());
        let own = |&(limb, shape): &(&Limb, &Shape)| {
            let (back, base, length) = (shape.frame.transpose(), limb.base(), shape.length);
            nodes(wood, limb, each).map(move |place| back * (place - base) / length).collect::<Vec<_>>()
        };
        let pooled: Vec<Vec3> = bearers.flat_map(own).collect();
        let outline = (!pooled.is_empty() && order > 0).then(|| {
            let mut outline = around(&pooled, Vec3::Y);
            let mut seen: Vec<Ray> = all
                .iter()
                .flat_map(|(limb, shape)| rays(wood, limb, limb.base(), shape.frame, shape.length))
                .collect();
            let every = seen.len().div_ceil(MOST_RAYS).max(1);
            seen = seen.into_iter().step_by(every).collect();
            through(&mut outline, &seen);
            outline
        });
        let mut places: Vec<f32> = all.iter().flat_map(|(limb, _)| limb.places.iter().copied()).collect();
        places.sort_by(f32::total_cmp);
        // Long limbs bear more, and matter more.
        let internodes = all.iter().map(|(limb, _)| limb.radii.len() as f32).sum::<f32>();
        let borne = |(limb, _): &(&Limb, &Shape)| (limb.places.len() * limb.radii.len()) as f32;
        let laterals = all.iter().map(borne).sum::<f32>() / internodes;
        // Of all limbs together, a few stand too near to the ends.
        let ends = places.len() / 50;
        let middle = &places[ends..places.len() - ends];
        let zone = if order == 0 { zone(&places) } else { pooled_zone(middle, laterals) };
        Some(Self {
            course,
            axis,
            outline: outline.filter(|outline| outline.check().is_ok()),
            zone,
            laterals,
            girth: median(all.iter().map(|(limb, shape)| (shape.girth, limb.size())).collect())?,
            taper,
            internode: internode(all.iter().map(|&(limb, _)| limb)),
            foliage: mean(&|limb, _| limb.size() / limb.radii.len() as f32),
        })
    }
}

/// How limbs of an order taper, and how thick each of them is at its base if it tapers so: short limbs are known only
/// where they are thinner already.
fn taper(wood: &Wood, shapes: &mut [Shape], order: u8) -> Option<Function> {
    let limbs = || wood.limbs.iter().enumerate().filter(|(_, limb)| limb.order == order);
    let radii = |limb: &Limb| -> Vec<(f32, f32)> {
        limb.radii.iter().enumerate().map(|(at, &radius)| (limb.share(at + 1), radius)).collect()
    };
    let mut bases: Vec<f32> = limbs().map(|(_, limb)| limb.radii.first().copied().unwrap_or(1.0)).collect();
    let mut found = None;
    for _ in 0..ROUNDS_OF_TAPER {
        let shares = limbs().zip(&bases).flat_map(|((_, limb), &base)| {
            radii(limb).into_iter().map(move |(t, radius)| (t, radius / base.max(THINNEST)))
        });
        let taper = fitted(shares, Key::Taper.row().range)?;
        for ((_, limb), base) in limbs().zip(&mut bases) {
            let (mut along, mut square) = (0.0, 0.0);
            for (t, radius) in radii(limb) {
                along += radius * taper.at(t);
                square += taper.at(t) * taper.at(t);
            }
            *base = along / f32::max(square, THINNEST);
        }
        found = Some(taper);
    }
    let taper = found?;
    // At the base it is as thick as it is there.
    let first = taper.at(0.0).max(THINNEST);
    for ((number, limb), base) in limbs().zip(&bases) {
        shapes[number].girth = base * first / limb.bearer_radius.max(THINNEST);
    }
    let (least, most) = Key::Taper.row().range;
    let points: Vec<_> =
        taper.points().iter().map(|&(t, share)| (t, (share / first).clamp(least, most))).collect();
    Function::new(&points).ok()
}

/// The longest internode with which limbs have as many nodes as they have: axes are cut where laterals stand, too.
fn internode<'a>(limbs: impl Iterator<Item = &'a Limb>) -> f32 {
    let (mut gaps, mut count) = (Vec::new(), 0);
    for limb in limbs {
        count += limb.radii.len();
        let mut last = 0.0;
        for place in limb.places.iter().copied().chain([1.0]).filter(|&place| place > 0.0) {
            if place > last {
                gaps.push((place - last) * limb.course());
                last = place;
            }
        }
    }
    let nodes = |internode: f32| -> usize {
        gaps.iter().map(|gap| (gap / internode - 1e-3).ceil().max(1.0) as usize).sum()
    };
    let (mut least, mut most) = Key::Internode.row().range;
    for _ in 0..STEPS_OF_INTERNODE {
        let middle = 0.5 * (least + most);
        *(if nodes(middle) > count { &mut least } else { &mut most }) = middle;
    }
    most
}

/// The zone of places of several limbs that bear so many each.
fn pooled_zone(places: &[f32], laterals: f32) -> (f32, f32) {
    let (Some(&first), Some(&last)) = (places.first(), places.last()) else { return (0.15, 0.95) };
    let gap = (last - first).max(0.02) / (laterals + 1.0);
    ((first - 0.5 * gap).clamp(0.0, 0.98), (last + 0.5 * gap).clamp(0.02, 1.0))
}
