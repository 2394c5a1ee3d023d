//! How joints answer a wind, in closed form.
//!
//! A joint is a damped oscillator, and the wind a sum of lines. In the steady state each line k swings it by the
//! response 1/(1 − b² + 2iζb) with b = f_k/f_j (Stam 1997, Habel et al. 2009), so its rotation is a function of time
//! with nothing to integrate:
//!
//! Θ(t) = C q (Û + Σ n d (c cos τ + s sin τ)),  c + is = a χ e^{iκ·x} / (1 − b² − 2iζb),  τ = 2π f t + φ.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use crate::{
    exposure::Exposure,
    joints::{Joint, Joints},
    wind::{Direction, Line, Wind, angle},
};

/// Pressure of air at 1 m/s, Pa: half its density.
const PRESSURE: f64 = 0.6125;
/// Crowns streamline from this speed on, m/s: pressure goes on with a lower exponent (Vogel 1989, with V = −0.7).
const STREAMLINED_FROM: f64 = 4.0;
const STREAMLINED: f64 = 1.3;
/// The furthest that a mean wind turns a joint, radians.
const FURTHEST: f64 = 0.8;
/// Damping at most, so that what is plucked still swings.
const MOST_DAMPED: f64 = 0.95;

/// How one joint answers one wind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Its rotation under what lies on it, radians; none where nothing does.
    pub rest: DVec3,
    /// Its rotation in the mean wind as well, radians.
    pub mean: DVec3,
    /// Its rotation for a fluctuation of the size of the mean, along, across and upward, column by column.
    pub swing: DMat3,
    /// ω in s⁻¹, undamped.
    pub rate: f64,
    /// Damping, that of the air included, as a share of the critical one.
    pub damping: f64,
}

/// How all joints answer one wind.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    period: f64,
    lines: Vec<Line>,
    answers: Vec<Answer>,
    /// c and s of each line, joint by joint.
    responses: Vec<[f64; 2]>,
}

impl Answers {
    /// O(joints × lines), once for each change of the wind.
    pub fn of(joints: &Joints, wind: &Wind, exposure: &Exposure) -> Self {
        Self::under(joints, wind, exposure, &[])
    }

    /// The same of joints that turn so far under what lies on them, as [`crate::loads::turns`] has it; beyond its end
    /// nothing does.
    pub fn under(joints: &Joints, wind: &Wind, exposure: &Exposure, loads: &[DVec3]) -> Self {
        let lines = wind.lines().to_vec();
        let mut answers = Vec::with_capacity(joints.all().len());
        let mut responses = Vec::with_capacity(joints.all().len() * lines.len());
        let loads = loads.iter().copied().chain(std::iter::repeat(DVec3::ZERO));
        for ((joint, &share), load) in joints.all().iter().zip(exposure.shares()).zip(loads) {
            let answer = answer(joint, wind, share * wind.speed(), load);
            responses.extend(lines.iter().map(|line| response(joint, answer.damping, line, wind)));
            answers.push(answer);
        }
        Self { period: wind.period(), lines, answers, responses }
    }

    /// By joint.
    pub fn all(&self) -> &[Answer] {
        &self.answers
    }

    /// The rotations of all joints at a time in seconds.
    pub fn bends(&self, time: f64, bends: &mut Vec<DVec3>) {
        let of_line = |line: &Line| {
            let (sin, cos) = libm::sincos(angle(line.harmonic, self.period, time) + line.phase);
            (line.direction as usize, cos, sin)
        };
        let waves: Vec<(usize, f64, f64)> = self.lines.iter().map(of_line).collect();
        bends.clear();
        if waves.is_empty() {
            bends.extend(self.answers.iter().map(|answer| answer.mean));
            return;
        }
        bends.extend(self.answers.iter().zip(self.responses.chunks_exact(waves.len())).map(
            |(answer, responses)| {
                let mut gust = [0.0; 3];
                for (&(direction, cos, sin), [c, s]) in waves.iter().zip(responses) {
                    gust[direction] += c * cos + s * sin;
                }
                answer.mean + answer.swing * DVec3::from_array(gust)
            },
        ));
    }
}

/// The mean pressure of a wind in Pa, and the exponent by which it grows with the wind's speed.
pub fn pressure(speed: f64) -> (f64, f64) {
    if speed <= STREAMLINED_FROM {
        (PRESSURE * speed * speed, 2.0)
    } else {
        let at_limit = PRESSURE * STREAMLINED_FROM * STREAMLINED_FROM;
        (at_limit * libm::pow(speed / STREAMLINED_FROM, STREAMLINED), STREAMLINED)
    }
}

fn answer(joint: &Joint, wind: &Wind, speed: f64, load: DVec3) -> Answer {
    let (pressure, exponent) = pressure(speed);
    let rate = TAU * joint.frequency;
    let by_air = if speed > 0.0 { exponent * pressure / speed * joint.drag / (2.0 * rate) } else { 0.0 };
    let [along, across, upward] =
        [Direction::Along, Direction::Across, Direction::Upward].map(|direction| wind.axis(direction));
    let whole = joint.compliance * along * pressure + load;
    // Swings around the mean are only scaled: the slope of its limit would freeze supple limbs in a storm.
    let far = whole.length() / FURTHEST;
    let swing = DMat3::from_cols(
        joint.compliance * along * exponent,
        joint.compliance * across,
        joint.compliance * upward,
    );
    Answer {
        rest: held(load),
        mean: held(whole),
        swing: swing * (pressure / (1.0 + far)),
        rate,
        damping: (joint.damping + by_air).min(MOST_DAMPED),
    }
}

/// A mean rotation, smoothly limited.
fn held(whole: DVec3) -> DVec3 {
    let far = whole.length() / FURTHEST;
    if far > 0.0 { whole * (libm::tanh(far) / far) } else { whole }
}

/// How much of eddies of a frequency acts on a crown of some area: smaller ones cancel (Vickery's admittance).
pub fn admittance(frequency: f64, area: f64, speed: f64) -> f64 {
    (1.0 / (1.0 + libm::pow(2.0 * frequency * area.sqrt() / speed, 4.0 / 3.0))).sqrt()
}

fn response(joint: &Joint, damping: f64, line: &Line, wind: &Wind) -> [f64; 2] {
    let ratio = line.frequency / joint.frequency;
    let (re, im) = (1.0 - ratio * ratio, -2.0 * damping * ratio);
    let (sin, cos) = libm::sincos(line.wave.dot(joint.centre));
    let size = line.amplitude * admittance(line.frequency, joint.area, wind.speed()) / (re * re + im * im);
    [size * (cos * re + sin * im), size * (sin * re - cos * im)]
}
