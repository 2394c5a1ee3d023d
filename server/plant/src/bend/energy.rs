//! The energy of prisms, and the step that Gauss and Newton would take to lower it.
//!
//! A joint costs gap·|a|² + turn·|R₁ - R₂|², where a is how far apart two prisms hold it and R are their
//! rotations, all nine numbers of them: a turn by θ costs 8 sin²(θ/2) about any axis. (With PriMo's faces alone
//! twisting would cost twice what bending does; in wood it costs less.) A prism moves by a shift v and a turn w
//! about its own centre: what stands s from there moves by v + w × s.

use glam::{DMat3, DQuat, DVec3};

use super::{
    chain::{Chain, Place},
    tridiagonal::{Tridiagonal, Vector},
};

/// Where a prism is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Prism {
    pub centre: DVec3,
    pub rotation: DQuat,
}

/// A touch: a node that is pulled somewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pull {
    pub at: Place,
    /// The node at rest.
    pub node: DVec3,
    pub target: DVec3,
    /// Energy of a distance of one internode.
    pub weight: f64,
}

/// How a prism shall move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub shift: DVec3,
    pub turn: DVec3,
}

/// The energy of prisms, with its linear model.
#[derive(Debug)]
pub(super) struct Energy {
    pub value: f64,
    system: Tridiagonal,
}

impl Prism {
    /// Where a place is that is seen from the centre at rest.
    pub fn apply(&self, arm: DVec3) -> DVec3 {
        self.centre + self.rotation * arm
    }

    pub fn moved(&self, shift: DVec3, turn: DVec3) -> Self {
        let angle = turn.length();
        let half = 0.5 * angle;
        // sin x / x is 1 to the last bit there.
        let share = if half < 1e-9 { 0.5 } else { libm::sin(half) / angle };
        let turn = DQuat::from_vec4((share * turn).extend(libm::cos(half)));
        Self { centre: self.centre + shift, rotation: (turn * self.rotation).normalize() }
    }
}

/// The energy alone.
pub(super) fn of(chain: &Chain, pulls: &[Pull], prisms: &[Prism]) -> f64 {
    let mut value = 0.0;
    for (joint, pair) in chain.joints().iter().zip(prisms.windows(2)) {
        let gap = pair[0].apply(joint.below) - pair[1].apply(joint.above);
        value += joint.gap * gap.length_squared() + 8.0 * joint.turn * turned(pair).xyz().length_squared();
    }
    for pull in pulls {
        value += pull.weight * Stance::of(chain, pull, prisms).away.length_squared();
    }
    value
}

impl Energy {
    pub fn new(chain: &Chain, pulls: &[Pull], prisms: &[Prism]) -> Self {
        let mut system = Tridiagonal::new(prisms.len() - 1);
        let mut value = 0.0;
        for (k, (joint, pair)) in chain.joints().iter().zip(prisms.windows(2)).enumerate() {
            let arms = [pair[0].rotation * joint.below, pair[1].rotation * joint.above];
            let gap = pair[0].centre + arms[0] - pair[1].centre - arms[1];
            value += joint.gap * gap.length_squared();
            add_distance(&mut system, k, joint.gap, [1.0, -1.0], arms, gap);
            let turned = turned(pair);
            value += 8.0 * joint.turn * turned.xyz().length_squared();
            add_turn(&mut system, k, joint.turn, turned);
        }
        for pull in pulls {
            let Stance { arms, away } = Stance::of(chain, pull, prisms);
            value += pull.weight * away.length_squared();
            let shares = [1.0 - pull.at.share, pull.at.share];
            add_distance(&mut system, pull.at.prism, pull.weight, shares, arms, away);
        }
        Self { value, system }
    }

    /// How fast the energy rises along a step.
    pub fn slope(&self, step: &[Step]) -> f64 {
        let along = |(step, gradient): (&Step, &Vector)| {
            step.shift.dot(DVec3::from_slice(&gradient[..3]))
                + step.turn.dot(DVec3::from_slice(&gradient[3..]))
        };
        2.0 * step.iter().zip(self.system.gradients()).map(along).sum::<f64>()
    }

    /// How each prism but the first shall move. None if rounding has left the system without a solution.
    pub fn step(&self) -> Option<Vec<Step>> {
        let solution = self.system.solve()?;
        let step = |[vx, vy, vz, wx, wy, wz]: Vector| Step {
            shift: DVec3::new(vx, vy, vz),
            turn: DVec3::new(wx, wy, wz),
        };
        Some(solution.into_iter().map(step).collect())
    }
}

/// How a touched node stands.
struct Stance {
    /// From the centres of the prism below it and of the next one.
    arms: [DVec3; 2],
    /// From its target.
    away: DVec3,
}

impl Stance {
    fn of(chain: &Chain, pull: &Pull, prisms: &[Prism]) -> Self {
        let Place { prism, share } = pull.at;
        let arm = |prism: usize| prisms[prism].rotation * (pull.node - chain.centre(prism));
        let mut arms = [arm(prism), DVec3::ZERO];
        let mut place = prisms[prism].centre + arms[0];
        if share != 0.0 {
            arms[1] = arm(prism + 1);
            place = place.lerp(prisms[prism + 1].centre + arms[1], share);
        }
        Self { arms, away: place - pull.target }
    }
}

/// Adds weight·|r|², where r changes by a share of how the arms of prism `k` and of the next one move.
fn add_distance(
    system: &mut Tridiagonal,
    k: usize,
    weight: f64,
    shares: [f64; 2],
    arms: [DVec3; 2],
    r: DVec3,
) {
    // Unknowns begin with prism 1, for the base stays.
    for (i, (share, arm)) in shares.into_iter().zip(arms).enumerate() {
        if share == 0.0 || k + i == 0 {
            continue;
        }
        system.add_gradient(k + i - 1, weight * share, r, arm.cross(r));
        system.add_square(k + i - 1, weight * share * share, arm);
        // The second derivative where the arm is under tension: it resists turning aside. Gauss and Newton leave it
        // out, and would overshoot in wood that is pulled straight.
        let tension = -weight * share * arm.dot(r);
        if tension > 0.0 {
            system.add_tension(k + i - 1, tension, arm);
        }
    }
    if k > 0 && shares[1] != 0.0 {
        system.add_product(k, weight * shares[0] * shares[1], arms);
    }
}

/// Adds weight·|R₁ - R₂|² of the rotations of prism `k` and the next one.
fn add_turn(system: &mut Tridiagonal, k: usize, weight: f64, turned: DQuat) {
    let pull = -4.0 * weight * turned.w * turned.xyz();
    let product = DMat3::from_quat(turned);
    let trace = product.x_axis.x + product.y_axis.y + product.z_axis.z;
    if k > 0 {
        system.add_gradient(k - 1, 1.0, DVec3::ZERO, -pull);
        system.add_turn_square(k - 1, 2.0 * weight);
        system.add_turn_product(k, weight, product - DMat3::from_diagonal(DVec3::splat(trace)));
    }
    system.add_gradient(k, 1.0, DVec3::ZERO, pull);
    system.add_turn_square(k, 2.0 * weight);
}

/// The rotation that leads from the upper one of two prisms to the lower.
fn turned(pair: &[Prism]) -> DQuat {
    pair[0].rotation * pair[1].rotation.conjugate()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::bend::reach;

    /// A wound path and a touch at its end and between, with each prism moved a little by some amount.
    fn disturbed(amount: f64) -> (Chain, Vec<Pull>, Vec<Prism>) {
        let node = |i: usize| Vec3::new(libm::sinf(0.5 * i as f32), i as f32, libm::cosf(0.3 * i as f32));
        let nodes: Vec<Vec3> = (0..=12).map(node).collect();
        let chain = Chain::new(&nodes, &[0.2; 12], 0.5);
        let pulls = reach::pulls(&chain, &[(6, chain.node(7)), (11, chain.node(12))]);
        let mut prisms = chain.rest();
        for (prism, step) in prisms[1..].iter_mut().zip(steps(amount)) {
            *prism = prism.moved(step.shift, step.turn);
        }
        (chain, pulls, prisms)
    }

    /// A different step for each prism.
    fn steps(amount: f64) -> Vec<Step> {
        let wave = |i: usize, phase: f64| amount * libm::sin(1.7 * i as f64 + phase);
        let vector =
            |i: usize, phase: f64| DVec3::new(wave(i, phase), wave(i, phase + 1.0), wave(i, phase + 2.5));
        (0..11).map(|i| Step { shift: vector(i, 0.0), turn: vector(i, 4.0) }).collect()
    }

    #[test]
    fn the_slope_is_that_of_the_energy() {
        let (chain, pulls, prisms) = disturbed(0.3);
        let steps = steps(1.0);
        let after = |share: f64| {
            let mut prisms = prisms.clone();
            for (prism, step) in prisms[1..].iter_mut().zip(&steps) {
                *prism = prism.moved(share * step.shift, share * step.turn);
            }
            of(&chain, &pulls, &prisms)
        };
        let slope = Energy::new(&chain, &pulls, &prisms).slope(&steps);
        let measured = (after(1e-5) - after(-1e-5)) / 2e-5;
        assert!((slope - measured).abs() < 1e-7 * measured.abs(), "{slope} {measured}");
    }

    #[test]
    fn one_step_undoes_what_is_small() {
        let (chain, pulls, mut prisms) = disturbed(1e-4);
        let before = Energy::new(&chain, &pulls, &prisms);
        for (prism, step) in prisms[1..].iter_mut().zip(before.step().expect("nothing is singular")) {
            *prism = prism.moved(step.shift, step.turn);
        }
        // The rest is of the fourth order in what was small; a model with a wrong number in it leaves more.
        let left = of(&chain, &pulls, &prisms) / before.value;
        assert!(left < 1e-6, "{left}");
    }
}
