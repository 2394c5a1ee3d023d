//! glTF 2.0 binary: each plant as a node with its wood, leaves, flowers and fruits, textured, in metres, Y up.

mod instances;
mod material;
mod packing;
mod vertex;
mod writer;

use espalier_mesh::{Style, TriangleMesh};
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::{Vec2, Vec3, Vec4};
use serde_json::Value;

use self::{
    vertex::Vertex,
    writer::{Packing, Writer},
};
use crate::{
    About, ExportError, Model, Sink,
    assembly::{Assembly, Builder, Part, Scatter, Surface},
    gltf::{Asset, Scene},
};

/// Bytes for the JSON: of materials and the scene, and of a part with its node, mesh, accessors and views.
const CAPACITY: usize = 12 * 1024;
const CAPACITY_OF_PART: usize = 3 * 1024;
/// The scene that only has hulls.
const COLLISION: &str = "Collision";
const HULL: Vec3 = Vec3::new(0.2, 0.6, 0.3);

/// The present of `plant` as a glTF binary file. A plant without wood gives a valid file without meshes.
///
/// # Errors
/// Where an internode cannot be as long as `about` says, the plant is too large, or the file cannot be written.
pub fn glb(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let scale = about.scale()?;
    let assembly = Assembly::of(plant, style, appearance, about.species, model);
    let asset = Asset {
        version: "2.0",
        generator: about.program.to_owned(),
        copyright: about.copyright(),
        extras: about.extras(),
    };
    let capacity = match assembly.most_parts() {
        0 => 0,
        parts => CAPACITY + serde_json::to_vec(&asset)?.len() + parts * CAPACITY_OF_PART,
    };
    let packing = Packing { is_quantised: model.quantised, is_compressed: model.compressed };
    let mut writer = Writer::new(out, asset, scale, packing, capacity)?;
    assembly.build(&mut writer)?;
    writer.finish()
}

impl Builder for Writer<'_> {
    fn begin(&mut self, name: &str, place: Vec3, extras: Option<Value>) -> Result<(), ExportError> {
        self.open(name, place, extras);
        Ok(())
    }

    fn end(&mut self) -> Result<(), ExportError> {
        self.close();
        Ok(())
    }

    fn part(&mut self, part: &Part<'_>) -> Result<(), ExportError> {
        // What is not quantised has no bounds.
        let reach = if self.packing.is_quantised { part.reach(self.origin())? } else { 1.0 };
        if !(reach * self.scale).is_finite() {
            return Err(ExportError::NotFinite);
        }
        let mut vertices = self.begin_part(part.repeats, reach);
        if let Some(map) = part.lightmap {
            vertices = vertices.with_lightmap(&map.about(self.scale));
        }
        let mut triangles = [Vec::new(), Vec::new()];
        (part.blocks)(&mut |block| {
            let first = vertices.count();
            for (index, &place) in block.mesh.positions.iter().enumerate() {
                let (normal, uv) = (block.mesh.normals[index], block.mesh.uvs[index]);
                let (tangent, colour) = (block.tangents[index], block.colours[index]);
                let lit = block.places.map_or(Vec2::ZERO, |places| places[index]);
                vertices.vertex(self, &Vertex { place, normal, tangent, uv, colour, lit })?;
            }
            for (to, from) in triangles.iter_mut().zip([&block.mesh.indices[..], block.second]) {
                to.extend(from.iter().map(|&index| first + index));
            }
            Ok(())
        })?;
        let triangles: Vec<_> =
            triangles.iter().zip(part.surfaces).map(|(indices, &surface)| (&indices[..], surface)).collect();
        vertices.finish(self, part.name, &triangles)
    }

    fn scatter(&mut self, scatter: &Scatter<'_>) -> Result<(), ExportError> {
        instances::scatter(self, scatter)
    }

    fn hull(&mut self, name: &str, mesh: &TriangleMesh) -> Result<(), ExportError> {
        if self.root.scenes.len() == 1 {
            self.root.scenes.push(Scene { name: COLLISION, nodes: Vec::new() });
        }
        let reach = mesh.positions.iter().map(|place| (*place - self.origin()).abs().max_element());
        let mut vertices = self.begin_part(false, reach.fold(1.0, f32::max));
        for (&place, &normal) in mesh.positions.iter().zip(&mesh.normals) {
            let tangent: Vec4 = normal.any_orthonormal_vector().extend(1.0);
            let (uv, colour) = (Vec2::ZERO, Vec3::ONE);
            let vertex = Vertex { place, normal, tangent, uv, colour, lit: uv };
            vertices.vertex(self, &vertex)?;
        }
        let surface = Surface::Plain(COLLISION, HULL);
        vertices.finish_apart(self, name, &[(&mesh.indices, surface)])
    }
}
