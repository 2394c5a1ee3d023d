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

/// One body. It is jointed in the middle of its row, and reaches from there to the middles of the rows that its node
/// bears: turns between middles are exact where moments are even.
#[derive(Clone, Copy, Debug)]
struct Body {
    row: u32,
    /// The body below; [`NONE`] for the ground.
    parent: u32,
    /// From the joint of the body below to its own, at rest, m; for the first from the origin.
    arm: DVec3,
    /// From the joint to its node, at rest, m.
    reach: DVec3,
    mass: f64,
    /// From the joint to its centre of mass, at rest, m.
    centre: DVec3,
    /// About the joint, at rest, kg m².
    inertia: DMat3,
    spring: Spring,
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

/// All bodies, each after the one it stands on.
#[derive(Clone, Debug)]
pub struct Bodies {
    joinery: Joinery,
    bodies: Vec<Body>,
    /// The body of each row.
    of_row: Vec<u32>,
    motions: Vec<Motion>,
    work: Vec<Articulated>,
    /// Turns and rates at the beginning of a step.
    begin: Vec<(DQuat, DVec3)>,
    /// How rates change, s⁻².
    gains: Vec<DVec3>,
}

impl Bodies {
    /// At rest. Rows without length are nobody's.
    pub fn of(wood: &Wood, joinery: Joinery) -> Self {
        let mut of_row = vec![NONE; wood.len()];
        let mut bodies: Vec<Body> = Vec::new();
        for row in (0..wood.len()).filter(|&row| wood.length[row] > 0.0) {
            let way = wood.way(row);
            let parent = of_row[wood.parent[row] as usize];
            let joint = wood.middle(row);
            let below =
                if parent == NONE { DVec3::ZERO } else { wood.middle(bodies[parent as usize].row as usize) };
            of_row[row] = bodies.len() as u32;
            let mut body = Body {
                row: row as u32,
                parent,
                arm: joint - below,
                reach: 0.5 * way,
                mass: 0.0,
                centre: DVec3::ZERO,
                inertia: DMat3::ZERO,
                spring: Spring::of(way / wood.length[row], 1.0 / (joinery.softness * wood.softness(row))),
                turn: DQuat::IDENTITY,
                rate: DVec3::ZERO,
            };
            body.carry(wood, row, 0.25 * way);
            bodies.push(body);
            if parent != NONE {
                let base = joint - 0.25 * way;
                bodies[parent as usize].carry(wood, row, base - below);
            }
        }
        for body in &mut bodies {
            body.centre /= body.mass;
        }
        let mut all = Self {
            joinery,
            motions: vec![Motion::default(); bodies.len()],
            work: vec![Articulated::default(); bodies.len()],
            begin: Vec::new(),
            gains: vec![DVec3::ZERO; bodies.len()],
            bodies,
            of_row,
        };
        all.find_motions();
        all
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
        let Joinery { damping, ahead, .. } = joinery;
        self.joinery = Joinery { damping, ahead, ..self.joinery };
    }

    /// One step of `time` seconds under forces on rows in newtons, which act in their middles.
    ///
    /// Springs are those of the end of the step, nearly. What is explicit, how bodies stand and the forces of their
    /// spin, is taken from the middle of the step, which a first pass finds. The little energy that this still makes
    /// where bodies spin fast is taken from all rates alike, so that no plant can tear itself apart; returns how much that
    /// was, in J.
    pub fn step(&mut self, time: f64, forces: &[DVec3]) -> f64 {
        let (kinetic, stored) = self.energies();
        let allowed = kinetic + stored - self.work_of(forces);
        self.begin.clear();
        self.begin.extend(self.bodies.iter().map(|body| (body.turn, body.rate)));
        self.find_gains(time, forces);
        self.advance(0.5 * time, 0.5);
        self.find_gains(time, forces);
        self.advance(time, self.joinery.ahead);
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
        let ahead = self.joinery.ahead * time;
        self.load(forces);
        for at in (0..self.bodies.len()).rev() {
            let body = &self.bodies[at];
            let below = self.motion(body.parent);
            let (turn, rate) = self.begin[at];
            let joint = body.spring.ahead(turn, rate, ahead, self.joinery.damping).turned(below.turn);
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
        let of = |(body, motion): (&Body, &Motion)| {
            let spread = motion.turn * body.reach - self.motion(body.parent).turn * body.reach;
            forces[body.row as usize].dot(motion.joint + 0.25 * spread)
        };
        self.bodies.iter().zip(&self.motions).map(of).sum()
    }

    /// Where a row's node is, m; none where the row is nobody's.
    pub fn node(&self, row: u32) -> Option<DVec3> {
        let at = self.of_row[row as usize];
        let motion = self.motions.get(at as usize)?;
        Some(motion.joint + motion.turn * self.bodies[at as usize].reach)
    }

    /// How a row's node has turned from rest; none where the row is nobody's.
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
        for at in 0..self.bodies.len() {
            let body = &self.bodies[at];
            // Half of it beyond the joint, half before, where it acts on the body below.
            let force = 0.5 * forces[body.row as usize];
            self.work[at].push(force, self.motions[at].turn * (0.5 * body.reach));
            if let Some(below) = self.motions.get(body.parent as usize) {
                let base = below.turn * (body.arm - 0.5 * body.reach);
                self.work[body.parent as usize].push(force, base);
            }
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
