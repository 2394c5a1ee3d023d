//! A stroke drawn on a trunk, and how growth follows it.

use espalier_plant::MetamerId;
use espalier_proto::{Action, BrushRadius, Position, StrokeSample};
use espalier_session::{Document, Principal};
use glam::Vec3;

use super::shapes;

/// A node must lie this near to the end of a stroke for growth to have arrived.
const ARRIVED: f32 = 2.0;
/// Filled is what has a node this near.
const FILLED: f32 = 2.0;
/// Spilt is what lies this far outside the sweep.
const SPILT: f32 = 1.0;
/// What growth keeps to: fill at least, spill at most. Laterals of a limb that descends turn up out of a narrow sweep before
/// they are bent back, so one form and radius spills more.
const LEAST_FILL: f32 = 0.9;
const MOST_SPILL: f32 = 0.05;
const SPILLS_MORE: (&str, f32, f32) = ("down", 2.0, 0.065);
/// From place to place of a finger that is seen all along its way, in internodes.
const FINE: f32 = 0.5;
/// Points at which the sweep is looked at.
const PROBES: u32 = 4000;

/// How a finger goes, in internodes.
#[derive(Clone, Copy, Debug)]
pub struct Hand {
    /// From place to place that the screen tells of, about; the brush goes straight from one to the other.
    spacing: f32,
    /// From message to message.
    pace: f32,
}

impl Hand {
    /// Seen all along its way.
    pub const SLOW: Self = Self { spacing: FINE, pace: 2.0 };
    /// Seen all along its way, which one message tells as a whole.
    pub const FAST: Self = Self { spacing: FINE, pace: 1000.0 };
    /// As fast over a screen, on which the tree is small: it is seen only here and there.
    pub const SPARSE: Self = Self { spacing: 4.0, pace: 4.0 };

    /// The way that the server is told of.
    pub fn told(self, path: &[Vec3]) -> Vec<Vec3> {
        let fine = resampled(path, FINE);
        let mut told = vec![fine[0]];
        let mut unseen = 0.0;
        for pair in fine.windows(2) {
            unseen += pair[0].distance(pair[1]);
            if self.spacing <= FINE || unseen >= self.spacing || pair[1] == fine[fine.len() - 1] {
                told.push(pair[1]);
                unseen = 0.0;
            }
        }
        told
    }

    /// How many places a message holds.
    fn places(self) -> usize {
        (self.pace / self.spacing).clamp(1.0, 256.0) as usize
    }
}

/// How one stroke was followed.
#[derive(Clone, Copy, Debug)]
pub struct Followed {
    pub arrived: bool,
    /// Share of the sweep.
    pub fill: f32,
    /// Share of the nodes that grew.
    pub spill: f32,
    pub metamers: usize,
}

/// A trunk and one stroke from its top; and how many rows there were before the stroke.
pub fn drawn(mut document: Document, path: &[Vec3], radius: f32, hand: Hand) -> (Document, usize) {
    stroke(&mut document, 1, &[Vec3::ZERO, Vec3::Y * shapes::TRUNK], 0.0, Hand::SLOW);
    let before = document.plant().metamer_count();
    stroke(&mut document, 2, path, radius, hand);
    (document, before)
}

/// Draws one stroke.
pub fn stroke(document: &mut Document, stroke: u32, path: &[Vec3], radius: f32, hand: Hand) {
    let mut act = |action: Action| {
        document.apply(&Principal::visitor(), &action.into()).expect("a stroke can be drawn")
    };
    act(Action::StrokeBegin { stroke, bud: None });
    let sample = |&position: &Vec3| StrokeSample {
        position: Position::nearest(position),
        radius: BrushRadius::nearest(radius),
    };
    // One message holds the places since the last.
    for message in hand.told(path).chunks(hand.places()) {
        let samples: Vec<StrokeSample> = message.iter().map(sample).collect();
        act(Action::StrokeMove { stroke, samples: samples.try_into().expect("not too many") });
    }
    act(Action::StrokeEnd { stroke });
}

/// The ends of living metamers from this one on.
pub fn nodes(document: &Document, from: usize) -> Vec<Vec3> {
    let plant = document.plant();
    let all = (from..plant.metamer_count()).map(MetamerId::new);
    all.filter(|&id| plant.is_alive(id)).map(|id| plant.metamers().end(id)).collect()
}

/// The same path in points so far apart.
fn resampled(path: &[Vec3], spacing: f32) -> Vec<Vec3> {
    let mut points = vec![path[0]];
    for pair in path.windows(2) {
        let count = (pair[0].distance(pair[1]) / spacing).ceil().max(1.0);
        points.extend((1..=count as u32).map(|i| pair[0].lerp(pair[1], i as f32 / count)));
    }
    points
}

impl Followed {
    /// Whether growth followed a stroke of this form and radius as it should.
    pub fn is_good(&self, form: &str, radius: f32) -> bool {
        let spills_more = (form, radius) == (SPILLS_MORE.0, SPILLS_MORE.1);
        let most = if spills_more { SPILLS_MORE.2 } else { MOST_SPILL };
        self.arrived && self.fill >= LEAST_FILL && self.spill <= most
    }

    /// `path` is the way that the server was told of.
    pub fn of(document: &Document, before: usize, path: &[Vec3], radius: f32) -> Self {
        let all = nodes(document, 0);
        let path = resampled(path, 0.25);
        let from_path = |place: Vec3| path.iter().map(|p| p.distance(place)).fold(f32::INFINITY, f32::min);
        let is_near = |place: Vec3, reach: f32| all.iter().any(|node| node.distance(place) <= reach);
        let grown = nodes(document, before);
        let spilt = grown.iter().filter(|&&node| from_path(node) > radius + SPILT).count();
        let (low, high) = path.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| {
            (low.min(p - radius), high.max(p + radius))
        });
        let (mut inside, mut filled, mut i) = (0, 0, 0u32);
        while inside < PROBES {
            i += 1;
            // A sequence that covers the box evenly.
            let share = |base: f64| (f64::from(i) * base).fract() as f32;
            let share = Vec3::new(share(0.819_172_513), share(0.671_043_607), share(0.549_700_478));
            let place = low + (high - low) * share;
            if place.y > 0.5 && from_path(place) <= radius {
                inside += 1;
                filled += u32::from(is_near(place, FILLED));
            }
        }
        Self {
            arrived: is_near(path[path.len() - 1], ARRIVED),
            fill: filled as f32 / PROBES as f32,
            spill: spilt as f32 / grown.len().max(1) as f32,
            metamers: grown.len(),
        }
    }
}
