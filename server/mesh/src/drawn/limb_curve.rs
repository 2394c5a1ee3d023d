//! One limb as it is drawn: a curve that wood as thick as this can follow without folding through itself.
//!
//! Clients fit the same curve (`client/src/scene/table/limb-curve.ts`), with the same constants; `golden/course.json` holds
//! the two together. Each node moves to where a local linear regression over a window around it has it (W. Cleveland,
//! 1979): straight wood stays where it is, however uneven its internodes are. Both ends are mirrored, so that they stay
//! too. Windows grow only where the wood would fold.

use glam::DVec3;

/// How wide the window of the fit is where nothing asks for more, in radii, and at most.
const NARROWEST: f64 = 0.9;
const WIDEST: f64 = 3.6;
const WIDENS: f64 = 1.35;
/// Windows of neighbours differ by at most so much for each radius between them.
const EVEN: f64 = 0.8;
const ROUNDS: u32 = 7;
/// Corners that are left are eased in at most so many sweeps.
const EASED: u32 = 16;
/// Curvature times radius from which wood comes near to folding: at 1 its rings meet.
const TIGHT: f64 = 0.65;
/// A node stays so many of its radii within what is drawn around it.
const FARTHEST: f64 = 0.75;
/// Rings are turned evenly in at most so many sweeps.
const SWEEPS: u32 = 24;
/// A limb is at home so many radii of its bearer after it begins.
const CARRIED: f64 = 3.0;
/// Wood thinner than this, in internodes beside it, cannot fold.
const THIN: f64 = 0.3;
/// How much more upright than its first internode a trunk stands where it comes out of the ground.
pub(crate) const RISES: f64 = 1.2;
const SHORTEST: f64 = 1e-6;

/// Whoever uses it pushes the nodes, the first of which is where the limb begins; `fit` then has places and directions.
#[derive(Debug, Default)]
pub(super) struct LimbCurve {
    /// Each node, moved along with its bearer.
    given: Vec<DVec3>,
    /// How thick the wood is there, with whatever spreads at its foot.
    pub(super) radii: Vec<f64>,
    /// Where each node is drawn.
    pub(super) places: Vec<DVec3>,
    /// Which way its ring looks.
    pub(super) directions: Vec<DVec3>,
    /// Lengths along the nodes.
    along: Vec<f64>,
    windows: Vec<f64>,
    tried: Vec<f64>,
    best: Vec<DVec3>,
    tightness: Vec<f64>,
    halves: Vec<f64>,
    cells: Vec<f64>,
}

impl LimbCurve {
    /// Forgets the limb, but not its room.
    pub(super) fn clear(&mut self) {
        self.given.clear();
        self.radii.clear();
    }

    /// The next node.
    pub(super) fn push(&mut self, place: DVec3, radius: f64) {
        self.given.push(place);
        self.radii.push(radius);
    }

    /// Lengths along the nodes, the first of which is 0.
    pub(super) fn measure(&mut self) -> &[f64] {
        self.along.clear();
        self.along.push(0.0);
        for i in 1..self.given.len() {
            self.along.push(self.along[i - 1] + distance(&self.given, i - 1, i));
        }
        &self.along
    }

    /// Fits the curve. The limb begins `offset` away from its first node, where its bearer is drawn, which is so thick;
    /// `rises` says that it grows from the ground, and `rounded` whether wood may leave its nodes at all.
    pub(super) fn fit(&mut self, offset: DVec3, bearer: f64, rises: bool, rounded: bool) {
        self.measure();
        self.carry(offset, bearer);
        self.places.clone_from(&self.given);
        let stout = rounded && self.is_stout();
        if stout {
            self.round();
        }
        self.direct(rises, stout);
    }

    /// Nodes but the first.
    fn count(&self) -> usize {
        self.given.len() - 1
    }

    fn carry(&mut self, offset: DVec3, bearer: f64) {
        if offset == DVec3::ZERO {
            return;
        }
        let reach = CARRIED * bearer;
        for (i, (place, &along)) in self.given.iter_mut().zip(&self.along).enumerate() {
            if along > reach {
                break;
            }
            let t = if reach > 0.0 { along / reach } else { 1.0 };
            let share = if i == 0 { 1.0 } else { 1.0 - t * t * (3.0 - 2.0 * t) };
            *place += share * offset;
        }
    }

    fn is_stout(&self) -> bool {
        let (along, radii) = (&self.along, &self.radii);
        (1..radii.len()).any(|i| radii[i].max(radii[i - 1]) > THIN * (along[i] - along[i - 1]))
    }

    /// Moves nodes until wood folds nowhere, or no further round helps.
    fn round(&mut self) {
        let count = self.count();
        self.sample();
        self.windows.clear();
        self.windows.resize(count + 1, NARROWEST);
        self.tightness.clear();
        self.tightness.resize(count + 1, 0.0);
        for i in 1..count {
            self.shift(i);
        }
        let mut least = self.tighten();
        self.best.clone_from(&self.places);
        for _ in 1..ROUNDS {
            if least <= 0.0 {
                break;
            }
            self.widen();
            let mut any = false;
            for i in 1..count {
                if self.tried[i] != self.windows[i] {
                    any = true;
                    self.windows[i] = self.tried[i];
                    self.shift(i);
                }
            }
            if !any {
                break;
            }
            let much = self.tighten();
            // A turn too sharp for wood as short as this only spreads.
            if much < least {
                least = much;
                self.best.clone_from(&self.places);
            }
        }
        self.places.clone_from(&self.best);
        least = self.tighten();
        for _ in 0..EASED {
            if least <= 0.0 {
                break;
            }
            for i in 1..count {
                if self.tightness[i] > TIGHT {
                    self.ease(i);
                }
            }
            let much = self.tighten();
            if much >= least {
                self.places.clone_from(&self.best);
                return;
            }
            least = much;
            self.best.clone_from(&self.places);
        }
    }

    /// Moves a node half way to the line between its neighbours, as far as it may go.
    fn ease(&mut self, node: usize) {
        let places = &self.places;
        let (before, after) = (distance(places, node - 1, node), distance(places, node, node + 1));
        let share = before / (before + after).max(1e-9);
        let line = places[node - 1] + share * (places[node + 1] - places[node - 1]);
        let place = 0.5 * (places[node] + line);
        let most = FARTHEST * self.radii[node];
        if (place - self.given[node]).length_squared() <= most * most {
            self.places[node] = place;
        }
    }

    /// Chooses windows for the next round: wider where it is tight, and next to that.
    fn widen(&mut self) {
        let count = self.count();
        self.tried.clear();
        for i in 0..=count {
            let is_wider = i > 0 && i < count && self.tightness[i] > TIGHT;
            let window = self.windows[i];
            self.tried.push(if is_wider { WIDEST.min(WIDENS * window) } else { window });
        }
        for i in 1..=count {
            self.follow(i, i - 1, self.along[i] - self.along[i - 1]);
        }
        for i in (0..count).rev() {
            self.follow(i, i + 1, self.along[i + 1] - self.along[i]);
        }
    }

    fn follow(&mut self, i: usize, neighbour: usize, apart: f64) {
        let least = self.tried[neighbour] - (EVEN * apart) / self.radii[i].max(1e-6);
        if least > self.tried[i] {
            self.tried[i] = least;
        }
    }

    /// How tightly wood bends at each node: curvature times radius. Gives how much of it is too much.
    fn tighten(&mut self) -> f64 {
        let places = &self.places;
        let mut much = 0.0;
        for i in 1..self.count() {
            let (a, b) = (distance(places, i - 1, i), distance(places, i, i + 1));
            let along = (places[i] - places[i - 1]).dot(places[i + 1] - places[i]);
            let turn = libm::acos((along / (a * b).max(1e-12)).clamp(-1.0, 1.0));
            self.tightness[i] = (turn * self.radii[i]) / (0.5 * (a + b)).max(1e-6);
            let over = (self.tightness[i] - TIGHT).max(0.0);
            much += over * over;
        }
        much
    }

    /// Nodes and the middles between them, each with the length of wood that it stands for.
    fn sample(&mut self) {
        let (along, last) = (&self.along, 2 * self.count());
        self.halves.clear();
        self.halves.extend((0..=last).map(|half| 0.5 * (along[half >> 1] + along[(half + 1) >> 1])));
        self.cells.clear();
        for half in 0..=last {
            // An end is mirrored, and stands for as much beyond.
            let halves = &self.halves;
            let before = if half > 0 { halves[half] - halves[half - 1] } else { halves[1] };
            let after = if half < last { halves[half + 1] - halves[half] } else { before };
            self.cells.push(0.5 * (before + after));
        }
    }

    /// Puts a node where the fit over its window has it.
    fn shift(&mut self, node: usize) {
        let Self { given, halves, cells, .. } = self;
        let reach = self.windows[node] * self.radii[node];
        let last = 2 * (given.len() as isize - 1);
        let middle = halves[2 * node];
        let (mut w0, mut w1, mut w2) = (cells[2 * node], 0.0, 0.0);
        let (mut even, mut odd) = (DVec3::ZERO, DVec3::ZERO);
        for step in [-1, 1] {
            let mut half = 2 * node as isize + step;
            loop {
                let over = if half < 0 {
                    -half
                } else if half > last {
                    2 * last - half
                } else {
                    half
                };
                if over < 0 || over > last {
                    break;
                }
                let pinned = if half < 0 { 0 } else { last as usize };
                let (is_mirrored, at) = (over != half, over as usize);
                let reached = if is_mirrored { 2.0 * halves[pinned] - halves[at] } else { halves[at] };
                let away = reached - middle;
                let near = 1.0 - (away / reach) * (away / reach);
                // Also where nothing is within reach.
                if near <= 0.0 || near.is_nan() {
                    break;
                }
                let weight = near * near * cells[at];
                w0 += weight;
                w1 += weight * away;
                w2 += weight * away * away;
                let x = 0.5 * (given[at >> 1] + given[(at + 1) >> 1]);
                let place = if is_mirrored { 2.0 * given[pinned >> 1] - x } else { x } - given[node];
                even += weight * place;
                odd += weight * away * place;
                half += step;
            }
        }
        let determinant = w0 * w2 - w1 * w1;
        let way = if determinant > 1e-9 * w0 * w0 * reach * reach {
            (w2 * even - w1 * odd) / determinant
        } else {
            DVec3::ZERO
        };
        let squared = way.length_squared();
        // What has nothing in its window stays to the last bit.
        let most = FARTHEST * self.radii[node];
        let excess = squared / (most * most);
        self.places[node] = if squared > 0.0 {
            let share = 1.0 / (1.0 + excess * excess).sqrt().sqrt();
            given[node] + share * way
        } else {
            given[node]
        };
    }

    /// Rings lie across the way, and turn from node to node by no more than keeps them apart.
    fn direct(&mut self, rises: bool, stout: bool) {
        let count = self.count();
        let places = &self.places;
        self.directions.clear();
        for i in 0..=count {
            let before = if i > 0 { direction(places, i - 1, i) } else { DVec3::ZERO };
            let after = if i < count { direction(places, i, i + 1) } else { DVec3::ZERO };
            // An axis that doubles back on itself has no mean direction; it keeps the incoming one.
            let kept = if i > 0 { before } else { DVec3::Y };
            self.directions.push(unit(before + after).unwrap_or(kept));
        }
        if rises {
            let first = &mut self.directions[0];
            first.y += RISES * first.y.max(0.0);
            *first = unit(*first).unwrap_or(*first);
        }
        if !stout {
            return;
        }
        // Where a limb leaves its bearer, its first ring is drawn otherwise.
        let first = usize::from(!rises);
        for _ in 0..SWEEPS {
            let mut any = false;
            for i in first..count {
                let along = self.directions[i].dot(self.directions[i + 1]);
                let turn = libm::acos(along.clamp(-1.0, 1.0));
                let room = TIGHT * distance(&self.places, i, i + 1);
                if 0.5 * turn * (self.radii[i] + self.radii[i + 1]) <= room {
                    continue;
                }
                any = true;
                if i > first {
                    self.even(i, first);
                }
                self.even(i + 1, first);
            }
            if !any {
                return;
            }
        }
    }

    fn even(&mut self, i: usize, first: usize) {
        let none = DVec3::ZERO;
        let before = if i > first { self.directions[i - 1] } else { none };
        let after = if i < self.count() { self.directions[i + 1] } else { none };
        let sum = self.directions[i] + before + after;
        self.directions[i] = unit(sum).unwrap_or(sum);
    }
}

fn distance(of: &[DVec3], a: usize, b: usize) -> f64 {
    of[b].distance(of[a])
}

fn direction(of: &[DVec3], from: usize, to: usize) -> DVec3 {
    unit(of[to] - of[from]).unwrap_or(DVec3::ZERO)
}

fn unit(way: DVec3) -> Option<DVec3> {
    let length = way.length();
    (length >= SHORTEST).then(|| way / length)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;

    fn fitted(nodes: &[DVec3], radius: f64) -> LimbCurve {
        let mut curve = LimbCurve::default();
        for &node in nodes {
            curve.push(node, radius);
        }
        curve.fit(DVec3::ZERO, 0.0, false, true);
        curve
    }

    /// Curvature times radius, where it is most.
    fn tightest(curve: &mut LimbCurve) -> f64 {
        curve.tightness.resize(curve.count() + 1, 0.0);
        curve.tighten();
        let last = curve.count();
        curve.tightness[1..last].iter().copied().fold(0.0, f64::max)
    }

    /// A limb of internodes that turn by so much, each about an axis of its own.
    fn wandering() -> impl Strategy<Value = (Vec<DVec3>, f64)> {
        let turns = prop::collection::vec((0.7f64..1.3, 0.0..TAU, 0.0f64..1.0), 4..28);
        (turns, 0.3f64..4.0).prop_map(|(turns, radius)| {
            let (mut nodes, mut heading) = (vec![DVec3::ZERO], DVec3::Y);
            for (length, around, by) in turns {
                nodes.push(nodes[nodes.len() - 1] + length * heading);
                // The thicker wood is, the longer it takes to turn by as much.
                let by = by * (1.1 / radius).min(1.4);
                let (side, other) = heading.any_orthonormal_pair();
                let out = libm::cos(around) * side + libm::sin(around) * other;
                heading = (libm::cos(by) * heading + libm::sin(by) * out).normalize();
            }
            (nodes, radius)
        })
    }

    proptest! {
        #[test]
        fn crooked_wood_folds_nowhere_and_stays_near_its_nodes((nodes, radius) in wandering()) {
            let mut curve = fitted(&nodes, radius);
            prop_assert!(tightest(&mut curve) < 1.6);
            for (place, node) in curve.places.iter().zip(&nodes) {
                prop_assert!(place.distance(*node) <= 0.75 * radius + 1e-9);
            }
            prop_assert_eq!(curve.places[0], nodes[0]);
            prop_assert_eq!(curve.places.last(), nodes.last());
            for direction in &curve.directions {
                prop_assert!((direction.length() - 1.0).abs() < 1e-9);
            }
        }

        #[test]
        fn thin_wood_stays_to_the_last_bit((nodes, _) in wandering()) {
            prop_assert_eq!(&fitted(&nodes, 0.2).places, &nodes);
        }
    }

    #[test]
    fn straight_and_evenly_bent_wood_hardly_moves() {
        let line: Vec<DVec3> =
            [0.0, 1.0, 1.3, 2.6, 3.0, 4.4, 5.0, 6.0].map(|y| y * DVec3::new(0.2, 1.0, -0.1)).into();
        let straight = fitted(&line, 2.0);
        assert!(straight.places.iter().zip(&line).all(|(place, node)| place.distance(*node) < 1e-9));
        let (radius, bend) = (2.0, 6.0);
        let arc: Vec<DVec3> = (0..20)
            .map(|i| f64::from(i) / bend)
            .map(|turn| bend * DVec3::new(1.0 - libm::cos(turn), libm::sin(turn), 0.0))
            .collect();
        let bent = fitted(&arc, radius);
        assert!((3..17).all(|i| bent.places[i].distance(arc[i]) < 0.03 * radius));
    }

    #[test]
    fn a_corner_is_taken_over_more_than_a_radius_and_a_half() {
        let up = (0..=20).map(|i| DVec3::Y * f64::from(i));
        let aside = (1..=20).map(|i| DVec3::new(f64::from(i), 20.0, 0.0));
        let nodes: Vec<DVec3> = up.chain(aside).collect();
        for radius in [0.6, 1.0, 2.0, 4.0] {
            let tight = tightest(&mut fitted(&nodes, radius));
            assert!(tight < 0.95, "{tight} at {radius}");
        }
    }

    #[test]
    fn a_limb_begins_where_its_bearer_is_drawn_and_comes_home() {
        let mut curve = LimbCurve::default();
        for i in 0..9 {
            curve.push(DVec3::X * f64::from(i), 0.1);
        }
        curve.fit(0.5 * DVec3::Y, 1.5, false, true);
        let heights: Vec<f64> = curve.places.iter().map(|place| place.y).collect();
        assert_eq!(heights[0], 0.5);
        assert!(heights[..5].is_sorted_by(|a, b| a > b));
        assert_eq!(heights[5..], [0.0; 4]);
    }
}
