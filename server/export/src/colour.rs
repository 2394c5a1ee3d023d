//! Colours in linear light and in sRGB.

use glam::Vec3;

/// An sRGB colour in linear light.
pub(crate) fn linear(colour: [u8; 3]) -> Vec3 {
    Vec3::from_array(colour.map(|c| {
        let c = f32::from(c) / 255.0;
        if c <= 0.040_45 { c / 12.92 } else { libm::powf((c + 0.055) / 1.055, 2.4) }
    }))
}

/// Linear light as sRGB bytes.
pub(crate) fn encoded(linear: Vec3) -> [u8; 3] {
    linear.to_array().map(|c| {
        let c = c.clamp(0.0, 1.0);
        let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * libm::powf(c, 1.0 / 2.4) - 0.055 };
        (c * 255.0 + 0.5) as u8
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
}
