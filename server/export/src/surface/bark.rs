//! Bark: one texture for all wood, and the colour that each thickness of wood gives it.

use espalier_mesh::{RowDyes, Wood};
use espalier_settings::{BARK_BEGINS, BarkLook, LIMB_ENDS};
use glam::Vec3;

use super::Texture;
use crate::{
    colour::{linear, smooth},
    painted::{LAYOUT, Painted},
};

/// The colour of a cut.
pub(crate) const CUT: Vec3 = Vec3::new(0.41, 0.28, 0.16);
/// How rough ridges are, and furrows.
const ROUGHNESS: [f32; 2] = [0.8, 1.0];
/// Radii are asked for up to here; thicker wood looks the same.
const THICKEST: f32 = 1.0;

/// Bark of one look.
#[derive(Clone, Debug)]
pub(crate) struct Bark {
    pub texture: Texture,
    palette: Palette,
    /// Mean shares of the bark's own three colours.
    shares: Vec3,
    /// What colours of vertices are divided by, so that none exceeds 1.
    strength: f32,
}

/// Linear colours.
#[derive(Clone, Copy, Debug)]
struct Palette {
    trunk: Vec3,
    second: Vec3,
    third: Vec3,
    young: Vec3,
    limb: Vec3,
}

impl Palette {
    fn of(look: &BarkLook) -> Self {
        let (trunk, nature) = (linear(look.tint), look.kind.nature());
        let [second, third, young, limb] = [nature.second, nature.third, nature.young, nature.limb]
            .map(|mixture| Vec3::from_array(mixture.of(trunk.to_array())));
        Self { trunk, second, third, young, limb }
    }

    /// The colour where wood is so thick, of such shares of the bark's three colours.
    fn at(&self, radius: f32, shares: Vec3) -> Vec3 {
        let first = self.limb.lerp(self.trunk, smooth(LIMB_ENDS[0], LIMB_ENDS[1], radius));
        let own = first * (shares.x * LAYOUT.most_shade) + self.second * shares.y + self.third * shares.z;
        let young = self.young * (0.75 + 0.4 * shares.x);
        young.lerp(own, smooth(BARK_BEGINS[0], BARK_BEGINS[1], radius))
    }
}

impl Bark {
    /// Bark whose colour some branches multiply by so much at most; what has none of its own looks the same for all that.
    pub(crate) fn of(look: &BarkLook, greatest: f32) -> Self {
        let (painted, palette) = (Painted::bark(look.kind), Palette::of(look));
        let shares = |texel: &[u8; 4]| Vec3::new(texel[0].into(), texel[1].into(), texel[2].into()) / 255.0;
        let mean = painted.colours.iter().map(shares).sum::<Vec3>() / painted.colours.len() as f32;
        let plain = Texture {
            side: painted.side,
            colours: painted.colours.iter().map(|texel| palette.at(THICKEST, shares(texel))).collect(),
            cover: vec![255; painted.colours.len()],
            normals: painted.relief.iter().map(normal).collect(),
            exposure: Some(painted.relief.iter().map(exposure).collect()),
            depth: None,
        };
        let mut bark = Self { texture: plain, palette, shares: mean, strength: 1.0 };
        let radii = (0..=20).map(|step| THICKEST * step as f32 / 20.0);
        let own = radii.map(|radius| bark.tint(radius).max_element()).fold(1.0, f32::max);
        // Where no texel gets too bright there is room for those branches.
        let brightest = bark.texture.colours.iter().map(|colour| colour.max_element()).fold(1e-3, f32::max);
        bark.strength = own.max((own * greatest).min(1.0 / brightest));
        for colour in &mut bark.texture.colours {
            *colour = (*colour * bark.strength).min(Vec3::ONE);
        }
        bark
    }

    /// What the texture is multiplied by where wood is so thick.
    pub(crate) fn tint(&self, radius: f32) -> Vec3 {
        let [here, trunk] = [radius, THICKEST].map(|radius| self.palette.at(radius, self.shares));
        here / trunk.max(Vec3::splat(1e-3)) / self.strength
    }

    /// The same at each vertex of wood whose branches have these colours.
    pub(crate) fn tints(&self, wood: &Wood, dyes: &RowDyes) -> impl Iterator<Item = Vec3> {
        let vertices = wood.radii.iter().zip(&wood.metamers);
        vertices.map(|(&radius, &metamer)| self.tint(radius) * dyes.of(metamer).bark)
    }
}

/// The normal of a texel, from how the surface rises around the limb and along it.
fn normal(relief: &[u8; 4]) -> Vec3 {
    let [around, along] =
        [relief[0], relief[1]].map(|byte| (f32::from(byte) / 127.5 - 1.0) * LAYOUT.most_slope);
    Vec3::new(-around, -along, 1.0).normalize()
}

fn exposure(&[_, _, sky, height]: &[u8; 4]) -> [f32; 2] {
    let [ridge, furrow] = ROUGHNESS;
    [f32::from(sky) / 255.0, furrow + (ridge - furrow) * f32::from(height) / 255.0]
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use espalier_settings::BarkKind;
    use serde_json::{Value, json};

    use super::*;

    fn bark(kind: BarkKind, tint: [u8; 3]) -> Bark {
        Bark::of(&BarkLook { kind, tint, ..BarkLook::default() }, 1.0)
    }

    fn mean(bark: &Bark, radius: f32) -> Vec3 {
        let colours = &bark.texture.colours;
        colours.iter().sum::<Vec3>() / colours.len() as f32 * bark.tint(radius)
    }

    #[test]
    fn wood_of_each_thickness_has_its_colour() {
        for &kind in BarkKind::ALL {
            let bark = bark(kind, [121, 110, 97]);
            for radius in [0.0, 0.1, 0.3, 0.6, 2.0] {
                let wanted = bark.palette.at(radius, bark.shares);
                assert!(mean(&bark, radius).distance(wanted) < 0.03, "{kind:?} at {radius}");
                assert!(bark.tint(radius).max_element() <= 1.001);
            }
        }
    }

    #[test]
    fn wood_without_a_colour_of_its_own_is_the_same_beside_wood_of_any() {
        for &kind in BarkKind::ALL {
            for tint in [[121, 110, 97], [231, 231, 231]] {
                let look = BarkLook { kind, tint, ..BarkLook::default() };
                let [alone, beside] = [1.0, 4.0].map(|greatest| Bark::of(&look, greatest));
                for radius in [0.0, 0.1, 0.6, 2.0] {
                    let off = mean(&beside, radius).distance(mean(&alone, radius));
                    assert!(off < 1e-3, "{kind:?} at {radius}: {off}");
                }
            }
        }
    }

    #[test]
    fn birch_is_white_with_black_marks_and_its_twigs_are_dark() {
        let bark = bark(BarkKind::Papery, [231, 231, 231]);
        let black = bark.texture.colours.iter().filter(|colour| colour.y < 0.2).count();
        let share = black as f32 / bark.texture.colours.len() as f32;
        assert!((0.02..0.5).contains(&share), "{share}");
        assert!(mean(&bark, 1.0).y > 0.4 && mean(&bark, 0.02).y < 0.1);
    }

    /// Clients mix colours by themselves: both must find those in `golden/bark.json`.
    ///
    /// After a deliberate change: `UPDATE_GOLDEN=1 cargo test -p espalier-export bark`.
    #[test]
    fn bark_has_the_colours_that_were_written_down() {
        let samples: Value = BarkKind::ALL
            .iter()
            .enumerate()
            .map(|(i, &kind)| {
                let tint = [40 * i as u8, 200 - 20 * i as u8, 97];
                let Palette { trunk, second, third, young, limb } =
                    Palette::of(&BarkLook { kind, tint, ..BarkLook::default() });
                let palette = [trunk, second, third, young, limb]
                    .map(|colour| colour.to_array().map(|channel| (f64::from(channel) * 1e5).round() / 1e5));
                json!({ "kind": kind, "tint": tint, "palette": palette })
            })
            .collect();
        let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden/bark.json");
        if std::env::var_os("UPDATE_GOLDEN").is_some() {
            fs::write(&file, format!("{samples}\n")).expect("the samples can be written");
        }
        let stored = fs::read_to_string(&file).expect("the samples can be read");
        let stored: Value = serde_json::from_str(&stored).expect("the samples are JSON");
        let written: Value = serde_json::from_str(&samples.to_string()).expect("so are these");
        assert!(stored == written, "colours differ from golden/bark.json");
    }
}
