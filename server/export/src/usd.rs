//! USD as text (`.usda`), in binary (`.usdc`), and with its textures in one file (`.usdz`), in metres, Y up.

mod binary;
mod layer;
mod materials;
mod text;

use std::io::Write;

use espalier_mesh::{Style, TriangleMesh};
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::Vec3;
use serde_json::{Map, Value as Json};

use self::{
    binary::Binary,
    layer::{
        Done, Head, Layer, Prim, Row, Value,
        Variability::{Uniform, Varying},
    },
    text::Text,
};
use crate::{
    About, Detail, ExportError, Model, Sink,
    assembly::{Assembly, Builder, Part, Scatter},
    foliage::cards::{Cards, LeafForm},
    mean_materials::{MeanMaterial, MeanMaterials},
    zip::Zip,
};

/// The prim that holds all others.
const ROOT: &str = "Plants";
/// What a prim needs that has a material.
const BINDING: &[&str] = &["MaterialBindingAPI"];

/// The present of `plant` as USD in text, whose materials have one colour each; see `docs/formats.md`.
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
    let assembly = Assembly::of(plant, style, appearance, about.species, model);
    text(&assembly, about, model, false, out)?;
    Ok(())
}

/// The same in binary, which others read in a fraction of the time. All of it is held in memory while it is made.
///
/// # Errors
/// Those of [`usda`].
pub fn usdc(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    about: &About<'_>,
    model: &Model,
    out: &mut dyn Sink,
) -> Result<(), ExportError> {
    let assembly = Assembly::of(plant, style, appearance, about.species, model);
    let mut layer = head(about, |head| Ok(Binary::begin(head)))?;
    scene(&assembly, about, model, false, &mut layer)?;
    layer.write(out)
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
    let assembly = Assembly::of(plant, style, appearance, about.species, model);
    let mut zip = Zip::new(out);
    let mut materials = MeanMaterials::default();
    zip.add("tree.usda", |out| {
        materials = text(&assembly, about, model, true, out)?;
        Ok(())
    })?;
    for (name, png) in materials.0.iter().flat_map(MeanMaterial::pictures) {
        zip.add(&name, |out| Ok(out.write_all(&png)?))?;
    }
    zip.finish()
}

fn text(
    assembly: &Assembly<'_>,
    about: &About<'_>,
    model: &Model,
    has_pictures: bool,
    out: &mut dyn Write,
) -> Result<MeanMaterials, ExportError> {
    let mut layer = head(about, |head| Ok(Text::begin(head, out)?))?;
    scene(assembly, about, model, has_pictures, &mut layer)
}

/// What is said of the layer as a whole.
fn head<T>(
    about: &About<'_>,
    begin: impl FnOnce(&Head<'_>) -> Result<T, ExportError>,
) -> Result<T, ExportError> {
    let (extras, copyright) = (about.extras().to_string(), about.copyright());
    begin(&Head { program: about.program, extras: &extras, copyright: copyright.as_deref() })
}

/// All that stands in the scene, with its materials.
fn scene(
    assembly: &Assembly<'_>,
    about: &About<'_>,
    model: &Model,
    has_pictures: bool,
    layer: &mut dyn Layer,
) -> Result<MeanMaterials, ExportError> {
    let scale = about.scale()?;
    layer.begin(Prim { type_name: "Xform", name: ROOT, is_group: true, ..Prim::default() })?;
    let mut writer =
        Writer { layer: &mut *layer, scale, model, open: Vec::new(), materials: MeanMaterials::default() };
    assembly.build(&mut writer)?;
    let materials = writer.materials;
    materials::write(&materials, has_pictures, scale, layer)?;
    layer.end()?;
    Ok(materials)
}

struct Writer<'a> {
    layer: &'a mut dyn Layer,
    scale: f32,
    model: &'a Model,
    /// The names of the nodes that are open, and where they stand, in internodes.
    open: Vec<(String, Vec3)>,
    materials: MeanMaterials,
}

impl Writer<'_> {
    fn origin(&self) -> Vec3 {
        self.open.last().map_or(Vec3::ZERO, |(_, place)| *place)
    }

    /// A name below the open node as a path.
    fn path(&self, name: &str) -> String {
        let all: Vec<&str> = self.open.iter().map(|(name, _)| name.as_str()).chain([name]).collect();
        format!("/{ROOT}/{}", all.join("/"))
    }

    fn bound(&mut self, material: &str) -> Done {
        self.layer.related("material:binding", &[format!("/{ROOT}/Looks/{material}")], false)
    }

    /// The arrays that all meshes have.
    fn triangles(&mut self, mesh: &TriangleMesh, place: impl Fn(Vec3) -> Vec3) -> Done {
        let corners = mesh.indices.as_chunks::<3>().0;
        self.layer.numbers("faceVertexCounts", &mut |put| corners.iter().try_for_each(|_| put(3)))?;
        self.layer
            .numbers("faceVertexIndices", &mut |put| mesh.indices.iter().try_for_each(|&index| put(index)))?;
        self.layer.rows(Row::Point, "points", false, &mut |put| {
            mesh.positions.iter().try_for_each(|&position| put(&place(position).to_array()))
        })?;
        self.layer.rows(Row::Normal, "normals", true, &mut |put| {
            mesh.normals.iter().try_for_each(|normal| put(&normal.to_array()))
        })
    }
}

impl Builder<'_> for Writer<'_> {
    fn begin(&mut self, name: &str, place: Vec3, extras: Option<Json>) -> Done {
        let way = ((place - self.origin()) * self.scale).to_array();
        let name = identifier(name);
        let lod = extras.as_ref().and_then(|extras| extras["lod"].as_u64());
        let mut data = match extras {
            Some(Json::Object(data)) => data,
            _ => Map::new(),
        };
        data.retain(|_, value| value.is_u64());
        self.layer.begin(Prim {
            type_name: "Xform",
            name: &name,
            is_group: true,
            data,
            ..Prim::default()
        })?;
        self.layer.value(Varying, "xformOp:translate", &Value::Double3(way))?;
        self.layer.value(Uniform, "xformOpOrder", &Value::Tokens(&["xformOp:translate"]))?;
        if self.model.detail == Detail::Set && lod.is_some_and(|level| level > 0) {
            // All levels stand at the same place; who wants another shows it.
            self.layer.value(Varying, "visibility", &Value::Token("invisible"))?;
        }
        self.open.push((name, place));
        Ok(())
    }

    fn end(&mut self) -> Done {
        self.open.pop();
        self.layer.end()
    }

    fn part(&mut self, part: &Part<'_>) -> Done {
        let (origin, scale) = (self.origin(), self.scale);
        let [mut low, mut high] = [Vec3::MAX, Vec3::MIN];
        let mut triangles = [0, 0];
        (part.blocks)(&mut |block| {
            triangles[0] += block.mesh.indices.len() / 3;
            triangles[1] += block.second.len() / 3;
            for &place in &block.mesh.positions {
                let place = (place - origin) * scale;
                (low, high) = (low.min(place), high.max(place));
            }
            for (surface, indices) in part.surfaces.iter().zip([&block.mesh.indices[..], block.second]) {
                if !indices.is_empty() {
                    self.materials.add(surface, &block);
                }
            }
            Ok(())
        })?;
        if triangles == [0, 0] {
            return Ok(());
        }
        if !(low.is_finite() && high.is_finite()) {
            return Err(ExportError::NotFinite);
        }
        let (Ok(first), Ok(all)) = (u32::try_from(triangles[0]), u32::try_from(triangles[0] + triangles[1]))
        else {
            return Err(ExportError::TooLarge);
        };
        let mut data = Map::new();
        if let Some(map) = part.lightmap {
            data.insert("lightmap".into(), map.about(scale));
        }
        let layer = &mut *self.layer;
        layer.begin(Prim { type_name: "Mesh", name: part.name, apis: BINDING, data, ..Prim::default() })?;
        layer.value(Uniform, "subdivisionScheme", &Value::Token("none"))?;
        if part.surfaces.len() == 1 {
            layer.value(Uniform, "doubleSided", &Value::Bool(true))?;
        }
        layer.value(Varying, "extent", &Value::Float3s(&[low.to_array(), high.to_array()]))?;
        layer.numbers("faceVertexCounts", &mut |put| (0..all).try_for_each(|_| put(3)))?;
        layer.numbers("faceVertexIndices", &mut |put| {
            // The triangles of the second surface stand behind all others, so that they can be told by their numbers.
            for second in [false, true] {
                let mut first = 0;
                (part.blocks)(&mut |block| {
                    let indices = if second { block.second } else { &block.mesh.indices };
                    indices.iter().try_for_each(|index| put(first + index))?;
                    first += block.mesh.positions.len() as u32;
                    Ok(())
                })?;
            }
            Ok(())
        })?;
        layer.rows(Row::Point, "points", false, &mut |put| {
            (part.blocks)(&mut |block| {
                let mut places = block.mesh.positions.iter().map(|&place| (place - origin) * scale);
                places.try_for_each(|place| put(&place.to_array()))
            })
        })?;
        layer.rows(Row::Normal, "normals", true, &mut |put| {
            (part.blocks)(&mut |block| block.mesh.normals.iter().try_for_each(|way| put(&way.to_array())))
        })?;
        layer.rows(Row::Place, "primvars:st", true, &mut |put| {
            (part.blocks)(&mut |block| block.mesh.uvs.iter().try_for_each(|uv| put(&uv.to_array())))
        })?;
        if part.lightmap.is_some() {
            layer.rows(Row::Place, "primvars:st1", true, &mut |put| {
                (part.blocks)(&mut |block| {
                    let mut places = block.places.into_iter().flatten();
                    places.try_for_each(|place| put(&place.to_array()))
                })
            })?;
        }
        layer.rows(Row::Colour, "primvars:displayColor", true, &mut |put| {
            (part.blocks)(&mut |block| block.colours.iter().try_for_each(|colour| put(&colour.to_array())))
        })?;
        let [wood, cut] =
            [part.surfaces.first(), part.surfaces.get(1)].map(|one| one.map_or("", |one| one.name()));
        self.bound(wood)?;
        if all > first {
            let layer = &mut *self.layer;
            let family = "subsetFamily:materialBind:familyType";
            layer.value(Uniform, family, &Value::Token("nonOverlapping"))?;
            layer.begin(Prim { type_name: "GeomSubset", name: cut, apis: BINDING, ..Prim::default() })?;
            layer.value(Uniform, "elementType", &Value::Token("face"))?;
            layer.value(Uniform, "familyName", &Value::Token("materialBind"))?;
            layer.numbers("indices", &mut |put| (first..all).try_for_each(&mut *put))?;
            self.bound(cut)?;
            self.layer.end()?;
        }
        self.layer.end()
    }

    fn scatter(&mut self, scatter: &Scatter<'_>) -> Done {
        let (origin, scale, each) = (self.origin(), self.scale, scatter.each);
        let (mut sum, mut count) = (Vec3::ZERO, 0);
        let mut is_finite = true;
        each(&mut |(instance, hue)| {
            (sum, count) = (sum + hue * scatter.strength, count + 1);
            is_finite &= (instance.place * scale).is_finite();
            Ok(())
        })?;
        if count == 0 {
            return Ok(());
        }
        if !is_finite {
            return Err(ExportError::NotFinite);
        }
        self.materials.count(&scatter.surface, sum, count);
        let leaf = |which: usize| format!("{}/Leaf{which}", self.path(scatter.name));
        let prototypes: Vec<String> = (0..LeafForm::PROTOTYPES).map(leaf).collect();
        let layer = &mut *self.layer;
        layer.begin(Prim { type_name: "PointInstancer", name: scatter.name, ..Prim::default() })?;
        layer.related("prototypes", &prototypes, true)?;
        layer
            .numbers("protoIndices", &mut |put| each(&mut |(instance, _)| put(instance.prototype as u32)))?;
        layer.rows(Row::Point, "positions", false, &mut |put| {
            each(&mut |(instance, _)| put(&((instance.place - origin) * scale).to_array()))
        })?;
        layer.rows(Row::Rotation, "orientations", false, &mut |put| {
            each(&mut |(instance, _)| {
                let [x, y, z, w] = instance.rotation.to_array();
                put(&[w, x, y, z])
            })
        })?;
        layer.rows(Row::Float3, "scales", false, &mut |put| {
            each(&mut |(instance, _)| put(&[instance.scale * scale; 3]))
        })?;
        layer.rows(Row::Colour, "primvars:displayColor", true, &mut |put| {
            each(&mut |(_, hue)| put(&(hue * scatter.strength).to_array()))
        })?;
        for which in 0..LeafForm::PROTOTYPES {
            let mut cards = Cards::default();
            scatter.form.add_prototype(&mut cards, which);
            let name = format!("Leaf{which}");
            self.layer.begin(Prim { type_name: "Mesh", name: &name, apis: BINDING, ..Prim::default() })?;
            self.layer.value(Uniform, "subdivisionScheme", &Value::Token("none"))?;
            self.layer.value(Uniform, "doubleSided", &Value::Bool(true))?;
            self.triangles(&cards.mesh, |place| place)?;
            self.layer.rows(Row::Place, "primvars:st", true, &mut |put| {
                cards.mesh.uvs.iter().try_for_each(|uv| put(&uv.to_array()))
            })?;
            self.bound(scatter.surface.name())?;
            self.layer.end()?;
        }
        self.layer.end()
    }

    fn hull(&mut self, name: &str, mesh: &TriangleMesh) -> Done {
        let (origin, scale) = (self.origin(), self.scale);
        let apis = &["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"];
        self.layer.begin(Prim { type_name: "Mesh", name: &identifier(name), apis, ..Prim::default() })?;
        self.layer.value(Uniform, "subdivisionScheme", &Value::Token("none"))?;
        self.layer.value(Uniform, "purpose", &Value::Token("guide"))?;
        self.layer.value(Uniform, "physics:approximation", &Value::Token("convexHull"))?;
        self.triangles(mesh, |place| (place - origin) * scale)?;
        self.layer.end()
    }
}

/// A name as prims may have it.
fn identifier(name: &str) -> String {
    let known = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let name: String = name.chars().map(known).collect();
    if name.starts_with(|first: char| first.is_ascii_digit()) || name.is_empty() {
        format!("_{name}")
    } else {
        name
    }
}
