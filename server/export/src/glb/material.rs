//! The materials of a file, each made when it is first asked for.

use glam::Vec3;
use serde_json::{Value, json};

use super::writer::Writer;
use crate::{
    ExportError,
    assembly::Surface,
    gltf::{Image, Material, NormalTexture, PbrMetallicRoughness, Texture as TextureJson, TextureInfo},
    surface::{ONE_CELL, Texture},
};

impl Writer<'_> {
    /// The index of a material.
    pub(super) fn material(&mut self, surface: &Surface<'_>) -> Result<usize, ExportError> {
        let name = surface.name();
        if let Some(&index) = self.materials.get(name) {
            return Ok(index);
        }
        let material = match surface {
            Surface::Plain(_, colour) => plain(name, *colour, 0.9),
            Surface::Thin(_, texture) => {
                let mut material = plain(name, Vec3::ONE, 0.7);
                let pbr = &mut material.pbr_metallic_roughness;
                pbr.base_color_texture = Some(
                    self.texture(format!("{name} colour"), &texture.colour_png(&[Vec3::ONE], ONE_CELL))?,
                );
                material.normal_texture = Some(self.normals(name, texture, 1.0)?);
                material.alpha_mode = Some("MASK");
                material.double_sided = true;
                material.extras = self.depth(name, texture)?;
                material
            }
            Surface::Bark(bark, relief) => {
                let texture = &bark.texture;
                let mut material = plain(name, Vec3::ONE, 1.0);
                let exposure = match texture.exposure_png() {
                    Some(png) => Some(self.texture(format!("{name} occlusion and roughness"), &png)?),
                    None => None,
                };
                let pbr = &mut material.pbr_metallic_roughness;
                pbr.base_color_texture = Some(
                    self.texture(format!("{name} colour"), &texture.colour_png(&[Vec3::ONE], ONE_CELL))?,
                );
                pbr.metallic_roughness_texture = exposure;
                material.occlusion_texture = exposure;
                material.normal_texture = Some(self.normals(name, texture, *relief)?);
                material
            }
        };
        let index = self.root.materials.len();
        self.root.materials.push(material);
        self.materials.insert(name.to_owned(), index);
        Ok(index)
    }

    fn normals(&mut self, name: &str, texture: &Texture, scale: f32) -> Result<NormalTexture, ExportError> {
        let TextureInfo { index } = self.texture(format!("{name} normal"), &texture.normal_png())?;
        Ok(NormalTexture { index, scale })
    }

    /// Where a picture's depths are, and what they mean in metres: no material of glTF has a place for them.
    fn depth(&mut self, name: &str, texture: &Texture) -> Result<Option<Value>, ExportError> {
        let Some((depth, png)) = texture.depth.as_ref().zip(texture.depth_png()) else { return Ok(None) };
        let TextureInfo { index } = self.texture(format!("{name} depth"), &png)?;
        let [(far, black), (near, white)] = depth.about(self.scale);
        Ok(Some(json!({ "depth": { "texture": { "index": index }, far: black, near: white } })))
    }

    fn texture(&mut self, name: String, png: &[u8]) -> Result<TextureInfo, ExportError> {
        let buffer_view = self.whole_view(png, None)?;
        self.root.textures.push(TextureJson { source: self.root.images.len() });
        self.root.images.push(Image { name, mime_type: "image/png", buffer_view });
        Ok(TextureInfo { index: self.root.textures.len() - 1 })
    }
}

fn plain(name: &str, colour: Vec3, roughness: f32) -> Material {
    Material {
        name: name.to_owned(),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: colour.extend(1.0).to_array(),
            base_color_texture: None,
            metallic_factor: 0.0,
            roughness_factor: roughness,
            metallic_roughness_texture: None,
        },
        normal_texture: None,
        occlusion_texture: None,
        alpha_mode: None,
        double_sided: false,
        extras: None,
    }
}
