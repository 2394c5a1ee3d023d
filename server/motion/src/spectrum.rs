//! How the wind's variance is spread over frequencies.

/// Length of the largest eddies along the wind, m.
const EDDIES: f64 = 60.0;
/// Steps of Simpson's rule over one band, an even number.
const STEPS: u32 = 16;

/// The share of the variance along the wind that lies between two frequencies in Hz, at a mean speed in m/s.
///
/// Von Kármán's spectrum: S = 4 σ² (L/U) / (1 + 70.8 (f L/U)²)^(5/6), whose integral over all frequencies is σ².
pub(crate) fn share(speed: f64, [from, to]: [f64; 2]) -> f64 {
    // Over ln X with X = f L/U: ∫ 4 X / (1 + 70.8 X²)^(5/6) d ln X.
    let density = |x: f64| 4.0 * x / libm::pow(1.0 + 70.8 * x * x, 5.0 / 6.0);
    let [from, to] = [from, to].map(|frequency| frequency * EDDIES / speed);
    let step = libm::log(to / from) / f64::from(STEPS);
    let at = |i: u32| density(from * libm::exp(f64::from(i) * step));
    let inner = (1..STEPS).map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) });
    (at(0) + inner.sum::<f64>() + at(STEPS)) * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_bands_hold_all_of_the_variance() {
        // Finely cut, from far below the eddies to far above.
        let bands = (0..400).map(|i| [i, i + 1].map(|at| 1e-7 * libm::pow(10.0, f64::from(at) / 25.0)));
        let whole: f64 = bands.map(|band| share(6.0, band)).sum();
        // The customary 70.8 is 70.78 rounded.
        assert!((whole - 1.0).abs() < 2e-4, "{whole}");
    }

    #[test]
    fn a_band_in_two_halves_holds_the_same() {
        let [low, high] = [[0.1, 0.2], [0.2, 0.4]].map(|band| share(8.0, band));
        assert!((share(8.0, [0.1, 0.4]) / (low + high) - 1.0).abs() < 1e-5);
    }
}
