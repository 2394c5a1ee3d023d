//! USD as text (`.usda`), and with its textures in one file (`.usdz`) or beside it (`.usda.zip`), in metres, Y up.

mod arrays;
mod materials;
mod skel;
mod writer;

use std::io::Write;

use espalier_mesh::Style;
use espalier_plant::Plant;
use espalier_settings::Appearance;
use serde_json::Value;

use self::writer::Writer;
use crate::{
    About, ExportError, Model, Sink,
    assembly::Assembly,
    mean_materials::{MeanMaterial, MeanMaterials, Telling},
    swaying::Swaying,
    zip::Zip,
};

/// The prim that holds all others.
const ROOT: &str = "Plants";

/// The present of `plant` as USD in text, without textures: each vertex has its colour; see `docs/formats.md`.
///
/// # Errors
/// Where an internode cannot be as long as `about` says, the plant is too large, or the file cannot be written.
pub fn usda(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let swaying = swaying(plant, style, appearance, about, model)?;
    let assembly = Assembly::of(plant, style, appearance, about.species, model).moved_by(swaying.as_ref());
    let materials = MeanMaterials::of(&assembly, Telling::Materials)?;
    layer(&assembly, about, model, (Pictures::Without, swaying.as_ref()), materials, out)?;
    Ok(())
}

/// The same in a package with its textures, as tablets show it.
///
/// # Errors
/// Those of [`usda`].
pub fn usdz(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    package(plant, style, appearance, about, model, Zip::new(out))
}

/// The same layer and textures as files of their own in a ZIP file that is to be unpacked.
///
/// # Errors
/// Those of [`usda`].
pub fn usda_zip(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    package(plant, style, appearance, about, model, Zip::deflated(out))
}

fn package(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    mut zip: Zip<'_>,
) -> Result<(), ExportError> {
    let swaying = swaying(plant, style, appearance, about, model)?;
    let assembly = Assembly::of(plant, style, appearance, about.species, model).moved_by(swaying.as_ref());
    let telling = if model.instanced { Telling::CellsOfForms } else { Telling::Cells };
    let mut materials = Some(MeanMaterials::of(&assembly, telling)?);
    zip.add("tree.usda", |out| {
        let Some(known) = materials.take() else { return Ok(()) };
        materials = Some(layer(&assembly, about, model, (Pictures::Beside, swaying.as_ref()), known, out)?);
        Ok(())
    })?;
    for (name, png) in materials.iter().flat_map(|materials| &materials.all).flat_map(MeanMaterial::pictures)
    {
        zip.add_packed(&name, |out| Ok(out.write_all(&png)?))?;
    }
    zip.finish()
}

/// How the plants move, where that is asked for.
fn swaying(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
) -> Result<Option<Swaying>, ExportError> {
    let scale = about.scale()?;
    Ok(model.sway.map(|_| Swaying::of(plant, style, &appearance.wind, scale, about.obstacles)))
}

/// Where the pictures of materials are.
#[derive(Clone, Copy, PartialEq)]
enum Pictures {
    Without,
    /// In files beside the layer.
    Beside,
}

fn layer(
    assembly: &Assembly<'_>,
    about: &About<'_>,
    model: &Model,
    (pictures, swaying): (Pictures, Option<&Swaying>),
    materials: MeanMaterials,
    out: &mut dyn Write,
) -> Result<MeanMaterials, ExportError> {
    let scale = about.scale()?;
    let quoted = |text: &str| Value::from(text.replace(['\n', '\r'], " ")).to_string();
    let said = quoted(&about.extras().to_string());
    let doc = about.copyright().map(|said| format!("    doc = {}\n", quoted(&said))).unwrap_or_default();
    let time = swaying.map(skel::time).unwrap_or_default();
    write!(
        out,
        "#usda 1.0\n(\n{doc}    customLayerData = {{\n        string creator = {}\n        string espalier = {said}\n    }}\n    \
         defaultPrim = \"{ROOT}\"\n    metersPerUnit = 1\n{time}    upAxis = \"Y\"\n)\n\n\
         def Xform \"{ROOT}\" (\n    kind = \"group\"\n)\n{{\n",
        quoted(about.program)
    )?;
    let mut writer = Writer { out, scale, model, open: Vec::new(), skeleton: None, materials };
    assembly.build(&mut writer)?;
    let Writer { out, materials, .. } = writer;
    materials::write(&materials, pictures, scale, out)?;
    writeln!(out, "}}")?;
    Ok(materials)
}
