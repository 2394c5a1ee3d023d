//! Radii of codes by multiplication alone, so that every language finds the same bits.

/// Radius of code 1, in internodes.
const LEAST: f64 = 0.001;
/// e^0.01: the ratio of neighbouring codes.
const RATIO: f64 = 1.010_050_167_084_168;

/// The radius of each code up to `most`, in internodes; 0 for code 0.
///
/// Each is the one before times [`RATIO`]. The exponential function would be nearer to the truth by some units in the
/// thirteenth place, but differs in its last bit from one implementation to another.
pub(crate) fn radii(most: u16) -> Vec<f64> {
    let mut radii = vec![0.0];
    let mut radius = LEAST;
    for _ in 0..most {
        radii.push(radius);
        radius *= RATIO;
    }
    radii
}

#[cfg(test)]
mod tests {
    use espalier_mesh::radius_code;

    use super::*;

    #[test]
    fn radii_are_those_of_the_codes() {
        let radii = radii(3000);
        for code in 0..=3000 {
            let exact = f64::from(radius_code::decode(code));
            assert!((radii[usize::from(code)] - exact).abs() <= 2e-6 * exact, "code {code}");
        }
    }
}
