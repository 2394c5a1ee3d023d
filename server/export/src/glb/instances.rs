//! Leaves as places of few meshes (`EXT_mesh_gpu_instancing`).

use glam::Vec3;
use serde_json::json;

use super::{
    vertex::{Attribute, Vertex},
    writer::Writer,
};
use crate::{
    ExportError,
    assembly::Scatter,
    foliage::cards::{Cards, LeafForm},
    gltf::{FLOAT, Node, SHORT, UNSIGNED_BYTE},
};

const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// The places of one prototype, as they stand in the file.
#[derive(Default)]
struct Places {
    count: usize,
    translations: Vec<u8>,
    /// Quaternions in 16 bits.
    rotations: Vec<u8>,
    scales: Vec<u8>,
    /// Linear, 8 bits.
    colours: Vec<u8>,
}

/// Adds a node for each prototype that has leaves.
pub(super) fn scatter(writer: &mut Writer<'_>, scatter: &Scatter<'_>) -> Result<(), ExportError> {
    let mut places: [Places; LeafForm::PROTOTYPES] = Default::default();
    let (origin, scale) = (writer.origin(), writer.scale);
    let mut is_finite = true;
    (scatter.each)(&mut |(instance, hue)| {
        let to = &mut places[instance.prototype];
        to.count += 1;
        let place = (instance.place - origin) * scale;
        is_finite &= place.is_finite();
        to.translations.extend(place.to_array().iter().flat_map(|part| part.to_le_bytes()));
        let turn = instance.rotation.to_array().map(|part| (part * f32::from(i16::MAX)).round() as i16);
        to.rotations.extend(turn.iter().flat_map(|part| part.to_le_bytes()));
        to.scales.extend([instance.scale * scale; 3].iter().flat_map(|part| part.to_le_bytes()));
        let colour = (hue * scatter.strength).clamp(Vec3::ZERO, Vec3::ONE) * 255.0;
        to.colours.extend(colour.to_array().map(|part| part.round() as u8));
        to.colours.push(255);
        Ok(())
    })?;
    if !is_finite {
        return Err(ExportError::NotFinite);
    }
    for (which, places) in places.iter().enumerate().filter(|(_, places)| places.count > 0) {
        let mesh = prototype(writer, scatter, which)?;
        let mut accessor = |bytes: &[u8], component_type, shape| -> Result<usize, ExportError> {
            let view = writer.whole_view(bytes, None)?;
            let attribute = Attribute { offset: 0, component_type, shape };
            Ok(writer.accessor(view, attribute, component_type != FLOAT, places.count))
        };
        let attributes = json!({
            "TRANSLATION": accessor(&places.translations, FLOAT, "VEC3")?,
            "ROTATION": accessor(&places.rotations, SHORT, "VEC4")?,
            "SCALE": accessor(&places.scales, FLOAT, "VEC3")?,
            "_COLOR_0": accessor(&places.colours, UNSIGNED_BYTE, "VEC4")?,
        });
        writer.require(EXTENSION);
        let extensions = Some(json!({ EXTENSION: { "attributes": attributes } }));
        let name = format!("{} {which}", scatter.name);
        writer.adopt(Node { name, mesh: Some(mesh), extensions, ..Node::default() }, 0);
    }
    Ok(())
}

/// The mesh of a prototype, one internode long, which all nodes share.
fn prototype(writer: &mut Writer<'_>, scatter: &Scatter<'_>, which: usize) -> Result<usize, ExportError> {
    let key = (scatter.form.level(), which);
    if let Some(&mesh) = writer.prototypes.get(&key) {
        return Ok(mesh);
    }
    let mut cards = Cards::default();
    scatter.form.add_prototype(&mut cards, which);
    let mut part = writer.begin_plain();
    let (bound, wind) = Default::default();
    for (index, &place) in cards.mesh.positions.iter().enumerate() {
        let (normal, uv) = (cards.mesh.normals[index], cards.mesh.uvs[index]);
        let (tangent, colour) = (cards.tangents[index], Vec3::ONE);
        part.vertex(writer, &Vertex { place, normal, tangent, uv, colour, lit: uv, bound, wind })?;
    }
    let mesh = part
        .mesh(writer, format!("{} {which}", scatter.name), &[(&cards.mesh.indices, scatter.surface)])?
        .ok_or(ExportError::NotFinite)?;
    writer.prototypes.insert(key, mesh);
    Ok(mesh)
}
