//! glTF 2.0 binary: each plant as a node with its wood, leaves, flowers and fruits, textured, in metres, Y up.

mod instances;
mod keys;
mod material;
mod packing;
mod skin;
mod vertex;
mod writer;

use espalier_mesh::{Style, TriangleMesh};
use espalier_motion::Rig;
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::{Vec2, Vec3, Vec4};
use serde_json::Value;

use self::{
    skin::{CAPACITY_OF_BONE, Skeleton},
    vertex::Vertex,
    writer::{Packing, Writer},
};
use crate::{
    About, ExportError, Model, Sink,
    assembly::{Assembly, Builder, Part, Scatter, Surface},
    gltf::{Asset, Scene},
    pivots::Elements,
    swaying::Swaying,
    wind_weights::WindWeights,
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
    let sways = model.sway.is_some() || model.wind_weights;
    let mut swaying = sways.then(|| Swaying::of(plant, style, &appearance.wind, scale, about.obstacles));
    if let Some(most) = model.sway {
        swaying = swaying.map(|swaying| swaying.blown(plant, most, out)).transpose()?;
    }
    Source { plant, style, appearance, about, model }.write(swaying.as_ref(), None, out)
}

/// What a file is made of.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub plant: &'a Plant,
    pub style: &'a Style,
    pub appearance: &'a Appearance,
    pub about: &'a About<'a>,
    pub model: &'a Model,
}

impl Source<'_> {
    /// Writes the file: with how the plants sway, and with second places of vertices in textures of elements, where these
    /// are asked for.
    pub(crate) fn write(
        &self,
        swaying: Option<&Swaying>,
        elements: Option<&Elements>,
        out: &mut dyn Sink,
    ) -> Result<(), ExportError> {
        let Self { plant, style, appearance, about, model } = *self;
        let scale = about.scale()?;
        let assembly = Assembly::of(plant, style, appearance, about.species, model).moved_by(swaying);
        let asset = Asset {
            version: "2.0",
            generator: about.program.to_owned(),
            copyright: about.copyright(),
            extras: about.extras(),
        };
        let capacity = match assembly.most_parts() {
            0 => 0,
            parts => {
                let bones = model.sway.unwrap_or_default() as usize * assembly.plants();
                let parts = parts * (CAPACITY_OF_PART + 8 * model.sway.unwrap_or_default() as usize);
                CAPACITY + serde_json::to_vec(&asset)?.len() + parts + bones * CAPACITY_OF_BONE
            }
        };
        let packing = Packing { is_quantised: model.quantised, is_compressed: model.compressed };
        let weights = swaying.filter(|_| model.wind_weights).map(WindWeights::of);
        let writer = Writer::new(out, asset, scale, packing, capacity)?;
        let mut file = File { writer, skeleton: None, weights, elements };
        assembly.build(&mut file)?;
        file.writer.finish()
    }
}

/// A file, the bones of the plant that is written, and how vertices move where they say so.
struct File<'w, 's> {
    writer: Writer<'w>,
    skeleton: Option<Skeleton<'s>>,
    weights: Option<WindWeights<'s>>,
    elements: Option<&'s Elements>,
}

impl<'s> Builder<'s> for File<'_, 's> {
    fn begin(&mut self, name: &str, place: Vec3, extras: Option<Value>) -> Result<(), ExportError> {
        self.writer.open(name, place, extras);
        Ok(())
    }

    fn end(&mut self) -> Result<(), ExportError> {
        self.writer.close();
        Ok(())
    }

    fn bones(&mut self, swaying: &'s Swaying, rig: Rig) -> Result<(), ExportError> {
        self.skeleton = Some(Skeleton::begin(&mut self.writer, swaying, rig)?);
        Ok(())
    }

    fn part(&mut self, part: &Part<'_>) -> Result<(), ExportError> {
        // What is not quantised has no bounds.
        let Self { writer, skeleton, weights, elements } = self;
        let elements = elements.filter(|_| part.rides);
        let skeleton = skeleton.as_ref().filter(|_| part.rides);
        let weights = weights.as_ref().filter(|_| part.rides);
        let reach = if writer.packing.is_quantised { part.reach(writer.origin())? } else { 1.0 };
        if !(reach * writer.scale).is_finite() {
            return Err(ExportError::NotFinite);
        }
        let mut vertices = writer.begin_part(part.repeats, reach);
        if let Some(map) = part.lightmap {
            vertices = vertices.with_lightmap(&map.about(writer.scale));
        }
        if elements.is_some() {
            vertices = vertices.with_elements();
        }
        if skeleton.is_some() {
            vertices = vertices.with_bones();
        }
        if let Some(weights) = weights {
            vertices = vertices.with_wind(&weights.measures().told());
        }
        let mut triangles = [Vec::new(), Vec::new()];
        (part.blocks)(&mut |block| {
            let first = vertices.count();
            for (index, &place) in block.mesh.positions.iter().enumerate() {
                let (normal, uv) = (block.mesh.normals[index], block.mesh.uvs[index]);
                let (tangent, colour) = (block.tangents[index], block.colours[index]);
                let rider = block.riders.get(index).copied();
                let texel = rider.zip(elements).map(|(rider, elements)| elements.texel(rider.row));
                let lit = texel.or(block.places.map(|places| places[index])).unwrap_or_default();
                let bound = rider.zip(skeleton).map(|(rider, skeleton)| skeleton.bound(rider));
                let metres = place * writer.scale;
                let wind = rider.zip(weights).map(|(rider, weights)| weights.of_vertex(rider, metres));
                let (bound, wind) = (bound.unwrap_or_default(), wind.unwrap_or_default());
                vertices.vertex(writer, &Vertex { place, normal, tangent, uv, colour, lit, bound, wind })?;
            }
            for (to, from) in triangles.iter_mut().zip([&block.mesh.indices[..], block.second]) {
                to.extend(from.iter().map(|&index| first + index));
            }
            Ok(())
        })?;
        let triangles: Vec<_> =
            triangles.iter().zip(part.surfaces).map(|(indices, &surface)| (&indices[..], surface)).collect();
        match skeleton {
            Some(skeleton) => vertices.finish_bound(writer, skeleton, part.name, &triangles),
            None => vertices.finish(writer, part.name, &triangles),
        }
    }

    fn scatter(&mut self, scatter: &Scatter<'_>) -> Result<(), ExportError> {
        instances::scatter(&mut self.writer, scatter)
    }

    fn hull(&mut self, name: &str, mesh: &TriangleMesh) -> Result<(), ExportError> {
        let writer = &mut self.writer;
        if writer.root.scenes.len() == 1 {
            writer.root.scenes.push(Scene { name: COLLISION, nodes: Vec::new() });
        }
        let reach = mesh.positions.iter().map(|place| (*place - writer.origin()).abs().max_element());
        let mut vertices = writer.begin_part(false, reach.fold(1.0, f32::max));
        for (&place, &normal) in mesh.positions.iter().zip(&mesh.normals) {
            let tangent: Vec4 = normal.any_orthonormal_vector().extend(1.0);
            let (uv, colour) = (Vec2::ZERO, Vec3::ONE);
            let (bound, wind) = Default::default();
            let vertex = Vertex { place, normal, tangent, uv, colour, lit: uv, bound, wind };
            vertices.vertex(writer, &vertex)?;
        }
        let surface = Surface::Plain(COLLISION, HULL);
        vertices.finish_apart(writer, name, &[(&mesh.indices, surface)])
    }
}
