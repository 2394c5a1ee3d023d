//! Writes vertices, triangles and textures into the binary part of a file, and says in JSON where they are.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};
use serde_json::Value;

use super::{About, ExportError};
use crate::{
    colour::encoded,
    gltf::{
        ARRAY_BUFFER, Accessor, Asset, Attributes, Buffer, BufferView, ELEMENT_ARRAY_BUFFER, FLOAT, Image,
        Material, Mesh, Node, NormalTexture, PbrMetallicRoughness, Primitive, Root, Scene,
        Texture as TextureJson, TextureInfo, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT,
    },
    png,
    surface::{Texture, bark::Bark},
};

const MAGIC: u32 = u32::from_le_bytes(*b"glTF");
const VERSION: u32 = 2;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const BINARY_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");
/// The index that glTF keeps for restarting a strip; it must not name a vertex.
const RESERVED_INDEX: usize = u16::MAX as usize;
/// Bytes of a vertex: place, normal, tangent, place in the texture, colour.
const STRIDE: usize = 12 + 12 + 16 + 8 + 4;

/// One vertex, lengths in internodes.
pub(super) struct Vertex {
    pub place: Vec3,
    pub normal: Vec3,
    pub tangent: Vec4,
    /// Upwards.
    pub uv: Vec2,
    /// Linear.
    pub colour: Vec3,
}

/// What triangles look like.
#[derive(Clone, Copy)]
pub(super) enum Surface<'a> {
    /// Bark, and how deep its furrows look.
    Bark(&'a Bark, f32),
    /// What has pictures with nothing around them.
    Thin(&'static str, &'a Texture),
    /// One linear colour.
    Plain(&'static str, Vec3),
}

impl Surface<'_> {
    fn name(&self) -> &'static str {
        match self {
            Self::Bark(..) => "Bark",
            Self::Thin(name, _) | Self::Plain(name, _) => name,
        }
    }
}

/// Collects the plants of one file.
pub(super) struct Writer {
    scale: f32,
    /// The seed of the present plant, from which its vertices are measured.
    origin: Vec3,
    root: Root,
    materials: BTreeMap<&'static str, usize>,
    binary: Vec<u8>,
}

impl Writer {
    pub(super) fn new(scale: f32, about: &About<'_>) -> Self {
        let asset = Asset {
            version: "2.0",
            generator: about.program.to_owned(),
            copyright: about.copyright(),
            extras: about.extras(),
        };
        let root = Root {
            asset,
            scene: 0,
            scenes: vec![Scene { name: "Scene", nodes: Vec::new() }],
            nodes: Vec::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            images: Vec::new(),
            accessors: Vec::new(),
            buffer_views: Vec::new(),
            buffers: Vec::new(),
        };
        Self { scale, origin: Vec3::ZERO, root, materials: BTreeMap::new(), binary: Vec::new() }
    }

    /// Adds the node of a plant that stands at a place; parts that follow are its own.
    pub(super) fn begin_plant(&mut self, name: String, seed: Vec3, extras: Value) {
        self.origin = seed;
        let translation = (seed != Vec3::ZERO).then(|| (seed * self.scale).to_array());
        self.root.scenes[0].nodes.push(self.root.nodes.len());
        let node = Node { name, translation, mesh: None, children: Vec::new(), extras: Some(extras) };
        self.root.nodes.push(node);
    }

    /// Begins a part of the present plant.
    pub(super) fn begin_part(&mut self) -> Part<'_> {
        let start = self.binary.len();
        Part { writer: self, start, low: Vec3::MAX, high: Vec3::MIN }
    }

    /// The index of a material, which is made when it is first asked for.
    fn material(&mut self, surface: &Surface<'_>) -> usize {
        let name = surface.name();
        if let Some(&index) = self.materials.get(name) {
            return index;
        }
        let material = match surface {
            Surface::Plain(_, colour) => plain(name, *colour, 0.9),
            Surface::Thin(_, texture) => {
                let colours: Vec<[u8; 4]> = texture.colours.iter().zip(&texture.cover).map(covered).collect();
                let mut material = plain(name, Vec3::ONE, 0.7);
                let pbr = &mut material.pbr_metallic_roughness;
                pbr.base_color_texture = Some(self.texture(format!("{name} colour"), texture.side, &colours));
                material.normal_texture = Some(self.normals(name, texture, 1.0));
                material.alpha_mode = Some("MASK");
                material.double_sided = true;
                material
            }
            Surface::Bark(bark, relief) => {
                let texture = &bark.texture;
                let colours: Vec<[u8; 3]> = texture.colours.iter().map(|&colour| encoded(colour)).collect();
                let mut material = plain(name, Vec3::ONE, 1.0);
                let exposure = texture.exposure.as_ref().map(|exposure| {
                    let channels: Vec<[u8; 3]> =
                        exposure.iter().map(|&[sky, rough]| [byte(sky), byte(rough), 0]).collect();
                    self.texture(format!("{name} occlusion and roughness"), texture.side, &channels)
                });
                let pbr = &mut material.pbr_metallic_roughness;
                pbr.base_color_texture = Some(self.texture(format!("{name} colour"), texture.side, &colours));
                pbr.metallic_roughness_texture = exposure;
                material.occlusion_texture = exposure;
                material.normal_texture = Some(self.normals(name, texture, *relief));
                material
            }
        };
        let index = self.root.materials.len();
        self.root.materials.push(material);
        self.materials.insert(name, index);
        index
    }

    fn normals(&mut self, name: &str, texture: &Texture, scale: f32) -> NormalTexture {
        let pixels: Vec<[u8; 3]> =
            texture.normals.iter().map(|normal| (*normal * 0.5 + 0.5).to_array().map(byte)).collect();
        let TextureInfo { index } = self.texture(format!("{name} normal"), texture.side, &pixels);
        NormalTexture { index, scale }
    }

    fn texture<const CHANNELS: usize>(
        &mut self,
        name: String,
        side: usize,
        pixels: &[[u8; CHANNELS]],
    ) -> TextureInfo {
        // An image's first row is its top.
        let lines: Vec<[u8; CHANNELS]> = pixels.chunks(side).rev().flatten().copied().collect();
        let start = self.binary.len();
        self.binary.extend(png::square(side, &lines));
        let buffer_view = self.view(start, None, None);
        self.root.textures.push(TextureJson { source: self.root.images.len() });
        self.root.images.push(Image { name, mime_type: "image/png", buffer_view });
        TextureInfo { index: self.root.textures.len() - 1 }
    }

    /// Makes the bytes from `start` on a view.
    fn view(&mut self, start: usize, byte_stride: Option<usize>, target: Option<u32>) -> usize {
        let byte_length = self.binary.len() - start;
        self.root.buffer_views.push(BufferView {
            buffer: 0,
            byte_offset: start,
            byte_length,
            byte_stride,
            target,
        });
        // The next view must begin where its components are aligned.
        pad(&mut self.binary, 0);
        self.root.buffer_views.len() - 1
    }

    fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let start = self.binary.len();
        let component_type = if vertices <= RESERVED_INDEX {
            self.binary.extend(indices.iter().flat_map(|&index| (index as u16).to_le_bytes()));
            UNSIGNED_SHORT
        } else {
            self.binary.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
            UNSIGNED_INT
        };
        let view = self.view(start, None, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(view, 0, component_type, "SCALAR", indices.len())
    }

    fn accessor(
        &mut self,
        buffer_view: usize,
        byte_offset: usize,
        component_type: u32,
        shape: &'static str,
        count: usize,
    ) -> usize {
        let (normalized, min, max) = (component_type == UNSIGNED_BYTE, None, None);
        let accessor =
            Accessor { buffer_view, byte_offset, component_type, normalized, count, shape, min, max };
        self.root.accessors.push(accessor);
        self.root.accessors.len() - 1
    }

    pub(super) fn finish(mut self) -> Result<Vec<u8>, ExportError> {
        if !self.binary.is_empty() {
            self.root.buffers.push(Buffer { byte_length: self.binary.len() });
        }
        // Writing to memory does not fail, and all keys are strings.
        let mut json = serde_json::to_vec(&self.root).expect("the root is always JSON");
        pad(&mut json, b' ');
        let binary = if self.binary.is_empty() { 0 } else { 8 + self.binary.len() };
        let length = u32::try_from(20 + json.len() + binary).map_err(|_| ExportError::TooLarge)?;
        // The JSON is shorter than the file, whose length has 32 bits, and so is the binary part.
        let mut head: Vec<u8> = [MAGIC, VERSION, length, json.len() as u32, JSON_CHUNK]
            .into_iter()
            .flat_map(u32::to_le_bytes)
            .collect();
        head.extend(json);
        if binary > 0 {
            head.extend([(binary - 8) as u32, BINARY_CHUNK].into_iter().flat_map(u32::to_le_bytes));
        }
        // The bytes move up within their own memory: the file is never there twice.
        self.binary.splice(..0, head);
        Ok(self.binary)
    }
}

/// Vertices of one mesh.
pub(super) struct Part<'a> {
    writer: &'a mut Writer,
    start: usize,
    low: Vec3,
    high: Vec3,
}

impl Part<'_> {
    /// Vertices so far.
    pub(super) fn count(&self) -> u32 {
        ((self.writer.binary.len() - self.start) / STRIDE) as u32
    }

    pub(super) fn vertex(&mut self, Vertex { place, normal, tangent, uv, colour }: Vertex) {
        let place = (place - self.writer.origin) * self.writer.scale;
        (self.low, self.high) = (self.low.min(place), self.high.max(place));
        let floats = [&place.to_array()[..], &normal.to_array(), &tangent.to_array(), &[uv.x, 1.0 - uv.y]];
        let mut bytes = [0; STRIDE];
        for (to, float) in bytes.as_chunks_mut::<4>().0.iter_mut().zip(floats.into_iter().flatten()) {
            *to = float.to_le_bytes();
        }
        let [r, g, b] = colour.to_array().map(byte);
        bytes[STRIDE - 4..].copy_from_slice(&[r, g, b, 255]);
        self.writer.binary.extend_from_slice(&bytes);
    }

    /// Makes a mesh of them and the node that shows it. A mesh without triangles adds nothing, for an accessor must not
    /// be empty.
    pub(super) fn finish(
        self,
        name: &'static str,
        triangles: &[(&[u32], Surface<'_>)],
    ) -> Result<(), ExportError> {
        let count = self.count() as usize;
        let Self { writer, start, low, high } = self;
        if triangles.iter().all(|(indices, _)| indices.is_empty()) {
            writer.binary.truncate(start);
            return Ok(());
        }
        if !(low.is_finite() && high.is_finite()) {
            return Err(ExportError::NotFinite);
        }
        let view = writer.view(start, Some(STRIDE), Some(ARRAY_BUFFER));
        let attributes = Attributes {
            position: writer.accessor(view, 0, FLOAT, "VEC3", count),
            normal: writer.accessor(view, 12, FLOAT, "VEC3", count),
            tangent: Some(writer.accessor(view, 24, FLOAT, "VEC4", count)),
            texcoord_0: Some(writer.accessor(view, 40, FLOAT, "VEC2", count)),
            color_0: Some(writer.accessor(view, 48, UNSIGNED_BYTE, "VEC4", count)),
        };
        let places = &mut writer.root.accessors[attributes.position];
        (places.min, places.max) = (Some(low.to_array()), Some(high.to_array()));
        let mut primitives = Vec::new();
        for (indices, surface) in triangles.iter().filter(|(indices, _)| !indices.is_empty()) {
            let attributes = match surface {
                // The colour of bark is not that of wood below it.
                Surface::Plain(..) => {
                    Attributes { tangent: None, texcoord_0: None, color_0: None, ..attributes }
                }
                _ => attributes,
            };
            let indices = writer.indices(indices, count);
            primitives.push(Primitive { attributes, indices, material: writer.material(surface) });
        }
        let (mesh, node) = (writer.root.meshes.len(), writer.root.nodes.len());
        let plant = writer.root.scenes[0].nodes.last().copied();
        let plant = plant.and_then(|plant| writer.root.nodes.get_mut(plant));
        let of = plant.map(|plant| {
            plant.children.push(node);
            plant.name.clone()
        });
        writer.root.meshes.push(Mesh { name: format!("{} {name}", of.unwrap_or_default()), primitives });
        writer.root.nodes.push(Node {
            name: name.to_owned(),
            translation: None,
            mesh: Some(mesh),
            children: Vec::new(),
            extras: None,
        });
        Ok(())
    }
}

fn plain(name: &'static str, colour: Vec3, roughness: f32) -> Material {
    Material {
        name,
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
    }
}

fn covered((&colour, &cover): (&Vec3, &u8)) -> [u8; 4] {
    let [r, g, b] = encoded(colour);
    [r, g, b, cover]
}

fn byte(share: f32) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Chunks and views begin at multiples of four.
fn pad(bytes: &mut Vec<u8>, filler: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), filler);
}
