//! How joints stand at a time: the wind of now, winds of before that fade, and plucks.

use glam::DVec3;

use crate::answers::{Answer, Answers};

/// Seconds in which one wind takes another's place.
const FADE: f64 = 1.5;
/// The most plucks that are remembered.
const MOST_PLUCKS: usize = 32;
/// A pluck of a smaller rotation than this is over, radians.
const STILL: f64 = 1e-3;
/// From this rotation on joints give way less, and none goes further than both together, radians.
const FREE: f64 = 0.8;
const BEYOND: f64 = 0.3;

/// A joint that was let go, out of its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pluck {
    /// The joint.
    pub joint: u32,
    /// When it was let go, in seconds.
    pub at: f64,
    /// How far out of its place it was, as a rotation vector.
    pub bend: DVec3,
}

impl Pluck {
    /// What is left of it at a time.
    fn left(&self, answer: &Answer, time: f64) -> DVec3 {
        let gone = time - self.at;
        if gone < 0.0 {
            return DVec3::ZERO;
        }
        let Answer { rate, damping, .. } = *answer;
        let damped = rate * (1.0 - damping * damping).sqrt();
        let (sin, cos) = libm::sincos(damped * gone);
        self.bend * (libm::exp(-damping * rate * gone) * (cos + damping * rate / damped * sin))
    }

    /// Whether it is over at a time.
    fn is_over(&self, answer: &Answer, time: f64) -> bool {
        self.bend.length() * libm::exp(-answer.damping * answer.rate * (time - self.at)) < STILL
    }
}

/// How joints stand, as a function of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sway {
    /// Answers to winds one after another, and when each took the place of the one before.
    winds: Vec<(f64, Answers)>,
    plucks: Vec<Pluck>,
}

impl Sway {
    /// One wind that has always blown.
    pub fn new(answers: Answers) -> Self {
        Self { winds: vec![(f64::NEG_INFINITY, answers)], plucks: Vec::new() }
    }

    /// From `at` on another wind blows, which takes over within a second and a half. The joints stay what they are.
    ///
    /// # Panics
    /// If the answers are those of other joints.
    pub fn change(&mut self, answers: Answers, at: f64) {
        assert_eq!(answers.all().len(), self.present().all().len(), "the joints stay what they are");
        self.winds.retain(|&(since, _)| since < at);
        self.winds.push((at, answers));
    }

    /// A joint is let go. Of more than 32 plucks the oldest are forgotten.
    pub fn pluck(&mut self, pluck: Pluck) {
        if self.plucks.len() == MOST_PLUCKS {
            self.plucks.remove(0);
        }
        self.plucks.push(pluck);
    }

    /// Forgets what is over at a time; the rotations from then on stay the same, plucks of a thousandth apart.
    pub fn forget(&mut self, time: f64) {
        let over = self.winds.iter().rposition(|&(since, _)| time >= since + FADE).unwrap_or(0);
        self.winds.drain(..over);
        let Self { winds, plucks } = self;
        if let Some((_, answers)) = winds.last() {
            plucks.retain(|pluck| !pluck.is_over(&answers.all()[pluck.joint as usize], time));
        }
    }

    /// How many plucks still swing.
    pub fn plucks(&self) -> usize {
        self.plucks.len()
    }

    /// The rotations of all joints at a time in seconds, radians.
    pub fn bends(&self, time: f64) -> Vec<DVec3> {
        let [mut bends, mut newer] = [Vec::new(), Vec::new()];
        for (since, answers) in &self.winds {
            let share = ((time - since) / FADE).clamp(0.0, 1.0);
            if share == 0.0 {
                // A wind that is still to come.
                continue;
            }
            if share == 1.0 {
                answers.bends(time, &mut bends);
                continue;
            }
            answers.bends(time, &mut newer);
            let share = share * share * (3.0 - 2.0 * share);
            bends.iter_mut().zip(&newer).for_each(|(bend, newer)| *bend += share * (*newer - *bend));
        }
        for pluck in &self.plucks {
            bends[pluck.joint as usize] += pluck.left(&self.present().all()[pluck.joint as usize], time);
        }
        bends.iter_mut().for_each(|bend| *bend = limited(*bend));
        bends
    }

    fn present(&self) -> &Answers {
        &self.winds[self.winds.len() - 1].1
    }
}

/// A rotation that goes too far, smoothly held back.
pub(crate) fn limited(bend: DVec3) -> DVec3 {
    let size = bend.length();
    if size <= FREE { bend } else { bend * ((FREE + BEYOND * libm::tanh((size - FREE) / BEYOND)) / size) }
}
