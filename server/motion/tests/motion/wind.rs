//! The field of the wind: its variance, its coherence, its loops.

use espalier_motion::{Direction, LIVE_PERIOD, Weather, Wind, profile};
use glam::DVec3;

const WEATHER: Weather = Weather { velocity: DVec3::new(6.0, 0.0, 0.0), turbulence: 0.5, seed: 1 };
/// 10 m above the ground, where the profile is 1.
const GAUGE: DVec3 = DVec3::new(3.0, 10.0, -2.0);

#[test]
fn variance_at_a_point_is_that_of_the_lines_and_nearly_all_of_the_spectrum() {
    let wind = Wind::new(&WEATHER, LIVE_PERIOD);
    assert_eq!(wind.lines().len(), 20);
    let samples = 20_000;
    for (direction, size) in [(Direction::Along, 1.0), (Direction::Across, 0.75), (Direction::Upward, 0.5)] {
        let axis = wind.axis(direction);
        let speeds =
            (0..samples).map(|at| wind.velocity(GAUGE, 600.0 * f64::from(at) / f64::from(samples)).dot(axis));
        let mean = if direction == Direction::Along { 6.0 } else { 0.0 };
        let variance = speeds.map(|speed| (speed - mean) * (speed - mean)).sum::<f64>() / f64::from(samples);
        let there = wind.lines().iter().filter(|line| line.direction == direction);
        let of_lines = there.map(|line| 18.0 * line.amplitude * line.amplitude).sum::<f64>();
        assert!((variance / of_lines - 1.0).abs() < 1e-9, "{direction:?}: {variance} for {of_lines}");
        let whole = 1.5 * size * 1.5 * size;
        assert!(variance > 0.85 * whole && variance < whole, "{direction:?}: {variance} of {whole}");
    }
}

#[test]
fn coherence_across_the_wind_falls_as_davenport_has_it() {
    let winds: Vec<Wind> =
        (0..500).map(|seed| Wind::new(&Weather { seed, ..WEATHER }, LIVE_PERIOD)).collect();
    for line in [3, 6, 9, 11] {
        for apart in [DVec3::new(0.0, 0.0, 2.0), DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 3.0, 4.0)] {
            let frequency = winds[0].lines()[line].frequency;
            let cos = |wind: &Wind| libm::cos(wind.lines()[line].wave.dot(apart));
            let found = winds.iter().map(cos).sum::<f64>() / winds.len() as f64;
            let expected = libm::exp(-10.0 * frequency * apart.length() / 6.0);
            assert!((found - expected).abs() < 0.1, "{frequency} Hz, {apart}: {found} for {expected}");
        }
    }
}

#[test]
fn gusts_run_with_the_wind() {
    let wind = Wind::new(&WEATHER, LIVE_PERIOD);
    let downwind = DVec3::X * 9.0;
    for line in wind.lines() {
        let along = line.wave.dot(downwind) / (std::f64::consts::TAU * line.frequency);
        assert!((along - 9.0 / 5.4).abs() < 1e-9, "a line takes {along} s for 9 m");
    }
    // The swell is alike across a crown: what blows here blows there a moment later.
    let slow = |place, time| wind.velocity(place, time).x;
    let later = (0..200)
        .map(|t| (slow(GAUGE, f64::from(t)) - slow(GAUGE + downwind, f64::from(t) + 9.0 / 5.4)).abs());
    assert!(later.fold(0.0, f64::max) < 1e-9);
}

#[test]
fn a_loop_takes_harmonics_once_each() {
    for period in [4.0, 8.0, 30.0] {
        let wind = Wind::new(&WEATHER, period);
        let lines = wind.lines();
        assert!(lines.len() > 5 && lines[0].harmonic >= 1);
        assert!(lines.windows(2).all(|pair| pair[0].harmonic < pair[1].harmonic));
        for time in [0.0, 0.7, 3.3] {
            assert_eq!(wind.velocity(GAUGE, 0.0), wind.velocity(GAUGE, period));
            assert!(wind.velocity(GAUGE, time).distance(wind.velocity(GAUGE, time + 5.0 * period)) < 1e-9);
        }
    }
}

#[test]
fn the_seed_chooses_the_gusts() {
    let wind = |seed| Wind::new(&Weather { seed, ..WEATHER }, LIVE_PERIOD).velocity(GAUGE, 12.5);
    assert_eq!(wind(4), wind(4));
    assert!(wind(4).distance(wind(5)) > 1e-3);
}

#[test]
fn a_calm_and_an_even_wind_have_no_lines() {
    for weather in [Weather { velocity: DVec3::ZERO, ..WEATHER }, Weather { turbulence: 0.0, ..WEATHER }] {
        let wind = Wind::new(&weather, LIVE_PERIOD);
        assert!(wind.lines().is_empty());
        assert_eq!(wind.velocity(GAUGE, 7.0), weather.velocity);
    }
}

#[test]
fn wind_grows_with_height() {
    assert_eq!(profile(10.0), 1.0);
    assert_eq!(profile(-1.0), 0.15);
    assert!(profile(1.0) > 0.6 && profile(1.0) < 0.65 && profile(30.0) > 1.2);
}

#[test]
fn the_axes_of_any_wind_are_square() {
    for velocity in [DVec3::new(1.0, 2.0, -3.0), DVec3::Y, -DVec3::Z] {
        let wind = Wind::new(&Weather { velocity, ..WEATHER }, LIVE_PERIOD);
        let [a, b, c] = [Direction::Along, Direction::Across, Direction::Upward].map(|axis| wind.axis(axis));
        assert!(a.distance(velocity.normalize()) < 1e-12);
        for (x, y) in [(a, b), (b, c), (c, a)] {
            assert!(x.dot(y).abs() < 1e-12 && (x.length() - 1.0).abs() < 1e-12);
        }
    }
}
