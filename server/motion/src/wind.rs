//! The wind: a mean and some spectral lines, a function of place and time.

use std::f64::consts::TAU;

use espalier_mesh::leaves::hash;
use glam::DVec3;

use crate::spectrum;

/// Seconds after which a wind that blows on begins anew.
pub const LIVE_PERIOD: f64 = 600.0;
/// Bands of the slow swell, and where it ends, Hz.
const SWELL: usize = 4;
const SWELL_FROM: f64 = 1.0 / 600.0;
const SWELL_TO: f64 = 0.02;
/// Bands above the swell, and where they end, Hz.
const GUSTS: usize = 16;
const GUSTS_TO: f64 = 4.0;
/// Standard deviation along a fully turbulent wind as a share of its mean, and those across and upward as shares of it
/// (neutral surface layer).
const INTENSITY: f64 = 0.5;
const ACROSS: f64 = 0.75;
const UPWARD: f64 = 0.5;
/// Gusts travel at this share of the mean speed.
pub(crate) const CONVECTION: f64 = 0.9;
/// Davenport's decay of coherence: exp(−c f Δ / U) for two places Δ apart across the wind.
const DECAY: f64 = 10.0;
/// Where the mean speed is measured, m, and how it grows from the ground: a power law between open land and wood.
const GAUGE: f64 = 10.0;
const PROFILE: f64 = 0.2;
const NEAR_GROUND: f64 = 0.15;

/// What the user sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weather {
    /// Mean wind 10 m above the ground, m/s.
    pub velocity: DVec3,
    /// From 0, which is even, to 1.
    pub turbulence: f64,
    /// Which gusts come.
    pub seed: u32,
}

impl Weather {
    /// Of a wind that blows level at so many m/s to a direction in degrees, around the vertical from x towards z, and rises
    /// besides. In a calm it has no direction of its own.
    pub fn blowing([speed, degrees, rise]: [f64; 3], turbulence: f64, seed: u32) -> Self {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        Self { velocity: DVec3::new(speed * cos, rise, speed * sin), turbulence, seed }
    }
}

/// Where the speed of a line points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the mean wind.
    Along,
    /// Level and across it.
    Across,
    /// Across both.
    Upward,
}

/// One spectral line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// How many times it comes round in a period.
    pub harmonic: u32,
    /// The same in Hz.
    pub frequency: f64,
    /// Amplitude as a share of the mean speed.
    pub amplitude: f64,
    /// Where it points.
    pub direction: Direction,
    /// Phase at the origin and time 0, radians.
    pub phase: f64,
    /// Wave number, radians per metre.
    pub wave: DVec3,
}

/// u(x, t) = U p(y) (Û + Σ a d cos(2π f t − κ·x + φ)).
#[derive(Clone, Debug, PartialEq)]
pub struct Wind {
    speed: f64,
    period: f64,
    axes: [DVec3; 3],
    lines: Vec<Line>,
}

impl Wind {
    /// A wind that comes round after `period` seconds, to the bit: [`LIVE_PERIOD`], or the length of a loop. Its lines are
    /// multiples of 1/period, each once; slower ones are left out. A velocity or a turbulence that is not finite is none.
    pub fn new(weather: &Weather, period: f64) -> Self {
        let speed = Some(weather.velocity.length()).filter(|speed| speed.is_finite()).unwrap_or_default();
        let along = if speed > 0.0 { weather.velocity / speed } else { DVec3::X };
        let across = along.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::Z);
        let mut wind = Self { speed, period, axes: [along, across, across.cross(along)], lines: Vec::new() };
        if speed > 0.0 && weather.turbulence > 0.0 && weather.turbulence.is_finite() {
            wind.lines = wind.drawn(weather);
        }
        wind
    }

    fn drawn(&self, weather: &Weather) -> Vec<Line> {
        let tones = tones(self.speed, self.period);
        let whole: f64 = tones.iter().map(|&(_, share)| share).sum();
        let deviation = |direction| {
            // The lines of each direction hold all of its variance, though they are but some of all lines.
            let points_there = |&(at, _): &(usize, &(u32, f64))| direction_of(at) == direction;
            let held: f64 = tones.iter().enumerate().filter(points_there).map(|(_, &(_, share))| share).sum();
            let size = match direction {
                Direction::Along => 1.0,
                Direction::Across => ACROSS,
                Direction::Upward => UPWARD,
            };
            INTENSITY * weather.turbulence * size * (whole / held).sqrt()
        };
        tones
            .iter()
            .enumerate()
            .map(|(at, &(harmonic, share))| {
                let direction = direction_of(at);
                let frequency = f64::from(harmonic) / self.period;
                let unit = |purpose| unit(weather.seed, at as u32, purpose);
                let [along, across, upward] = self.axes;
                // Davenport's coherence is the characteristic function of Cauchy's distribution, here that of the plane:
                // the wave number has no bounds.
                let near = 1.0 - unit(1);
                let spread = DECAY * frequency / self.speed * (1.0 / (near * near) - 1.0).sqrt();
                let (sin, cos) = libm::sincos(TAU * unit(2));
                Line {
                    harmonic,
                    frequency,
                    amplitude: deviation(direction) * (2.0 * share).sqrt(),
                    direction,
                    phase: TAU * unit(0),
                    wave: TAU * frequency / (CONVECTION * self.speed) * along
                        + spread * (cos * across + sin * upward),
                }
            })
            .collect()
    }

    /// Mean speed 10 m above the ground, m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Seconds after which everything comes again.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The lines, slowest first.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// The unit vector of a direction.
    pub fn axis(&self, direction: Direction) -> DVec3 {
        self.axes[direction as usize]
    }

    /// Speed along the mean wind at a place in metres and a time in seconds, as it were 10 m above open ground; never
    /// below 0.
    pub fn speed_along(&self, place: DVec3, time: f64) -> f64 {
        let gusts = self.lines.iter().filter(|line| line.direction == Direction::Along).map(|line| {
            let angle = angle(line.harmonic, self.period, time) + line.phase - line.wave.dot(place);
            line.amplitude * libm::cos(angle)
        });
        (self.speed * (1.0 + gusts.sum::<f64>())).max(0.0)
    }

    /// Velocity at a place in metres and a time in seconds, in the open.
    pub fn velocity(&self, place: DVec3, time: f64) -> DVec3 {
        let gusts = self.lines.iter().map(|line| {
            let angle = angle(line.harmonic, self.period, time) + line.phase - line.wave.dot(place);
            line.amplitude * libm::cos(angle) * self.axis(line.direction)
        });
        let mean = self.axis(Direction::Along);
        self.speed * profile(place.y) * gusts.fold(mean, |sum, gust| sum + gust)
    }
}

/// Mean speed at a height above the ground in metres, as a share of that at 10 m.
pub fn profile(height: f64) -> f64 {
    libm::pow((height / GAUGE).max(0.0), PROFILE).max(NEAR_GROUND)
}

/// How far a line has come round at a time in seconds, in radians; the same to the bit a period later.
pub(crate) fn angle(harmonic: u32, period: f64, time: f64) -> f64 {
    let periods = time / period;
    let turns = f64::from(harmonic) * (periods - periods.floor());
    TAU * (turns - turns.floor())
}

/// Two lines in three point along the wind.
fn direction_of(line: usize) -> Direction {
    match line % 6 {
        2 => Direction::Across,
        5 => Direction::Upward,
        _ => Direction::Along,
    }
}

/// Harmonics of a period with the share of the variance that each stands for.
fn tones(speed: f64, period: f64) -> Vec<(u32, f64)> {
    let band = |from: f64, to: f64, count: usize, at: usize| {
        let ratio = libm::log(to / from);
        [at, at + 1].map(|edge| from * libm::exp(ratio * edge as f64 / count as f64))
    };
    let swell = (0..SWELL).map(|at| band(SWELL_FROM, SWELL_TO, SWELL, at));
    let gusts = (0..GUSTS).map(|at| band(SWELL_TO, GUSTS_TO, GUSTS, at));
    let mut tones: Vec<(u32, f64)> = Vec::new();
    for band in swell.chain(gusts) {
        let harmonic = ((band[0] * band[1]).sqrt() * period + 0.5).floor() as u32;
        match tones.last_mut() {
            _ if harmonic == 0 => {}
            Some((last, share)) if *last == harmonic => *share += spectrum::share(speed, band),
            _ => tones.push((harmonic, spectrum::share(speed, band))),
        }
    }
    tones
}

/// A number from 0 to 1, 1 left out, for a purpose of a line.
fn unit(seed: u32, line: u32, purpose: u32) -> f64 {
    f64::from(hash(hash(seed).wrapping_add(4 * line + purpose))) / (1u64 << 32) as f64
}
