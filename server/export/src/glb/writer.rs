//! Writes vertices, triangles and textures into the binary part of a file, and says in JSON where they are.

use std::{collections::BTreeMap, io::SeekFrom};

use glam::Vec3;
use serde_json::{Value, json};

use super::{
    packing,
    skin::Skeleton,
    vertex::{Attribute, Layout, Vertex},
};
use crate::{
    ExportError, Sink,
    assembly::Surface,
    gltf::{
        ARRAY_BUFFER, Accessor, Asset, Attributes, Buffer, BufferView, ELEMENT_ARRAY_BUFFER, FLOAT, Mesh,
        Node, Primitive, Root, Scene, UNSIGNED_INT, UNSIGNED_SHORT,
    },
};

const MAGIC: u32 = u32::from_le_bytes(*b"glTF");
const VERSION: u32 = 2;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const BINARY_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");
/// Bytes before the JSON, and between it and the binary part.
const HEAD: usize = 20;
const BETWEEN: usize = 8;
/// The index that glTF keeps for restarting a strip; it must not name a vertex.
const RESERVED_INDEX: usize = u16::MAX as usize;

/// How vertices and triangles are packed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Packing {
    pub is_quantised: bool,
    pub is_compressed: bool,
}

/// A node that is open: where it stands, and from where vertices below it are measured.
struct Open {
    node: usize,
    origin: Vec3,
}

/// Collects the plants of one file.
pub(super) struct Writer<'a> {
    out: &'a mut dyn Sink,
    pub(super) packing: Packing,
    pub(super) scale: f32,
    pub(super) root: Root,
    pub(super) materials: BTreeMap<String, usize>,
    open_nodes: Vec<Open>,
    /// Meshes that several nodes show, by their level of detail and number.
    pub(super) prototypes: BTreeMap<(u8, usize), usize>,
    /// Bytes left for the JSON before the binary part; it is written last.
    capacity: usize,
    /// Bytes of the binary part.
    pub(super) written: usize,
    /// Bytes that its compressed views have when they are not.
    unpacked: usize,
}

impl<'a> Writer<'a> {
    /// Begins a file with so much capacity for its JSON; without any there is no binary part.
    pub(super) fn new(
        out: &'a mut dyn Sink,
        asset: Asset,
        scale: f32,
        packing: Packing,
        capacity: usize,
    ) -> Result<Self, ExportError> {
        let capacity = capacity.next_multiple_of(4);
        if capacity > 0 {
            std::io::copy(
                &mut std::io::Read::take(std::io::repeat(b' '), (HEAD + capacity + BETWEEN) as u64),
                &mut *out,
            )?;
        }
        let root =
            Root { asset, scenes: vec![Scene { name: "Scene", nodes: Vec::new() }], ..Root::default() };
        let (materials, open_nodes, prototypes) = Default::default();
        let (written, unpacked) = (0, 0);
        Ok(Self { out, packing, scale, root, materials, open_nodes, prototypes, capacity, written, unpacked })
    }

    /// Adds a node that stands at a place, below the one that is open; what follows is below it, until it is ended.
    pub(super) fn open(&mut self, name: &str, place: Vec3, extras: Option<Value>) {
        let node = self.root.nodes.len();
        let parent = self.open_nodes.last().map_or(Vec3::ZERO, |parent| parent.origin);
        let translation = (place != parent).then(|| ((place - parent) * self.scale).to_array());
        self.adopt(Node { name: name.to_owned(), translation, extras, ..Node::default() }, 0);
        self.open_nodes.push(Open { node, origin: place });
    }

    /// Ends the node that was begun last.
    pub(super) fn close(&mut self) {
        self.open_nodes.pop();
    }

    /// Adds a node below the one that is open, or at the root of a scene.
    pub(super) fn adopt(&mut self, node: Node, scene: usize) {
        let index = self.root.nodes.len();
        match self.open_nodes.last().filter(|_| scene == 0) {
            Some(parent) => self.root.nodes[parent.node].children.push(index),
            None => self.root.scenes[scene].nodes.push(index),
        }
        self.root.nodes.push(node);
    }

    /// The name of the node that is open.
    pub(super) fn owner(&self) -> String {
        self.open_nodes.last().map_or_else(String::new, |open| self.root.nodes[open.node].name.clone())
    }

    pub(super) fn origin(&self) -> Vec3 {
        self.open_nodes.last().map_or(Vec3::ZERO, |open| open.origin)
    }

    /// Begins a mesh; what it shows lies within `reach` internodes of the open node if vertices are quantised.
    pub(super) fn begin_part(&self, repeats: bool, reach: f32) -> Part {
        let layout = Layout::new(self.packing.is_quantised, repeats);
        let is_measured = self.packing.is_quantised && reach > 0.0;
        let unit = if is_measured { reach * self.scale } else { 1.0 };
        let (origin, start) = (self.origin(), self.written);
        let (low, high, extras) = (Vec3::MAX, Vec3::MIN, None);
        Part { layout, unit, origin, start, count: 0, held: Vec::new(), low, high, extras }
    }

    /// Begins a mesh that is measured from its own origin, in internodes; it is small, and not quantised.
    pub(super) fn begin_plain(&self) -> Part {
        let layout = Layout::new(false, false);
        let (unit, start) = (self.scale, self.written);
        let (low, high, extras) = (Vec3::MAX, Vec3::MIN, None);
        Part { layout, unit, origin: Vec3::ZERO, start, count: 0, held: Vec::new(), low, high, extras }
    }

    /// Makes bytes a view.
    pub(super) fn whole_view(&mut self, bytes: &[u8], target: Option<u32>) -> Result<usize, ExportError> {
        let start = self.written;
        self.put(bytes)?;
        self.view(start, None, target)
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), ExportError> {
        self.written += bytes.len();
        Ok(self.out.write_all(bytes)?)
    }

    /// Makes the bytes from `start` on a view.
    fn view(
        &mut self,
        start: usize,
        byte_stride: Option<usize>,
        target: Option<u32>,
    ) -> Result<usize, ExportError> {
        let byte_length = self.written - start;
        self.pad()?;
        let view =
            BufferView { buffer: 0, byte_offset: start, byte_length, byte_stride, target, extensions: None };
        self.root.buffer_views.push(view);
        Ok(self.root.buffer_views.len() - 1)
    }

    /// Writes items of `stride` bytes each in their compressed form and makes them a view.
    fn packed_view(
        &mut self,
        packed: &[u8],
        [count, stride]: [usize; 2],
        mode: &str,
        target: u32,
    ) -> Result<usize, ExportError> {
        let (start, byte_length) = (self.written, count * stride);
        self.put(packed)?;
        self.pad()?;
        let is_vertices = target == ARRAY_BUFFER;
        self.root.buffer_views.push(BufferView {
            buffer: 1,
            byte_offset: self.unpacked,
            byte_length,
            byte_stride: is_vertices.then_some(stride),
            target: Some(target),
            extensions: Some(json!({ packing::EXTENSION: {
                "buffer": 0, "byteOffset": start, "byteLength": packed.len(),
                "byteStride": stride, "count": count, "mode": mode,
            }})),
        });
        self.unpacked = (self.unpacked + byte_length).next_multiple_of(4);
        Ok(self.root.buffer_views.len() - 1)
    }

    /// The next view must begin where its components are aligned.
    fn pad(&mut self) -> Result<(), ExportError> {
        let filler = self.written.next_multiple_of(4) - self.written;
        self.put(&[0; 3][..filler])
    }

    fn indices(&mut self, indices: &[u32], vertices: usize) -> Result<usize, ExportError> {
        let is_short = vertices <= RESERVED_INDEX;
        let component_type = if is_short { UNSIGNED_SHORT } else { UNSIGNED_INT };
        let view = if self.packing.is_compressed {
            let stride = if is_short { 2 } else { 4 };
            let packed = packing::triangles(indices, vertices)?;
            self.packed_view(&packed, [indices.len(), stride], "TRIANGLES", ELEMENT_ARRAY_BUFFER)?
        } else {
            let start = self.written;
            for block in indices.chunks(0x4000) {
                let bytes: Vec<u8> = if is_short {
                    block.iter().flat_map(|&index| (index as u16).to_le_bytes()).collect()
                } else {
                    block.iter().flat_map(|index| index.to_le_bytes()).collect()
                };
                self.put(&bytes)?;
            }
            self.view(start, None, Some(ELEMENT_ARRAY_BUFFER))?
        };
        Ok(self.accessor(
            view,
            Attribute { offset: 0, component_type, shape: "SCALAR" },
            false,
            indices.len(),
        ))
    }

    pub(super) fn accessor(
        &mut self,
        buffer_view: usize,
        Attribute { offset: byte_offset, component_type, shape }: Attribute,
        normalized: bool,
        count: usize,
    ) -> usize {
        let (min, max) = (None, None);
        let accessor =
            Accessor { buffer_view, byte_offset, component_type, normalized, count, shape, min, max };
        self.root.accessors.push(accessor);
        self.root.accessors.len() - 1
    }

    /// Says that readers have to know an extension.
    pub(super) fn require(&mut self, extension: &'static str) {
        for list in [&mut self.root.extensions_used, &mut self.root.extensions_required] {
            if !list.contains(&extension) {
                list.push(extension);
            }
        }
    }

    pub(super) fn finish(mut self) -> Result<(), ExportError> {
        if self.written > 0 {
            self.root.buffers.push(Buffer { byte_length: self.written, extensions: None });
        }
        if self.unpacked > 0 {
            let fallback = Some(json!({ packing::EXTENSION: { "fallback": true } }));
            self.root.buffers.push(Buffer { byte_length: self.unpacked, extensions: fallback });
            self.require(packing::EXTENSION);
        }
        if self.packing.is_quantised {
            self.require("KHR_mesh_quantization");
        }
        let mut json = serde_json::to_vec(&self.root)?;
        json.resize(self.capacity.max(json.len().next_multiple_of(4)), b' ');
        let binary = if self.capacity == 0 { 0 } else { BETWEEN + self.written };
        let length = u32::try_from(HEAD + json.len() + binary).map_err(|_| ExportError::TooLarge)?;
        debug_assert!(self.capacity == 0 || self.capacity == json.len(), "the JSON exceeds its capacity");
        if self.capacity > 0 && json.len() > self.capacity {
            return Err(ExportError::TooLarge);
        }
        self.out.seek(SeekFrom::Start(0))?;
        // The JSON and the binary part are shorter than the file, whose length has 32 bits.
        for word in [MAGIC, VERSION, length, json.len() as u32, JSON_CHUNK] {
            self.out.write_all(&word.to_le_bytes())?;
        }
        self.out.write_all(&json)?;
        if binary > 0 {
            self.out.write_all(&(self.written as u32).to_le_bytes())?;
            self.out.write_all(&BINARY_CHUNK.to_le_bytes())?;
        }
        self.out.seek(SeekFrom::End(0))?;
        Ok(self.out.flush()?)
    }
}

/// Vertices of one mesh.
pub(super) struct Part {
    layout: Layout,
    /// Metres in one unit of its node.
    unit: f32,
    origin: Vec3,
    start: usize,
    count: usize,
    /// Vertices that wait for being compressed.
    held: Vec<u8>,
    low: Vec3,
    high: Vec3,
    /// What the mesh says of itself.
    extras: Option<Value>,
}

impl Part {
    /// Its vertices have places in a light map, of which the mesh says this; none have been added yet.
    pub(super) fn with_lightmap(self, about: &Value) -> Self {
        Self { layout: self.layout.with_lightmap(), ..self }.saying("lightmap", about)
    }

    /// Its vertices say how they move in the wind, of which the mesh says this; none have been added yet.
    pub(super) fn with_wind(self, about: &Value) -> Self {
        Self { layout: self.layout.with_wind(), ..self }.saying("wind", about)
    }

    /// Its vertices have places in textures with a texel for each element; none have been added yet.
    pub(super) fn with_elements(self) -> Self {
        Self { layout: self.layout.with_lightmap(), ..self }
    }

    fn saying(mut self, key: &str, about: &Value) -> Self {
        self.extras.get_or_insert_with(|| json!({}))[key] = about.clone();
        self
    }

    /// Its vertices go along with bones; none have been added yet.
    pub(super) fn with_bones(self) -> Self {
        Self { layout: self.layout.with_bones(), ..self }
    }

    /// Vertices so far.
    pub(super) fn count(&self) -> u32 {
        self.count as u32
    }

    pub(super) fn vertex(&mut self, writer: &mut Writer<'_>, vertex: &Vertex) -> Result<(), ExportError> {
        let place = (vertex.place - self.origin) * writer.scale / self.unit;
        let (bytes, counted) = self.layout.encode(vertex, place);
        (self.low, self.high) = (self.low.min(counted), self.high.max(counted));
        self.count += 1;
        let bytes = &bytes[..self.layout.stride];
        if writer.packing.is_compressed {
            self.held.extend_from_slice(bytes);
            return Ok(());
        }
        writer.put(bytes)
    }

    /// The same, with a node in a scene of its own, which stands where the open node does.
    pub(super) fn finish_apart(
        self,
        writer: &mut Writer<'_>,
        name: &str,
        triangles: &[(&[u32], Surface<'_>)],
    ) -> Result<(), ExportError> {
        let scale = (self.unit != 1.0).then_some([self.unit; 3]);
        let translation = (self.origin != Vec3::ZERO).then(|| (self.origin * writer.scale).to_array());
        if let Some(mesh) = self.mesh(writer, name.to_owned(), triangles)? {
            let node =
                Node { name: name.to_owned(), translation, scale, mesh: Some(mesh), ..Node::default() };
            writer.adopt(node, 1);
        }
        Ok(())
    }

    /// Makes a mesh of them and the node that shows it; nothing of no vertices, for an accessor must not be empty.
    pub(super) fn finish(
        self,
        writer: &mut Writer<'_>,
        name: &str,
        triangles: &[(&[u32], Surface<'_>)],
    ) -> Result<(), ExportError> {
        let scale = (self.unit != 1.0).then_some([self.unit; 3]);
        let called = format!("{} {name}", writer.owner());
        if let Some(mesh) = self.mesh(writer, called, triangles)? {
            writer.adopt(Node { name: name.to_owned(), scale, mesh: Some(mesh), ..Node::default() }, 0);
        }
        Ok(())
    }

    /// The same for vertices that go along with bones. Such a mesh stands where its bones do, so its node is nobody's.
    pub(super) fn finish_bound(
        self,
        writer: &mut Writer<'_>,
        skeleton: &Skeleton<'_>,
        name: &str,
        triangles: &[(&[u32], Surface<'_>)],
    ) -> Result<(), ExportError> {
        let (unit, origin) = (self.unit, self.origin);
        let called = format!("{} {name}", writer.owner());
        if let Some(mesh) = self.mesh(writer, called.clone(), triangles)? {
            // What is not quantised is in metres.
            let skin = skeleton.skin(writer, origin, unit)?;
            let node = Node { name: called, mesh: Some(mesh), skin: Some(skin), ..Node::default() };
            writer.root.scenes[0].nodes.push(writer.root.nodes.len());
            writer.root.nodes.push(node);
        }
        Ok(())
    }

    /// Makes a mesh of them that no node shows yet.
    pub(super) fn mesh(
        self,
        writer: &mut Writer<'_>,
        name: String,
        triangles: &[(&[u32], Surface<'_>)],
    ) -> Result<Option<usize>, ExportError> {
        let Self { layout, start, count, held, low, high, extras, .. } = self;
        if count == 0 {
            return Ok(None);
        }
        if !(low.is_finite() && high.is_finite()) {
            return Err(ExportError::NotFinite);
        }
        let view = if writer.packing.is_compressed {
            let packed = packing::vertices(&held, layout.stride)?;
            writer.packed_view(&packed, [count, layout.stride], "ATTRIBUTES", ARRAY_BUFFER)?
        } else {
            writer.view(start, Some(layout.stride), Some(ARRAY_BUFFER))?
        };
        let is_textured = triangles.iter().any(|(_, surface)| !matches!(surface, Surface::Plain(..)));
        let mut accessor =
            |attribute: Attribute| writer.accessor(view, attribute, attribute.component_type != FLOAT, count);
        let attributes = Attributes {
            position: accessor(layout.place),
            normal: accessor(layout.normal),
            tangent: is_textured.then(|| accessor(layout.tangent)),
            texcoord_0: is_textured.then(|| accessor(layout.uv)),
            texcoord_1: layout.lit.map(&mut accessor),
            texcoord_2: layout.wind.map(|[far, _]| accessor(far)),
            texcoord_3: layout.wind.map(|[_, flutter]| accessor(flutter)),
            color_0: is_textured.then(|| accessor(layout.colour)),
            joints_0: None,
            weights_0: layout.bound.map(|[_, shares]| accessor(shares)),
        };
        let bones = layout.bound.map(|[bones, _]| writer.accessor(view, bones, false, count));
        // Sets of places are numbered without a gap: where there is no light map the second set is the first again.
        let second = attributes.texcoord_1.or(attributes.texcoord_0.filter(|_| layout.wind.is_some()));
        let attributes = Attributes { joints_0: bones, texcoord_1: second, ..attributes };
        let places = &mut writer.root.accessors[attributes.position];
        (places.min, places.max) = (Some(low.to_array().to_vec()), Some(high.to_array().to_vec()));
        let mut primitives = Vec::new();
        for (indices, surface) in triangles.iter().filter(|(indices, _)| !indices.is_empty()) {
            let attributes = match surface {
                // The colour of bark is not that of wood below it. A second set of places needs the first.
                Surface::Plain(..) => Attributes {
                    tangent: None,
                    texcoord_0: attributes.texcoord_0.filter(|_| attributes.texcoord_1.is_some()),
                    color_0: None,
                    ..attributes
                },
                _ => attributes,
            };
            let indices = writer.indices(indices, count)?;
            primitives.push(Primitive { attributes, indices, material: writer.material(surface)? });
        }
        writer.root.meshes.push(Mesh { name, primitives, extras });
        Ok(Some(writer.root.meshes.len() - 1))
    }
}
