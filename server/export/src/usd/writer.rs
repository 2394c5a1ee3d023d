//! Writes nodes and parts as prims.

use std::{
    io::{self, Write},
    rc::Rc,
};

use espalier_mesh::TriangleMesh;
use espalier_motion::Rig;
use glam::Vec3;
use serde_json::Value;

use super::{
    ROOT,
    arrays::{Array, joined},
    skel::Skeleton,
};
use crate::{
    Detail, ExportError, Model,
    assembly::{Builder, Part, Scatter, Surface},
    foliage::cards::{Cards, LeafForm},
    mean_materials::{MeanMaterials, seen_of},
    swaying::Swaying,
};

/// A layer that is being written.
pub(super) struct Writer<'a, 's> {
    pub out: &'a mut dyn Write,
    pub scale: f32,
    pub model: &'a Model,
    /// The names of the nodes that are open, and where they stand, in internodes.
    pub open: Vec<(String, Vec3)>,
    /// The bones of the plant that is written, where it sways.
    pub skeleton: Option<Rc<Skeleton<'s>>>,
    pub materials: MeanMaterials,
}

impl Writer<'_, '_> {
    fn origin(&self) -> Vec3 {
        self.open.last().map_or(Vec3::ZERO, |(_, place)| *place)
    }

    /// A name below the open node as a path.
    fn path(&self, name: &str) -> String {
        let all: Vec<&str> = self.open.iter().map(|(name, _)| name.as_str()).chain([name]).collect();
        format!("/{ROOT}/{}", all.join("/"))
    }

    fn array<T>(
        &mut self,
        name: &str,
        suffix: &str,
        fill: impl FnOnce(&mut Array<'_>) -> Result<T, ExportError>,
    ) -> Result<T, ExportError> {
        let mut array = Array::begin(&mut *self.out, name)?;
        let result = fill(&mut array)?;
        array.end(suffix)?;
        Ok(result)
    }

    fn bound(&mut self, material: &str) -> io::Result<()> {
        writeln!(self.out, "rel material:binding = </{ROOT}/Looks/{material}>")
    }

    /// What triangles of a part are made of: so many have its surface, or one of its colours, and so many the next. Where
    /// there are several, each triangle is in one subset: not all readers show what is in none.
    fn subsets(&mut self, part: &Part<'_>, faces: &[u32], materials: usize) -> Result<(), ExportError> {
        let Some(first) = part.surfaces.first() else { return Ok(()) };
        let names: Vec<String> = if materials > 1 {
            (0..materials).map(|shade| self.materials.name(first, shade).into_owned()).collect()
        } else {
            part.surfaces.iter().map(|surface| surface.name().to_owned()).collect()
        };
        let mut reached = 0;
        let mut subsets = Vec::new();
        for (name, &count) in names.iter().zip(faces) {
            if count > 0 {
                subsets.push((name, reached..reached + count));
            }
            reached += count;
        }
        self.bound(subsets.first().map_or(&names[0], |(name, _)| name))?;
        if subsets.len() == 1 {
            return Ok(());
        }
        writeln!(self.out, "uniform token subsetFamily:materialBind:familyType = \"partition\"")?;
        for (name, faces) in subsets {
            writeln!(
                self.out,
                "def GeomSubset \"{name}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"]\n)\n{{"
            )?;
            writeln!(
                self.out,
                "uniform token elementType = \"face\"\nuniform token familyName = \"materialBind\""
            )?;
            self.array("int[] indices", "", |array| faces.clone().try_for_each(|face| array.put(face)))?;
            self.bound(name)?;
            writeln!(self.out, "}}")?;
        }
        Ok(())
    }

    /// What the vertices of a part go along with: two bones each.
    fn skin(&mut self, part: &Part<'_>, skeleton: &Skeleton<'_>) -> Result<(), ExportError> {
        skeleton.bind(self.origin(), self.scale, &mut *self.out)?;
        let pairs = " (\nelementSize = 2\ninterpolation = \"vertex\"\n)";
        self.array("int[] primvars:skel:jointIndices", pairs, |array| {
            (part.blocks)(&mut |block| {
                let mut bones = block.riders.iter().flat_map(|&rider| skeleton.bound(rider).0);
                bones.try_for_each(|bone| array.put(bone))
            })
        })?;
        self.array("float[] primvars:skel:jointWeights", pairs, |array| {
            (part.blocks)(&mut |block| {
                let mut shares = block.riders.iter().flat_map(|&rider| skeleton.bound(rider).1);
                shares.try_for_each(|share| array.put(share))
            })
        })
    }

    /// The arrays that all meshes have.
    fn triangles(&mut self, mesh: &TriangleMesh, place: impl Fn(Vec3) -> Vec3) -> Result<(), ExportError> {
        let corners = mesh.indices.as_chunks::<3>().0;
        self.array("int[] faceVertexCounts", "", |array| corners.iter().try_for_each(|_| array.put(3)))?;
        self.array("int[] faceVertexIndices", "", |array| {
            mesh.indices.iter().try_for_each(|index| array.put(index))
        })?;
        self.array("point3f[] points", "", |array| {
            mesh.positions.iter().try_for_each(|&position| array.vector(&place(position).to_array()))
        })?;
        self.array("normal3f[] normals", " (\ninterpolation = \"vertex\"\n)", |array| {
            mesh.normals.iter().try_for_each(|normal| array.vector(&normal.to_array()))
        })
    }
}

impl<'s> Builder<'s> for Writer<'_, 's> {
    fn bones(&mut self, swaying: &'s Swaying, rig: Rig) -> Result<(), ExportError> {
        let stand = (self.origin(), self.scale);
        let path = self.path("Bones");
        self.skeleton = Some(Rc::new(Skeleton::begin(&mut *self.out, swaying, rig, path, stand)?));
        Ok(())
    }

    fn begin(&mut self, name: &str, place: Vec3, extras: Option<Value>) -> Result<(), ExportError> {
        let [x, y, z] = ((place - self.origin()) * self.scale).to_array();
        let name = identifier(name);
        // A plant that sways holds its bones and all that goes along with them.
        let kind = if self.model.sway.is_some() && self.open.is_empty() { "SkelRoot" } else { "Xform" };
        writeln!(self.out, "def {kind} \"{name}\" (\nkind = \"group\"\n")?;
        let lod = extras.as_ref().and_then(|extras| extras["lod"].as_u64());
        if let Some(Value::Object(extras)) = &extras {
            writeln!(self.out, "customData = {{")?;
            for (name, value) in extras.iter().filter(|(_, value)| value.is_u64()) {
                writeln!(self.out, "int {name} = {value}")?;
            }
            writeln!(self.out, "}}")?;
        }
        writeln!(self.out, ")\n{{")?;
        writeln!(self.out, "double3 xformOp:translate = ({x}, {y}, {z})")?;
        writeln!(self.out, "uniform token[] xformOpOrder = [\"xformOp:translate\"]")?;
        if self.model.detail == Detail::Set && lod.is_some_and(|level| level > 0) {
            // All levels stand at the same place; who wants another shows it.
            writeln!(self.out, "token visibility = \"invisible\"")?;
        }
        self.open.push((name, place));
        Ok(())
    }

    fn end(&mut self) -> Result<(), ExportError> {
        self.open.pop();
        Ok(writeln!(self.out, "}}")?)
    }

    fn part(&mut self, part: &Part<'_>) -> Result<(), ExportError> {
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
        let skeleton = self.skeleton.clone().filter(|_| part.rides);
        let binds = if skeleton.is_some() { ", \"SkelBindingAPI\"" } else { "" };
        writeln!(
            self.out,
            "def Mesh \"{}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"{binds}]",
            part.name
        )?;
        if let Some(Value::Object(about)) = part.lightmap.map(|map| map.about(self.scale)) {
            writeln!(self.out, "customData = {{\ndictionary lightmap = {{")?;
            for (name, value) in &about {
                let kind = if value.is_u64() { "int" } else { "double" };
                writeln!(self.out, "{kind} {name} = {value}")?;
            }
            writeln!(self.out, "}}\n}}")?;
        }
        writeln!(self.out, ")\n{{")?;
        writeln!(self.out, "uniform token subdivisionScheme = \"none\"")?;
        if part.surfaces.len() == 1 {
            writeln!(self.out, "uniform bool doubleSided = 1")?;
        }
        writeln!(self.out, "float3[] extent = [{}, {}]", joined(&low.to_array()), joined(&high.to_array()))?;
        self.array("int[] faceVertexCounts", "", |array| {
            (0..triangles[0] + triangles[1]).try_for_each(|_| array.put(3))
        })?;
        // The triangles of the second surface stand behind all others, and those of one colour of leaves together, so that
        // they can be told by their numbers.
        let count = if let [one] = part.surfaces { self.materials.materials(one) } else { 1 };
        let mut faces = vec![0; count.max(2)];
        let Self { out, materials, .. } = self;
        let mut array = Array::begin(&mut **out, "int[] faceVertexIndices")?;
        for (number, faces) in faces.iter_mut().enumerate() {
            let mut first = 0;
            (part.blocks)(&mut |block| {
                let second = number > 0 && count == 1;
                let indices = if second { block.second } else { &block.mesh.indices };
                for corners in indices.as_chunks::<3>().0 {
                    let colour = block.colours[corners[0] as usize];
                    if count > 1 && materials.shade(&part.surfaces[0], colour) != number {
                        continue;
                    }
                    *faces += 1;
                    corners.iter().try_for_each(|index| array.put(first + index))?;
                }
                first += block.mesh.positions.len() as u32;
                Ok(())
            })?;
        }
        array.end("")?;
        let vertex = " (\ninterpolation = \"vertex\"\n)";
        self.array("point3f[] points", "", |array| {
            (part.blocks)(&mut |block| {
                let mut places = block.mesh.positions.iter().map(|&place| (place - origin) * scale);
                places.try_for_each(|place| array.vector(&place.to_array()))
            })
        })?;
        self.array("normal3f[] normals", vertex, |array| {
            (part.blocks)(&mut |block| {
                block.mesh.normals.iter().try_for_each(|way| array.vector(&way.to_array()))
            })
        })?;
        let Self { out, materials, .. } = self;
        let mut array = Array::begin(&mut **out, "texCoord2f[] primvars:st")?;
        (part.blocks)(&mut |block| {
            block.mesh.uvs.iter().zip(block.colours).try_for_each(|(&uv, &colour)| {
                let uv = match part.surfaces {
                    [thin] => materials.place(thin, materials.shade(thin, colour), uv),
                    _ => uv,
                };
                array.vector(&uv.to_array())
            })
        })?;
        array.end(vertex)?;
        if part.lightmap.is_some() {
            self.array("texCoord2f[] primvars:st1", vertex, |array| {
                (part.blocks)(&mut |block| {
                    let mut places = block.places.into_iter().flatten();
                    places.try_for_each(|place| array.vector(&place.to_array()))
                })
            })?;
        }
        let tint = part.surfaces.first().map_or(Vec3::ONE, seen);
        self.array("color3f[] primvars:displayColor", vertex, |array| {
            (part.blocks)(&mut |block| {
                block.colours.iter().try_for_each(|&colour| array.vector(&(colour * tint).to_array()))
            })
        })?;
        if let Some(skeleton) = skeleton {
            self.skin(part, &skeleton)?;
        }
        self.subsets(part, &faces, count)?;
        Ok(writeln!(self.out, "}}")?)
    }

    fn scatter(&mut self, scatter: &Scatter<'_>) -> Result<(), ExportError> {
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
        writeln!(self.out, "def PointInstancer \"{}\"\n{{", scatter.name)?;
        let (surface, shades) = (&scatter.surface, self.materials.shades(&scatter.surface));
        let leaf = |which: usize| format!("<{}/Leaf{which}>", self.path(scatter.name));
        // Each form in each colour.
        let prototypes: Vec<String> = (0..shades * LeafForm::PROTOTYPES).map(leaf).collect();
        writeln!(self.out, "rel prototypes = [{}]", prototypes.join(", "))?;
        let Self { out, materials, .. } = self;
        let mut array = Array::begin(&mut **out, "int[] protoIndices")?;
        each(&mut |(instance, hue)| {
            let shade = materials.shade(surface, hue * scatter.strength);
            array.put(shade * LeafForm::PROTOTYPES + instance.prototype)
        })?;
        array.end("")?;
        self.array("point3f[] positions", "", |array| {
            each(&mut |(instance, _)| array.vector(&((instance.place - origin) * scale).to_array()))
        })?;
        self.array("quath[] orientations", "", |array| {
            each(&mut |(instance, _)| {
                let [x, y, z, w] = instance.rotation.to_array();
                array.vector(&[w, x, y, z])
            })
        })?;
        self.array("float3[] scales", "", |array| {
            each(&mut |(instance, _)| array.vector(&[instance.scale * scale; 3]))
        })?;
        let tint = scatter.strength * seen(surface);
        self.array("color3f[] primvars:displayColor", " (\ninterpolation = \"vertex\"\n)", |array| {
            each(&mut |(_, hue)| array.vector(&(hue * tint).to_array()))
        })?;
        for which in 0..prototypes.len() {
            let mut cards = Cards::default();
            scatter.form.add_prototype(&mut cards, which % LeafForm::PROTOTYPES);
            writeln!(
                self.out,
                "def Mesh \"Leaf{which}\" (\nprepend apiSchemas = [\"MaterialBindingAPI\"]\n)\n{{"
            )?;
            writeln!(self.out, "uniform token subdivisionScheme = \"none\"\nuniform bool doubleSided = 1")?;
            self.triangles(&cards.mesh, |place| place)?;
            let shade = which / LeafForm::PROTOTYPES;
            let places: Vec<_> =
                cards.mesh.uvs.iter().map(|&uv| self.materials.place(surface, shade, uv)).collect();
            self.array("texCoord2f[] primvars:st", " (\ninterpolation = \"vertex\"\n)", |array| {
                places.iter().try_for_each(|uv| array.vector(&uv.to_array()))
            })?;
            let material = self.materials.name(surface, shade);
            self.bound(&material)?;
            writeln!(self.out, "}}")?;
        }
        Ok(writeln!(self.out, "}}")?)
    }

    fn hull(&mut self, name: &str, mesh: &TriangleMesh) -> Result<(), ExportError> {
        let (origin, scale) = (self.origin(), self.scale);
        writeln!(
            self.out,
            "def Mesh \"{}\" (\nprepend apiSchemas = [\"PhysicsCollisionAPI\", \"PhysicsMeshCollisionAPI\"]\n)\n{{\n\
             uniform token subdivisionScheme = \"none\"\nuniform token purpose = \"guide\"\n\
             uniform token physics:approximation = \"convexHull\"",
            identifier(name)
        )?;
        self.triangles(mesh, |place| (place - origin) * scale)?;
        Ok(writeln!(self.out, "}}")?)
    }
}

/// What colours are multiplied by to be what is seen, on the average over a surface.
fn seen(surface: &Surface<'_>) -> Vec3 {
    match surface {
        Surface::Bark(bark, _) => seen_of(&bark.texture),
        Surface::Thin(_, texture) => seen_of(texture),
        Surface::Plain(..) => Vec3::ONE,
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
