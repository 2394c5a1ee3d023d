//! Bending and stretching a branch by a few touches (TreeSketch §3.3; PriMo, Botsch et al. 2006).
//!
//! The path from the base internode to the end of the branch is a chain of rigid prisms with elastic joints.
//! Touches pull at nodes, and the prisms go where their energy is least. They start from where they were, but
//! the energy knows only the rest shape: wherever the touches have been, brought back they bring the branch
//! back.

mod chain;
mod energy;
mod reach;
mod state;
mod tridiagonal;

use glam::{DQuat, DVec3, Quat, Vec3};

pub use self::state::BendState;
use self::{
    chain::{Chain, Place},
    energy::{Energy, Prism, Pull, Step},
};
use crate::motion::Motion;

/// Steps of the solver for one event of a pointer.
const STEPS_OF_AN_EVENT: u32 = 4;
/// The most steps when the touches are lifted.
const STEPS_OF_REST: u32 = 60;
/// The solver rests when nothing moves farther than this share of the branch's length.
const TOLERANCE: f64 = 1e-7;
/// How often a step is tried; each time that it raises the energy it is shortened.
const TRIES: u32 = 5;
/// How far a step may turn a prism: a linear model says nothing about more.
const MOST_TURN: f64 = 1.0;
/// What is nearer to rest than this, as a share of the length or in radians, is at rest.
const REST: f64 = 1e-7;

/// A branch that is being bent.
#[derive(Clone, Debug)]
pub struct Bend {
    chain: Chain,
    prisms: Vec<Prism>,
    /// Touched nodes with where each is pulled, from the base upwards.
    targets: Vec<(usize, DVec3)>,
}

impl Bend {
    /// The path whose internode `i` goes from `nodes[i]` to `nodes[i + 1]` and has radius `radii[i]`, at rest.
    /// Internode 0 never moves. `stretch` goes from 0, stiff in length, to 1, like rubber.
    ///
    /// # Panics
    /// If there is not one node more than there are radii, or no radius.
    pub fn new(nodes: &[Vec3], radii: &[f32], stretch: f32) -> Self {
        let chain = Chain::new(nodes, radii, stretch);
        let prisms = chain.rest();
        Self { chain, prisms, targets: Vec::new() }
    }

    /// One event of a pointer: pulls the far ends of these internodes of the path to these places. Touches that
    /// are not named are lifted. A place that is no number leaves its touch where it was.
    pub fn drag(&mut self, targets: &[(usize, Vec3)]) {
        let mut wanted: Vec<(usize, DVec3)> = Vec::with_capacity(targets.len());
        for &(internode, place) in targets {
            if internode == 0 || internode >= self.chain.internodes() {
                continue;
            }
            let before = || self.targets.iter().find(|before| before.0 == internode).map(|before| before.1);
            let place = if place.is_finite() { Some(place.as_dvec3()) } else { before() };
            let Some(place) = place else { continue };
            match wanted.binary_search_by_key(&internode, |touch| touch.0) {
                Ok(at) => wanted[at].1 = place,
                Err(at) => wanted.insert(at, (internode, place)),
            }
        }
        self.targets = wanted;
        self.solve(STEPS_OF_AN_EVENT);
    }

    /// Brings the branch to rest under the touches of the last event, as they are lifted.
    pub fn relax(&mut self) {
        self.solve(STEPS_OF_REST);
    }

    /// Whether each touch of the last event is back where it took hold, as nearly in each coordinate as `within`.
    pub fn is_brought_back(&self, within: f32) -> bool {
        let is_back = |&(internode, target): &(usize, DVec3)| {
            (target - self.chain.node(internode + 1)).abs().max_element() <= f64::from(within)
        };
        self.targets.iter().all(is_back)
    }

    /// How each internode of the path has moved: turned as its prism is, about its far end.
    pub fn motions(&self) -> Vec<Motion> {
        (0..self.chain.internodes()).map(|internode| self.motion(internode)).collect()
    }

    /// The elastic energy with that of the touches' springs, in units of what doubles the branch's length.
    pub fn energy(&self) -> f64 {
        energy::of(&self.chain, &self.pulls(), &self.prisms)
    }

    fn motion(&self, internode: usize) -> Motion {
        let from = self.chain.node(internode + 1);
        let end = self.chain.end(internode);
        let to = self.place(end, from);
        let to = if to.distance(from) < REST * self.chain.length() { from } else { to };
        let Place { prism, share } = self.chain.middle(internode);
        let (rotation, next) = (self.prisms[prism].rotation, self.prisms.get(prism + 1));
        let rotation = next.map_or(rotation, |next| between(rotation, next.rotation, share));
        let turned = 2.0 * rotation.xyz().length();
        let rotation = if turned < REST { Quat::IDENTITY } else { rotation.as_quat().normalize() };
        Motion { rotation, from: from.as_vec3(), to: to.as_vec3() }
    }

    /// Where a node of the rest shape is now.
    fn place(&self, at: Place, node: DVec3) -> DVec3 {
        let moved = |prism: usize| self.prisms[prism].apply(node - self.chain.centre(prism));
        if at.share == 0.0 { moved(at.prism) } else { moved(at.prism).lerp(moved(at.prism + 1), at.share) }
    }

    fn pulls(&self) -> Vec<Pull> {
        reach::pulls(&self.chain, &self.targets)
    }

    fn solve(&mut self, steps: u32) {
        if self.prisms.len() < 2 {
            return;
        }
        let pulls = self.pulls();
        self.leave_a_worse_shape_than_rest(&pulls);
        let mut now = Energy::new(&self.chain, &pulls, &self.prisms);
        for _ in 0..steps {
            let Some(step) = now.step() else { break };
            let Some((energy, prisms)) = self.descend(&pulls, &now, &step) else { break };
            (now, self.prisms) = (energy, prisms);
            let is_small = |step: &Step| {
                step.turn.length() < TOLERANCE && step.shift.length() < TOLERANCE * self.chain.length()
            };
            if step.iter().all(is_small) {
                break;
            }
        }
    }

    /// As much of a step as lowers the energy. None if nothing is to be gained any more.
    fn descend(&self, pulls: &[Pull], now: &Energy, step: &[Step]) -> Option<(Energy, Vec<Prism>)> {
        let slope = now.slope(step);
        let turn = step.iter().map(|step| step.turn.length()).fold(0.0, f64::max);
        let mut share = if turn > MOST_TURN { MOST_TURN / turn } else { 1.0 };
        for _ in 0..TRIES {
            let mut prisms = self.prisms.clone();
            for (prism, step) in prisms[1..].iter_mut().zip(step) {
                *prism = prism.moved(share * step.shift, share * step.turn);
            }
            let energy = Energy::new(&self.chain, pulls, &prisms);
            if energy.value <= now.value {
                return Some((energy, prisms));
            }
            // The lowest point of the parabola through both energies that starts with this slope.
            let beyond_line = energy.value - now.value - share * slope;
            share *= (-0.5 * share * slope / beyond_line).clamp(0.1, 0.5);
        }
        None
    }

    /// A branch led all around its base may be left with a loop in it. Where rest would be nearer to what is
    /// asked for than that, it goes on from rest.
    fn leave_a_worse_shape_than_rest(&mut self, pulls: &[Pull]) {
        let rest = self.chain.rest();
        let energy = |prisms: &[Prism]| energy::of(&self.chain, pulls, prisms);
        if energy(&rest) < energy(&self.prisms) {
            self.prisms = rest;
        }
    }
}

/// The shortest turn from one rotation to another, a share of the way; chords serve for the small angles of joints.
fn between(from: DQuat, to: DQuat, share: f64) -> DQuat {
    if share == 0.0 {
        return from;
    }
    let to = if from.dot(to) < 0.0 { -to } else { to };
    (from * (1.0 - share) + to * share).normalize()
}
