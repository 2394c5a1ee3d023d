//! Leaves, flowers and fruits: an atlas of four pictures in the colours of a look.

use espalier_settings::{FlowerLook, FruitLook, LeafLook, OrnamentNature};
use glam::Vec3;

use super::Texture;
use crate::{
    colour::linear,
    foliage::{
        leaf_look::{Hues, LeafPainter},
        ornaments,
    },
    painted::Painted,
};

/// Of twigs that sprays grow on.
const TWIG: Vec3 = Vec3::new(0.150, 0.095, 0.055);
/// Of the stalks of flowers and fruits.
const STALK: Vec3 = Vec3::new(0.130, 0.130, 0.045);
/// A colour is divided by no less, or one without red would make the red of its texture infinite.
const DARKEST: f32 = 0.02;

/// A texture for many things of one kind, each of which has a colour of its own.
#[derive(Clone, Debug)]
pub(crate) struct Thin {
    pub texture: Texture,
    /// What colours are multiplied by before the texture multiplies them, so that neither exceeds 1.
    pub strength: f32,
}

/// Leaves in their season.
pub(crate) fn leaves(look: &LeafLook) -> Thin {
    let painter = LeafPainter::new(look);
    let Hues { middle, margin } = painter.typical();
    let is_spray = look.shape.nature().is_spray;
    let second = |hue: Vec3| {
        if is_spray { hue * Vec3::new(1.30, 1.35, 0.95) } else { hue * 1.15 + Vec3::new(0.035, 0.035, 0.006) }
    };
    thin(
        &Painted::leaf(look.shape),
        middle,
        painter.brightest(),
        |[shade, tone, _, _], [_, _, wood, edge]| {
            let hue = middle.lerp(margin, edge);
            (hue.lerp(second(hue), tone) * (2.0 * shade)).lerp(TWIG * (2.0 * shade), wood)
        },
    )
}

/// Flowers, if there are any.
pub(crate) fn flowers(look: &FlowerLook) -> Option<Thin> {
    Some(ornaments(&Painted::flower(look.kind)?, &look.kind.nature()?, linear(look.tint)))
}

/// Fruits, if there are any.
pub(crate) fn fruits(look: &FruitLook) -> Option<Thin> {
    Some(ornaments(&Painted::fruit(look.kind)?, &look.kind.nature()?, linear(look.tint)))
}

fn ornaments(painted: &Painted, nature: &OrnamentNature, tint: Vec3) -> Thin {
    let second = linear(nature.second);
    thin(painted, tint, ornaments::brightest(tint), |[shade, tone, _, _], [_, _, wood, _]| {
        (tint.lerp(second, tone) * (2.0 * shade)).lerp(STALK * (2.0 * shade), wood)
    })
}

/// `albedo` says what a texel looks like on a thing of the colour `hue`; no thing is brighter than `brightest`.
fn thin(painted: &Painted, hue: Vec3, brightest: f32, albedo: impl Fn([f32; 4], [f32; 4]) -> Vec3) -> Thin {
    let shares = |texel: &[u8; 4]| texel.map(|byte| f32::from(byte) / 255.0);
    let ratio = |(colours, relief)| albedo(shares(colours), shares(relief)) / hue.max(Vec3::splat(DARKEST));
    let mut colours: Vec<Vec3> = painted.colours.iter().zip(&painted.relief).map(ratio).collect();
    let cover: Vec<u8> = painted.colours.iter().map(|texel| texel[3]).collect();
    let is_there = |&(at, _): &(usize, &Vec3)| cover[at] >= 128;
    let inside = || colours.iter().enumerate().filter(is_there).map(|(_, &colour)| colour);
    let peak = inside().fold(0.0, |most: f32, colour| most.max(colour.max_element()));
    let mean = inside().sum::<Vec3>() / inside().count().max(1) as f32;
    let strength = peak.min(1.0 / brightest.max(DARKEST)).max(DARKEST);
    for (colour, &cover) in colours.iter_mut().zip(&cover) {
        // Coarser levels mix in what lies outside.
        let seen = if cover < 32 { mean } else { *colour };
        *colour = (seen / strength).clamp(Vec3::ZERO, Vec3::ONE);
    }
    let normals = painted.relief.iter().zip(&cover).map(|(relief, &cover)| {
        let [x, y] = [relief[0], relief[1]].map(|byte| (f32::from(byte) - 128.0) / 127.0);
        let out = (1.0 - x * x - y * y).max(0.05).sqrt();
        if cover < 32 { Vec3::Z } else { Vec3::new(x, y, out).normalize() }
    });
    let normals = normals.collect();
    let (side, exposure, depth) = (painted.side, None, None);
    Thin { texture: Texture { side, colours, cover, normals, exposure, depth }, strength }
}

#[cfg(test)]
mod tests {
    use espalier_settings::{FlowerKind, LeafKind};

    use super::*;

    /// The mean colour of what a thing of this colour shows.
    fn seen(thin: &Thin, hue: Vec3) -> Vec3 {
        let Texture { colours, cover, .. } = &thin.texture;
        let inside: Vec<Vec3> =
            colours.iter().zip(cover).filter(|(_, cover)| **cover >= 128).map(|(c, _)| *c).collect();
        inside.iter().sum::<Vec3>() / inside.len() as f32 * hue * thin.strength
    }

    #[test]
    fn leaves_have_about_the_colour_they_are_painted_in() {
        for &shape in LeafKind::ALL {
            for season in [0.2, 1.0, 2.0] {
                let look = LeafLook { shape, season, ..LeafLook::default() };
                let hue = LeafPainter::new(&look).typical().middle;
                let thin = leaves(&look);
                assert!(hue.max_element() * thin.strength <= 1.001, "{shape:?}");
                let share = seen(&thin, hue) / hue;
                assert!(share.y > 0.6 && share.y < 1.6, "{shape:?} in {season}: {share}");
            }
        }
    }

    #[test]
    fn white_petals_are_white() {
        let look = FlowerLook { kind: FlowerKind::Rosette, tint: [250, 250, 250], ..Default::default() };
        let thin = flowers(&look).expect("a flower");
        assert!(seen(&thin, linear(look.tint)).min_element() > 0.6);
        assert!(flowers(&FlowerLook::default()).is_none());
    }
}
