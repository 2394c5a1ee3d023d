//! Colours in linear light and in sRGB.

use std::sync::LazyLock;

use glam::Vec3;

/// Linear light of each byte. A picture asks for it at each of its pixels.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| {
        let c = byte as f32 / 255.0;
        if c <= 0.040_45 { c / 12.92 } else { libm::powf((c + 0.055) / 1.055, 2.4) }
    })
});

/// The least linear light of each byte but the first: its bits, which rise as numbers from 0 do.
static LEAST: LazyLock<[u32; 255]> = LazyLock::new(|| {
    std::array::from_fn(|below| {
        let (mut low, mut high) = (0, 1.0f32.to_bits());
        while low < high {
            let middle = low.midpoint(high);
            if usize::from(byte(f32::from_bits(middle))) > below {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        low
    })
});

/// The byte of linear light from 0 to 1, by the formula of sRGB.
fn byte(c: f32) -> u8 {
    let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * libm::powf(c, 1.0 / 2.4) - 0.055 };
    (c * 255.0 + 0.5) as u8
}

/// An sRGB colour in linear light.
pub(crate) fn linear(colour: [u8; 3]) -> Vec3 {
    Vec3::from_array(colour.map(|c| LINEAR[usize::from(c)]))
}

/// Linear light as sRGB bytes.
pub(crate) fn encoded(linear: Vec3) -> [u8; 3] {
    let least = &*LEAST;
    linear.to_array().map(|c| {
        // What is no number is dark, and a zero may have a sign.
        let bits = if c > 0.0 { c.to_bits() } else { 0 };
        least.partition_point(|&least| least <= bits) as u8
    })
}

/// 0 up to `low`, 1 from `high` on.
pub(crate) fn smooth(low: f32, high: f32, at: f32) -> f32 {
    let t = ((at - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_survive_linear_light_and_back() {
        for value in 0..=255 {
            assert_eq!(encoded(linear([value; 3])), [value; 3]);
        }
    }

    #[test]
    fn light_is_encoded_as_the_formula_has_it() {
        for part in 0..=100_000 {
            let light = part as f32 / 100_000.0;
            assert_eq!(encoded(Vec3::splat(light)), [byte(light); 3], "{light}");
        }
        assert_eq!(encoded(Vec3::new(-1.0, 7.0, f32::NAN)), [0, 255, 0]);
        assert_eq!(encoded(-Vec3::ZERO), [0; 3]);
    }
}
