//! What a season, little vigor and a look's orientation make of a leaf.

use espalier_mesh::leaves::Leaf;
use espalier_settings::LeafLook;
use glam::Vec3;

use super::{blades::share, canvas::linear};

/// Leaves that have just come.
const FRESH: [u8; 3] = [172, 196, 88];
/// Leaves in autumn, from those that only lose their green to those that turn red.
const YELLOW: [u8; 3] = [226, 184, 54];
const RED: [u8; 3] = [196, 66, 30];
/// Leaves that still hang in winter.
const WITHERED: [u8; 3] = [132, 96, 58];
/// Of what the seasons do, so much happens to leaves that stay.
const EVERGREEN: f32 = 0.15;

/// What is left of a leaf in its season, as it hangs; nothing of one that has fallen. `vigor` is 0 to 1.
pub(super) fn dressed(leaf: &Leaf, look: &LeafLook, vigor: f32) -> Option<(Leaf, Vec3)> {
    let evergreen = look.shape.is_evergreen();
    let felt = if evergreen { EVERGREEN } else { 1.0 };
    let season = look.season;
    // No two leaves turn on the same day.
    let (early, late) = (share(leaf.random), share(0.5 * leaf.random + 0.25));
    let fallen = ramp(2.15, 3.0, season);
    if !evergreen && fallen > 0.0 && early < fallen {
        return None;
    }
    let young = 1.0 - ramp(0.0, 0.8, season);
    let size = leaf.size * (1.0 - 0.65 * young * felt);
    let turned = (1.6 * ramp(1.1, 2.0, season) - 0.6 * late).clamp(0.0, 1.0) * felt;
    let weak = look.vigor_shift * (1.0 - vigor);
    // What turns red does so in autumn, or where a shoot is starved.
    let redness = (look.vigor_shift * (0.55 + 0.6 * late) - 0.08).clamp(0.0, 1.0);
    let autumn = linear(YELLOW).lerp(linear(RED), redness);
    let mut colour = linear(look.tint);
    colour = colour.lerp(linear(FRESH), 0.6 * young * felt);
    colour = colour.lerp(autumn, turned.max(0.45 * weak * felt.max(0.5)));
    colour = colour.lerp(linear(WITHERED), 0.7 * ramp(2.3, 3.0, season) * felt);
    Some((oriented(Leaf { size, ..*leaf }, look.orientation), colour))
}

/// The colour of leaves on middling shoots, all of them taken together; none where all have fallen.
pub(crate) fn mean_colour(look: &LeafLook) -> Option<Vec3> {
    const SAMPLES: u32 = 64;
    let sample = |i: u32| Leaf {
        base: Vec3::ZERO,
        direction: Vec3::X,
        normal: Vec3::Y,
        size: 1.0,
        random: (i as f32 + 0.5) / SAMPLES as f32,
    };
    let hanging = (0..SAMPLES).filter_map(|i| dressed(&sample(i), look, 0.5));
    let (sum, count) = hanging.fold((Vec3::ZERO, 0.0), |(sum, count), (_, tint)| (sum + tint, count + 1.0));
    (count > 0.0).then(|| sum / count)
}

/// The leaf hanging (-1) or raised (1).
fn oriented(leaf: Leaf, orientation: f32) -> Leaf {
    let way = if orientation < 0.0 { -Vec3::Y } else { Vec3::Y };
    let direction = leaf.direction.lerp(way, 0.8 * orientation.abs()).normalize_or(leaf.direction);
    let normal = leaf.normal.reject_from_normalized(direction).normalize_or(leaf.normal);
    Leaf { direction, normal, ..leaf }
}

/// 0 up to `low`, 1 from `high` on.
fn ramp(low: f32, high: f32, at: f32) -> f32 {
    ((at - low) / (high - low)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use espalier_settings::{Appearance, LeafKind};

    use super::*;

    const LEAF: Leaf =
        Leaf { base: Vec3::ZERO, direction: Vec3::X, normal: Vec3::Y, size: 1.0, random: 0.37 };

    fn in_season(shape: LeafKind, season: f32) -> Option<(Leaf, Vec3)> {
        dressed(&LEAF, &LeafLook { shape, season, ..Appearance::default().leaves }, 1.0)
    }

    #[test]
    fn leaves_burst_turn_and_fall() {
        let [burst, summer, autumn] =
            [0.0, 1.0, 2.0].map(|season| in_season(LeafKind::Ovate, season).expect("it hangs"));
        assert!(burst.0.size < 0.5 * summer.0.size);
        assert!(summer.1.y > summer.1.x && autumn.1.x > autumn.1.y, "{} turns {}", summer.1, autumn.1);
        assert_eq!(in_season(LeafKind::Ovate, 3.0), None);
    }

    #[test]
    fn evergreens_stay_green_in_winter() {
        let (leaf, colour) = in_season(LeafKind::Needle, 3.0).expect("it hangs");
        assert!(leaf.size == 1.0 && colour.y > colour.x, "{colour}");
    }

    #[test]
    fn weak_shoots_have_warmer_leaves() {
        let look = LeafLook { vigor_shift: 1.0, ..Appearance::default().leaves };
        let warmth = |vigor| {
            let (_, colour) = dressed(&LEAF, &look, vigor).expect("it hangs");
            colour.x / colour.y
        };
        assert!(warmth(0.0) > warmth(0.5) && warmth(0.5) > warmth(1.0));
    }

    #[test]
    fn orientation_lifts_and_lowers_leaves() {
        let tip = |orientation| oriented(LEAF, orientation).direction.y;
        assert!(tip(-1.0) < -0.9 && tip(0.0) == 0.0 && tip(1.0) > 0.9);
    }
}
