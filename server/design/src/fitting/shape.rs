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
const EXACT: f32 = 0.15;
/// Most nodes that an outline is fitted to.
const MOST_NODES: usize = 4096;
/// Most limbs that an outline is fitted to.
const MOST_RAYS: usize = 128;
/// As far as an outline reaches in its own units.
const ROOMY: f32 = 3.5;
/// An outline is at least this share of a lateral's length from its base.
const NEAR: f32 = 0.4;
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
    pub taper: Option<Function>,
    pub internode: f32,
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
            reach_around(&mut outline, &bases(wood, limb).map(own).collect::<Vec<_>>());
            outline
        });
        let base = limb.radii.first().copied().unwrap_or(1.0).max(1e-4);
        let radii = limb.radii.iter().enumerate().map(|(at, &radius)| (limb.share(at + 1), radius / base));
        Self {
            frame,
            length,
            course,
            outline: outline.filter(|outline| outline.check().is_ok()),
            girth: base / limb.bearer_radius.max(1e-4),
            taper: fitted(radii, Key::Taper.row().range),
            internode: limb.course() / limb.radii.len().max(1) as f32,
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
    pub(super) fn of(wood: &Wood, shapes: &[Shape], order: u8) -> Option<Self> {
        let all: Vec<(&Limb, &Shape)> =
            wood.limbs.iter().zip(shapes).filter(|(limb, _)| limb.order == order).collect();
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
        let steps = |taper: &Function| -> Vec<(f32, f32)> {
            (0..=8u8).map(|step| f32::from(step) / 8.0).map(|t| (t, taper.at(t))).collect()
        };
        let tapers = all.iter().filter_map(|(_, shape)| shape.taper.as_ref()).flat_map(steps);
        Some(Self {
            course,
            axis,
            outline: outline.filter(|outline| outline.check().is_ok()),
            zone,
            laterals,
            girth: median(all.iter().map(|(limb, shape)| (shape.girth, limb.size())).collect())?,
            taper: fitted(tapers, Key::Taper.row().range),
            internode: mean(&|_, shape| shape.internode),
            foliage: mean(&|limb, _| limb.size() / limb.radii.len() as f32),
        })
    }
}

/// The zone of places of several limbs that bear so many each.
fn pooled_zone(places: &[f32], laterals: f32) -> (f32, f32) {
    let (Some(&first), Some(&last)) = (places.first(), places.last()) else { return (0.15, 0.95) };
    let gap = (last - first).max(0.02) / (laterals + 1.0);
    ((first - 0.5 * gap).clamp(0.0, 0.98), (last + 0.5 * gap).clamp(0.02, 1.0))
}
