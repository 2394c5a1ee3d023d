//! Wavefront OBJ with its materials (MTL) and textures, in one ZIP file, in metres, Y up.

use std::io::Write;

use espalier_mesh::{Style, TriangleMesh};
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::Vec3;
use serde_json::Value;

use crate::{
    About, ExportError, Model, Sink,
    assembly::{Assembly, Builder, Part, Scatter},
    colour::encoded,
    mean_materials::{MeanMaterial, MeanMaterials, Telling},
    surface::ONE_CELL,
    zip::Zip,
};

/// The present of `plant`; see `docs/formats.md`.
///
/// # Errors
/// Where an internode cannot be as long as `about` says, the plant is too large, or the file cannot be written.
pub fn obj(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let scale = about.scale()?;
    // There are no places of meshes in this format, and a vertex has one place in a texture.
    let model = Model { instanced: false, lightmap: None, ..*model };
    let assembly = Assembly::of(plant, style, appearance, about.species, &model);
    let mut zip = Zip::deflated(out);
    let mut materials = MeanMaterials::of(&assembly, Telling::Cells)?;
    zip.add("tree.obj", |out| {
        writeln!(out, "# {}, metres, Y up", about.program)?;
        if let Some(copyright) = about.copyright() {
            writeln!(out, "# {}", copyright.replace(['\n', '\r'], " "))?;
        }
        writeln!(out, "mtllib tree.mtl")?;
        let mut writer =
            Writer { out, scale, names: Vec::new(), vertices: 0, places: 0, materials: &mut materials };
        assembly.build(&mut writer)
    })?;
    zip.add("tree.mtl", |out| {
        materials.all.iter().try_for_each(|material| Ok(out.write_all(library(material, scale).as_bytes())?))
    })?;
    for (name, png) in materials.all.iter().flat_map(MeanMaterial::pictures) {
        zip.add_packed(&name, |out| Ok(out.write_all(&png)?))?;
    }
    zip.finish()
}

/// A material as the library of materials has it.
fn library(material: &MeanMaterial, metres: f32) -> String {
    let name = &material.name;
    // Some readers multiply the picture by it, others take the picture alone.
    let plain = if material.texture.is_some() { Vec3::ONE } else { material.mean() };
    let [r, g, b] = encoded(plain).map(|part| f32::from(part) / 255.0);
    let mut text = format!("newmtl {name}\nKd {r:.4} {g:.4} {b:.4}\nKs 0 0 0\nillum 1\n");
    if let Some((texture, relief)) = &material.texture {
        let [colour, normal] = ["colour", "normal"].map(|kind| material.picture(kind));
        // The relief is the same in all cells of the colours.
        let [across, up] = material.cells();
        let scale = if [across, up] == ONE_CELL { String::new() } else { format!("-s {across} {up} 1 ") };
        text += &format!("map_Kd {colour}\nnorm -bm {relief} {scale}{normal}\n");
        if material.is_cut_out {
            // Cover stands in the alpha channel of the picture.
            text += &format!("map_d -imfchan m {colour}\n");
        }
        if let Some(depth) = &texture.depth {
            // What the darkest means, and how much more the lightest.
            let [(_, far), (_, near)] = depth.about(metres);
            text += &format!("disp -mm {far} {} {}\n", near - far, material.picture("depth"));
        }
    }
    text + "\n"
}

struct Writer<'a> {
    out: &'a mut dyn Write,
    scale: f32,
    /// The names of the nodes that are open.
    names: Vec<String>,
    /// Vertices with place, picture and normal, and those with a place only: the format counts from 1.
    vertices: usize,
    places: usize,
    materials: &'a mut MeanMaterials,
}

impl Writer<'_> {
    fn group(&mut self, name: &str) -> Result<(), ExportError> {
        let all: Vec<String> = self.names.iter().map(|name| name.replace(char::is_whitespace, "_")).collect();
        Ok(writeln!(self.out, "o {}_{name}", all.join("_"))?)
    }

    /// Triangles whose first place and first vertex have the numbers after these.
    fn faces(&mut self, faces: &[[u32; 3]], [places, vertices]: [usize; 2]) -> Result<(), ExportError> {
        for corners in faces {
            let [a, b, c] = corners.map(|corner| corner as usize + 1);
            let [pa, pb, pc] = [a, b, c].map(|corner| corner + places);
            let [a, b, c] = [a, b, c].map(|corner| corner + vertices);
            writeln!(self.out, "f {pa}/{a}/{a} {pb}/{b}/{b} {pc}/{c}/{c}")?;
        }
        Ok(())
    }

    fn place(&self, place: Vec3) -> Result<Vec3, ExportError> {
        let place = place * self.scale;
        if place.is_finite() { Ok(place) } else { Err(ExportError::NotFinite) }
    }
}

impl Builder<'_> for Writer<'_> {
    fn begin(&mut self, name: &str, _: Vec3, _: Option<Value>) -> Result<(), ExportError> {
        self.names.push(name.to_owned());
        Ok(())
    }

    fn end(&mut self) -> Result<(), ExportError> {
        self.names.pop();
        Ok(())
    }

    fn part(&mut self, part: &Part<'_>) -> Result<(), ExportError> {
        let (mut is_begun, mut material) = (false, None);
        (part.blocks)(&mut |block| {
            if block.mesh.positions.is_empty() {
                return Ok(());
            }
            if !is_begun {
                self.group(part.name)?;
                is_begun = true;
            }
            for (index, &place) in block.mesh.positions.iter().enumerate() {
                let Vec3 { x, y, z } = self.place(place)?;
                let (mut uv, normal) = (block.mesh.uvs[index], block.mesh.normals[index]);
                if let [thin] = part.surfaces {
                    uv = self.materials.place(thin, self.materials.shade(thin, block.colours[index]), uv);
                }
                writeln!(self.out, "v {x} {y} {z}\nvt {} {}", uv.x, uv.y)?;
                writeln!(self.out, "vn {:.4} {:.4} {:.4}", normal.x, normal.y, normal.z)?;
            }
            for (indices, surface) in [&block.mesh.indices[..], block.second].into_iter().zip(part.surfaces) {
                if !indices.is_empty() {
                    self.materials.add(surface, &block);
                    if material != Some(surface.name()) {
                        material = Some(surface.name());
                        writeln!(self.out, "usemtl {}", surface.name())?;
                    }
                    self.faces(indices.as_chunks().0, [self.places, self.vertices])?;
                }
            }
            self.vertices += block.mesh.positions.len();
            self.places += block.mesh.positions.len();
            Ok(())
        })
    }

    fn scatter(&mut self, _: &Scatter<'_>) -> Result<(), ExportError> {
        Ok(())
    }

    fn hull(&mut self, name: &str, mesh: &TriangleMesh) -> Result<(), ExportError> {
        writeln!(self.out, "o {}", name.replace(char::is_whitespace, "_"))?;
        for &place in &mesh.positions {
            let Vec3 { x, y, z } = self.place(place)?;
            writeln!(self.out, "v {x} {y} {z}")?;
        }
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| corner as usize + 1 + self.places);
            writeln!(self.out, "f {a} {b} {c}")?;
        }
        self.places += mesh.positions.len();
        Ok(())
    }
}
