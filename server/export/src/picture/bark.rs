//! What bark looks like: a colour for each place of its texture.

use espalier_mesh::leaves::hash;
use espalier_settings::BarkKind;
use glam::{Vec2, Vec3};

/// Colour of bark of a kind and tint, at a place of its texture and some height above the ground. A `tile` of the
/// texture is about as wide as an internode on stems, and as wide as a twig is around on twigs.
pub(crate) fn colour(kind: BarkKind, tint: Vec3, at: Vec2, tile: f32, height: f32) -> Vec3 {
    // Twigs of all kinds are smooth and brown; only older wood has a bark of its own.
    let age = ((tile - 0.5) / 0.35).clamp(0.0, 1.0);
    let twig = (0.5 * tint).min(Vec3::new(0.1, 0.07, 0.05));
    twig.lerp(aged(kind, tint, at, height), age)
}

fn aged(kind: BarkKind, tint: Vec3, at: Vec2, height: f32) -> Vec3 {
    let dark = tint * 0.45;
    match kind {
        BarkKind::Smooth => tint * (0.9 + 0.2 * noise(at * 1.5)),
        BarkKind::Furrowed => {
            let furrow = noise(Vec2::new(at.x * 9.0, at.y * 1.6));
            dark.lerp(tint * 1.15, (1.7 * furrow).min(1.0))
        }
        BarkKind::Plated => {
            let plate = noise(Vec2::new(at.x * 4.0, at.y * 2.5));
            // Pines are grey at the foot, and fox-red where the bark peels thin above.
            let red = Vec3::new(0.42, 0.17, 0.07);
            let upper = ((height - 14.0) / 22.0).clamp(0.0, 1.0);
            tint.lerp(red, upper) * (0.55 + 0.7 * plate)
        }
        BarkKind::Papery => {
            let mark = noise(Vec2::new(at.x * 1.3, at.y * 7.0));
            if mark > 0.72 { Vec3::splat(0.03) } else { tint * (0.85 + 0.25 * noise(at * 3.0)) }
        }
        BarkKind::Flaking => {
            let flake = noise(at * 1.7);
            let pale = Vec3::new(0.62, 0.58, 0.4);
            if flake > 0.55 {
                pale
            } else if flake > 0.42 {
                tint
            } else {
                tint * 0.6
            }
        }
        BarkKind::Banded => {
            let band = noise(Vec2::new(at.x * 0.7, at.y * 9.0));
            tint * (0.65 + 0.7 * band)
        }
        BarkKind::Stringy => {
            let string = noise(Vec2::new(at.x * 14.0, at.y * 0.7));
            dark.lerp(tint * 1.1, string)
        }
    }
}

/// Smooth noise from 0 to 1, with detail of about one unit.
fn noise(at: Vec2) -> f32 {
    let cell = at.floor();
    let t = at - cell;
    let t = t * t * (Vec2::splat(3.0) - 2.0 * t);
    let value = |x: i32, y: i32| {
        let (x, y) = (cell.x as i32 + x, cell.y as i32 + y);
        hash(x as u32 ^ hash(y as u32)) as f32 / u32::MAX as f32
    };
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    mix(mix(value(0, 0), value(1, 0), t.x), mix(value(0, 1), value(1, 1), t.x), t.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_has_no_steps() {
        let step = Vec2::new(0.003, 0.002);
        let mut at = Vec2::new(-3.0, 2.5);
        for _ in 0..3000 {
            let (here, there) = (noise(at), noise(at + step));
            assert!((0.0..=1.0).contains(&here) && (here - there).abs() < 0.02);
            at += step;
        }
    }

    #[test]
    fn birch_is_white_with_black_marks() {
        let white = Vec3::splat(0.8);
        let brightness = (0..4000).map(|i| {
            colour(BarkKind::Papery, white, Vec2::new((i % 40) as f32, i as f32) * 0.13, 1.0, 5.0).y
        });
        let marks = brightness.filter(|&y| y < 0.1).count();
        assert!((200..2000).contains(&marks), "{marks}");
        assert!(colour(BarkKind::Papery, white, Vec2::ZERO, 0.2, 5.0).y < 0.1, "its twigs are dark");
    }
}
