//! A plant as jointed rigid bodies, stepped through time: what the closed form is held to, and what gusts can be made
//! with that bend wood further than it allows.
//!
//! Reduced coordinates, one ball joint a row, in two backward and forward passes of Featherstone's articulated bodies, so
//! the coupling of branches is exact and a step costs O(rows). Springs are implicit, with a share θ of the step ahead:
//! stiff twigs need no small steps. Gravity is left out, because the modelled pose is where it is in balance.

mod articulated;
mod spring;

use glam::{DMat3, DQuat, DVec3};

use self::{articulated::Articulated, spring::Spring};
use crate::{NONE, wood::Wood};

/// How far ahead springs are taken, as a share of the step. From 0.5 on springs are stable by themselves, but spinning
/// bodies are not: at 0.5 energy grows without bound. Above, a mode of ω is damped by (θ − ½) ω Δt.
pub const AHEAD: f64 = 0.55;

/// What joints are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joinery {
    /// How much softer the wood is than uncalibrated ([`crate::Joint::softness`]).
    pub softness: f64,
    /// Damping moment for a rate of turning as a share of the moment for a turn, s: 2ζ/ω damps a mode of ω by ζ.
    pub damping: f64,
    /// θ, usually [`AHEAD`]; 1 settles soonest.
    pub ahead: f64,
}

/// What lets a row bend in its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// How far it turns under a moment of 1 Nm, radians.
    pub softness: f64,
    /// As [`Joinery::damping`], s.
    pub damping: f64,
}

/// One body. It is jointed in the middle of its row, and reaches from there to the middles of the next rows that have
/// hinges: turns between middles are exact where moments are even.
#[derive(Clone, Copy, Debug)]
struct Body {
    row: u32,
    /// The body below; [`NONE`] for the ground.
    parent: u32,
    /// Its joint at rest, m.
    rest: DVec3,
    /// From the joint of the body below to its own, at rest, m; for the first from the origin.
    arm: DVec3,
    mass: f64,
    /// From the joint to its centre of mass, at rest, m.
    centre: DVec3,
    /// About the joint, at rest, kg m².
    inertia: DMat3,
    spring: Spring,
    /// As [`Joinery::damping`], s.
    damping: f64,
    /// How it has turned against the body below, in the frame of that at rest.
    turn: DQuat,
    /// How fast it turns against the body below, in the same frame, s⁻¹.
    rate: DVec3,
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, Default)]
struct Motion {
    turn: DQuat,
    joint: DVec3,
    /// Angular velocity.
    spin: DVec3,
    /// Velocity of the joint.
    velocity: DVec3,
}

/// Where a force acts.
#[derive(Clone, Copy, Debug)]
struct Hold {
    body: u32,
    /// From the body's joint, at rest, m.
    at: DVec3,
    /// Which force it is, and how many times it acts.
    force: u32,
    share: f64,
}

/// What the forces on one body have in common once they are gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered {
    /// Where they act on average, at rest, m.
    pub centre: DVec3,
    /// The mean of some value of its rows.
    pub mean: f64,
}

/// All bodies, each after the one it stands on.
#[derive(Clone, Debug)]
pub struct Bodies {
    ahead: f64,
    bodies: Vec<Body>,
    /// The body that has each row's node; [`NONE`] for the ground.
    of_row: Vec<u32>,
    /// Where each row's node is at rest, m.
    places: Vec<DVec3>,
    holds: Vec<Hold>,
    motions: Vec<Motion>,
    work: Vec<Articulated>,
    /// Turns and rates at the beginning of a step.
    begin: Vec<(DQuat, DVec3)>,
    /// How rates change, s⁻².
    gains: Vec<DVec3>,
}

impl Bodies {
    /// At rest, with a body for each row that has a length.
    pub fn of(wood: &Wood, joinery: Joinery) -> Self {
        let hinge = |row: u32| {
            Some(Hinge { softness: joinery.softness * wood.softness(row as usize), damping: joinery.damping })
        };
        Self::hinged(wood, joinery.ahead, hinge)
    }

    /// At rest, with a body for each row that has a length and a hinge; the others are rigid parts of what they stand on.
    pub fn hinged(wood: &Wood, ahead: f64, hinge: impl Fn(u32) -> Option<Hinge>) -> Self {
        let mut of_row = vec![NONE; wood.len()];
        let mut bodies: Vec<Body> = Vec::new();
        let mut holds = Vec::new();
        for row in (0..wood.len()).filter(|&row| wood.parent[row] != NONE) {
            let below = of_row[wood.parent[row] as usize];
            of_row[row] = below;
            if wood.length[row] <= 0.0 {
                continue;
            }
            let (way, middle) = (wood.way(row), wood.middle(row));
            if let Some(hinge) = hinge(row as u32).filter(|hinge| hinge.softness > 0.0) {
                of_row[row] = bodies.len() as u32;
                let rest = bodies.get(below as usize).map_or(DVec3::ZERO, |body| body.rest);
                bodies.push(Body {
                    row: row as u32,
                    parent: below,
                    rest: middle,
                    arm: middle - rest,
                    mass: 0.0,
                    centre: DVec3::ZERO,
                    inertia: DMat3::ZERO,
                    spring: Spring::of(way / wood.length[row], 1.0 / hinge.softness),
                    damping: hinge.damping,
                    turn: DQuat::IDENTITY,
                    rate: DVec3::ZERO,
                });
            }
            // Half of it beyond the hinge, half before.
            for (body, place) in [(below, middle - 0.25 * way), (of_row[row], middle + 0.25 * way)] {
                let Some(carrier) = bodies.get_mut(body as usize) else { continue };
                let at = place - carrier.rest;
                carrier.carry(wood, row, at);
                holds.push(Hold { body, at, force: row as u32, share: 0.5 });
            }
        }
        for body in &mut bodies {
            body.centre /= body.mass;
        }
        let mut all = Self {
            ahead,
            motions: vec![Motion::default(); bodies.len()],
            work: vec![Articulated::default(); bodies.len()],
            begin: Vec::new(),
            gains: vec![DVec3::ZERO; bodies.len()],
            bodies,
            of_row,
            places: wood.place.clone(),
            holds,
        };
        all.find_motions();
        all
    }

    /// From now on forces are told by body instead of by row, each to be multiplied by the weights of all that the body
    /// carries. Returns where each acts, and the mean of some values of rows, by weight.
    pub fn gather(&mut self, weights: &[f64], values: &[f64]) -> Vec<Gathered> {
        let mut sums = vec![(0.0, DVec3::ZERO, 0.0); self.bodies.len()];
        for hold in &self.holds {
            let weight = hold.share * weights[hold.force as usize];
            let (whole, place, value) = &mut sums[hold.body as usize];
            *whole += weight;
            *place += weight * hold.at;
            *value += weight * values[hold.force as usize];
        }
        self.holds.clear();
        let mut gathered = Vec::with_capacity(sums.len());
        for (at, (whole, place, value)) in sums.into_iter().enumerate() {
            let (place, mean) = if whole > 0.0 { (place / whole, value / whole) } else { (DVec3::ZERO, 0.0) };
            self.holds.push(Hold { body: at as u32, at: place, force: at as u32, share: whole });
            gathered.push(Gathered { centre: self.bodies[at].rest + place, mean });
        }
        gathered
    }

    /// How fast the place moves where the gathered forces of a body act, m/s.
    pub fn speed(&self, body: u32) -> DVec3 {
        let (motion, hold) = (self.motions[body as usize], self.holds[body as usize]);
        motion.velocity + motion.spin.cross(motion.turn * hold.at)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.bodies.len()
    }

    /// Sets how fast the body of each row turns against the one below, s⁻¹.
    pub fn throw(&mut self, mut rate: impl FnMut(u32) -> DVec3) {
        self.bodies.iter_mut().for_each(|body| body.rate = rate(body.row));
        self.find_motions();
    }

    /// From now on joints are like this, in damping and in how far ahead they are taken.
    pub fn let_go(&mut self, joinery: Joinery) {
        self.ahead = joinery.ahead;
        self.bodies.iter_mut().for_each(|body| body.damping = joinery.damping);
    }

    /// One step of `time` seconds under forces in newtons, by row unless they are [gathered](Self::gather). The little
    /// energy that [a step by itself](Self::step_freely) makes where bodies spin fast is taken from all rates alike, so that
    /// no plant can tear itself apart; returns how much that was, in J.
    pub fn step(&mut self, time: f64, forces: &[DVec3]) -> f64 {
        let (kinetic, stored) = self.energies();
        let allowed = kinetic + stored - self.work_of(forces);
        self.step_freely(time, forces);
        let (kinetic, stored) = self.energies();
        let allowed = allowed + self.work_of(forces);
        let too_much = kinetic + stored - allowed;
        if too_much <= 0.0 || kinetic == 0.0 {
            return 0.0;
        }
        let kept = ((kinetic - too_much) / kinetic).max(0.0);
        self.bodies.iter_mut().for_each(|body| body.rate *= kept.sqrt());
        self.find_motions();
        kinetic * (1.0 - kept)
    }

    /// The same, and whatever energy it makes is left.
    ///
    /// Springs are those of the end of the step, nearly. What is explicit, how bodies stand and the forces of their
    /// spin, is taken from the middle of the step, which a first pass finds.
    pub fn step_freely(&mut self, time: f64, forces: &[DVec3]) {
        self.begin.clear();
        self.begin.extend(self.bodies.iter().map(|body| (body.turn, body.rate)));
        self.find_gains(time, forces);
        self.advance(0.5 * time, 0.5);
        self.find_gains(time, forces);
        self.advance(time, self.ahead);
    }

    /// Moves all bodies on from the beginning of the step. Turns go by the rate after that share of the time.
    fn advance(&mut self, time: f64, share: f64) {
        for ((body, (turn, rate)), gain) in self.bodies.iter_mut().zip(&self.begin).zip(&self.gains) {
            let turned = DQuat::from_scaled_axis(time * (*rate + share * time * *gain));
            body.turn = (turned * *turn).normalize();
            body.rate = *rate + time * *gain;
        }
        self.find_motions();
    }

    /// Finds how joints speed up over a step of so long with bodies as they are, and springs as at its beginning.
    fn find_gains(&mut self, time: f64, forces: &[DVec3]) {
        let ahead = self.ahead * time;
        self.load(forces);
        for at in (0..self.bodies.len()).rev() {
            let body = &self.bodies[at];
            let below = self.motion(body.parent);
            let (turn, rate) = self.begin[at];
            let joint = body.spring.ahead(turn, rate, ahead, body.damping).turned(below.turn);
            let arm = below.turn * body.arm;
            let passed_on = self.work[at].release(joint, arm, below.spin, below.turn * body.rate);
            if body.parent != NONE {
                self.work[body.parent as usize].add(&passed_on);
            }
        }
        for at in 0..self.bodies.len() {
            let parent = self.bodies[at].parent;
            let (angular, linear) = match parent {
                NONE => (DVec3::ZERO, DVec3::ZERO),
                parent => self.work[parent as usize].acceleration(),
            };
            self.gains[at] = self.motion(parent).turn.inverse() * self.work[at].accelerate(angular, linear);
        }
    }

    /// Kinetic energy and that of springs, J.
    pub fn energy(&self) -> f64 {
        let (kinetic, stored) = self.energies();
        kinetic + stored
    }

    /// Kinetic energy, and that of springs.
    fn energies(&self) -> (f64, f64) {
        let [mut kinetic, mut stored] = [0.0; 2];
        for (body, motion) in self.bodies.iter().zip(&self.motions) {
            let local = motion.turn.inverse() * motion.spin;
            kinetic += body.mass * motion.velocity.dot(motion.spin.cross(motion.turn * body.centre))
                + 0.5 * body.mass * motion.velocity.length_squared()
                + 0.5 * local.dot(body.inertia * local);
            stored += body.spring.energy(body.turn);
        }
        (kinetic, stored)
    }

    /// Σ F·x over what forces act on: its change is the work that they do.
    fn work_of(&self, forces: &[DVec3]) -> f64 {
        let of = |hold: &Hold| {
            let motion = &self.motions[hold.body as usize];
            hold.share * forces[hold.force as usize].dot(motion.joint + motion.turn * hold.at)
        };
        self.holds.iter().map(of).sum()
    }

    /// Where a row's node is, m; none where the ground has it.
    pub fn node(&self, row: u32) -> Option<DVec3> {
        let at = self.of_row[row as usize];
        let motion = self.motions.get(at as usize)?;
        Some(motion.joint + motion.turn * (self.places[row as usize] - self.bodies[at as usize].rest))
    }

    /// How a row's node has turned from rest; none where the ground has it.
    pub fn turn(&self, row: u32) -> Option<DQuat> {
        Some(self.motions.get(self.of_row[row as usize] as usize)?.turn)
    }

    fn motion(&self, body: u32) -> Motion {
        self.motions.get(body as usize).copied().unwrap_or_default()
    }

    fn find_motions(&mut self) {
        for at in 0..self.bodies.len() {
            let body = &self.bodies[at];
            let below = self.motion(body.parent);
            let arm = below.turn * body.arm;
            self.motions[at] = Motion {
                turn: below.turn * body.turn,
                joint: below.joint + arm,
                spin: below.spin + below.turn * body.rate,
                velocity: below.velocity + below.spin.cross(arm),
            };
        }
    }

    /// Begins a step: each body by itself, under its share of the forces.
    fn load(&mut self, forces: &[DVec3]) {
        for ((body, motion), work) in self.bodies.iter().zip(&self.motions).zip(&mut self.work) {
            let frame = DMat3::from_quat(motion.turn);
            let inertia = frame * body.inertia * frame.transpose();
            *work = Articulated::body(inertia, body.mass, frame * body.centre, motion.spin);
        }
        for hold in &self.holds {
            let turn = self.motions[hold.body as usize].turn;
            self.work[hold.body as usize].push(hold.share * forces[hold.force as usize], turn * hold.at);
        }
    }
}

impl Body {
    /// Takes on half of a row, whose middle is `at` from the joint. The centre is a sum until all are known.
    fn carry(&mut self, wood: &Wood, row: usize, at: DVec3) {
        let mass = 0.5 * wood.mass[row];
        let (length, radius) = (0.5 * wood.length[row], wood.radius[row]);
        let along = wood.way(row) / wood.length[row];
        let lengthwise = DMat3::from_cols(along.x * along, along.y * along, along.z * along);
        let across = DMat3::IDENTITY - lengthwise;
        let rod =
            across * (length * length / 12.0 + 0.25 * radius * radius) + lengthwise * (0.5 * radius * radius);
        let away = DMat3::IDENTITY * at.length_squared() - DMat3::from_cols(at.x * at, at.y * at, at.z * at);
        self.mass += mass;
        self.centre += mass * at;
        self.inertia += (rod + away) * mass;
    }
}
