//! Radii as 16-bit codes on a logarithmic scale.

use espalier_plant::Girth;

/// Radius of code 1, in internodes.
pub const MIN_RADIUS: f32 = 0.001;
/// Natural logarithm of the ratio of neighbouring codes: one per cent, below what an eye can tell.
pub const LOG_STEP: f32 = 0.01;
/// Natural logarithm of [`MIN_RADIUS`].
const LOG_MIN_RADIUS: f32 = -6.907_755_4;
/// The code of what is not drawn: seeds and the dead.
pub const NOT_DRAWN: u16 = 0;

/// Nearly all metamers are twigs: their codes are looked up.
const TABLE_LEN: u32 = 4096;

/// The code nearest to a radius; radii under [`MIN_RADIUS`] get the code of that.
pub fn encode(radius: f32) -> u16 {
    // Clamped first, so that the conversion never meets the -∞ of a radius of 0.
    code_at(libm::logf(radius.max(MIN_RADIUS) / MIN_RADIUS) / LOG_STEP)
}

/// The same for the natural logarithm of a radius.
pub fn encode_log(log_radius: f32) -> u16 {
    code_at(((log_radius - LOG_MIN_RADIUS) / LOG_STEP).max(0.0))
}

fn code_at(steps: f32) -> u16 {
    (1.0 + steps.round()).min(f32::from(u16::MAX)) as u16
}

/// The radius of a code, in internodes; 0 for [`NOT_DRAWN`].
pub fn decode(code: u16) -> f32 {
    if code == NOT_DRAWN { 0.0 } else { MIN_RADIUS * libm::expf(f32::from(code - 1) * LOG_STEP) }
}

/// Turns tips into codes.
#[derive(Clone, Debug)]
pub(crate) struct RadiusCodes {
    table: Vec<u16>,
}

impl RadiusCodes {
    pub(crate) fn new(girth: &Girth) -> Self {
        Self { table: (0..TABLE_LEN).map(|tips| encode(girth.radius(tips))).collect() }
    }

    pub(crate) fn of_tips(&self, girth: &Girth, tips: u32) -> u16 {
        self.table.get(tips as usize).copied().unwrap_or_else(|| encode(girth.radius(tips)))
    }
}

#[cfg(test)]
mod tests {
    use std::{fmt::Write, fs, path::PathBuf};

    use super::*;

    /// Clients decode by themselves: both must find the radii in `golden/radius-codes.json`.
    ///
    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-mesh radius_code`.
    #[test]
    fn codes_are_as_they_were_written_down() {
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/radius-codes.json");
        let mut written = String::new();
        for code in [0, 1, 2, 100, 392, 692, 900, 1153, 1500, 2000] {
            let comma = if written.is_empty() { "[" } else { "," };
            write!(written, "{comma}[{code},{:?}]", decode(code)).expect("memory takes it");
        }
        written.push_str("]\n");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, &written).expect("the radii can be written");
        }
        assert!(fs::read_to_string(&file).is_ok_and(|stored| stored == written), "radii differ");
    }

    #[test]
    fn codes_are_one_per_cent_apart() {
        assert_eq!(encode(0.001), 1);
        // ln(50) = 3.91202…
        assert_eq!(encode(0.05), 392);
        assert_eq!(encode(1.0), 692);
        assert!((decode(392) - 0.05).abs() < 0.05 * 0.005);
    }

    #[test]
    fn every_drawn_radius_has_a_drawn_code() {
        for radius in [0.0, 1e-30, 0.0009, f32::MAX] {
            assert!(encode(radius) >= 1);
        }
    }

    #[test]
    fn codes_survive_a_round_trip() {
        for code in 1..2000 {
            assert_eq!(encode(decode(code)), code);
        }
    }

    #[test]
    fn logarithms_have_the_codes_of_radii() {
        for code in [1, 2, 392, 692, 2000] {
            assert_eq!(encode_log(libm::logf(decode(code))), code);
        }
        assert_eq!([f32::NEG_INFINITY, -50.0, 1e9].map(encode_log), [1, 1, u16::MAX]);
    }

    #[test]
    fn large_counts_continue_the_table() {
        let girth = Girth::new(2.5, 0.1);
        let codes = RadiusCodes::new(&girth);
        let code = |tips| codes.of_tips(&girth, tips);
        assert!(code(TABLE_LEN) - code(TABLE_LEN - 1) <= 1);
        assert_eq!(code(1_000_000), encode(girth.radius(1_000_000)));
    }
}
