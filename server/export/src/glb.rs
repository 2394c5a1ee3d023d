//! glTF 2.0 binary: bark and leaves as two meshes, in metres, Y up.

use espalier_mesh::{Style, TriangleMesh, leaf_mesh, wood};
use espalier_plant::Plant;
use espalier_settings::Appearance;
use glam::Vec3;

use crate::gltf::{
    ARRAY_BUFFER, Accessor, Asset, Attributes, Buffer, BufferView, ELEMENT_ARRAY_BUFFER, FLOAT, Material,
    Mesh, Node, PbrMetallicRoughness, Primitive, Root, Scene, UNSIGNED_INT, UNSIGNED_SHORT,
};
use crate::picture::{leaf_look, linear};

const MAGIC: u32 = u32::from_le_bytes(*b"glTF");
const VERSION: u32 = 2;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const BINARY_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");
/// The index that glTF keeps for restarting a strip; it must not name a vertex.
const RESERVED_INDEX: usize = u16::MAX as usize;

/// Why a plant could not be exported.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// Nothing can be that large or small.
    #[error("an internode cannot be {0} m long")]
    Scale(f32),
    /// The format counts bytes in 32 bits.
    #[error("the file would be larger than 4 GiB")]
    TooLarge,
    /// The plant is so large that a position in metres is infinite.
    #[error("the tree is too large to be measured in metres")]
    NotFinite,
}

/// The present of `plant` as a glTF binary file. A plant without wood gives a valid file without meshes.
pub fn glb(
    plant: &Plant,
    style: &Style,
    appearance: &Appearance,
    metres_per_internode: f32,
) -> Result<Vec<u8>, ExportError> {
    if !(metres_per_internode.is_finite() && metres_per_internode > 0.0) {
        return Err(ExportError::Scale(metres_per_internode));
    }
    let mut writer = Writer::new(metres_per_internode);
    for wood in wood(plant, style, &appearance.bark) {
        writer.add("Bark", &wood.into_mesh(), bark_material(linear(appearance.bark.tint)))?;
    }
    let (leaves, hues): (Vec<_>, Vec<_>) =
        leaf_look::hanging(plant, style, &appearance.leaves).into_iter().unzip();
    // The material has one colour for all of them.
    let colour = hues.iter().sum::<Vec3>() / hues.len().max(1) as f32;
    writer.add("Leaves", &leaf_mesh(&leaves), leaf_material(colour.min(Vec3::ONE)))?;
    writer.finish()
}

/// The colour is linear.
fn bark_material(colour: Vec3) -> Material {
    Material {
        name: "Bark",
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: colour.extend(1.0).to_array(),
            metallic_factor: 0.0,
            roughness_factor: 0.95,
        },
        double_sided: false,
    }
}

fn leaf_material(colour: Vec3) -> Material {
    Material {
        name: "Leaves",
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: colour.extend(1.0).to_array(),
            metallic_factor: 0.0,
            roughness_factor: 0.7,
        },
        double_sided: true,
    }
}

/// Collects meshes under one node.
struct Writer {
    scale: f32,
    root: Root,
    binary: Vec<u8>,
}

impl Writer {
    fn new(scale: f32) -> Self {
        let root = Root {
            asset: Asset { version: "2.0", generator: "Espalier" },
            scene: 0,
            scenes: vec![Scene { name: "Scene", nodes: vec![0] }],
            nodes: vec![Node { name: "Tree", mesh: None, children: Vec::new() }],
            meshes: Vec::new(),
            materials: Vec::new(),
            accessors: Vec::new(),
            buffer_views: Vec::new(),
            buffers: Vec::new(),
        };
        Self { scale, root, binary: Vec::new() }
    }

    /// Adds a mesh, its material and its node; an empty mesh adds nothing, for an accessor must not be empty.
    fn add(
        &mut self,
        name: &'static str,
        mesh: &TriangleMesh,
        material: Material,
    ) -> Result<(), ExportError> {
        let Some(bounds) = mesh.bounds().filter(|_| !mesh.is_empty()) else { return Ok(()) };
        let primitive = Primitive {
            attributes: Attributes {
                position: self.positions(&mesh.positions, bounds)?,
                normal: self.floats("VEC3", mesh.normals.iter().map(|normal| normal.to_array())),
                // An image's first row is its top.
                texcoord_0: self.floats("VEC2", mesh.uvs.iter().map(|uv| [uv.x, 1.0 - uv.y])),
            },
            indices: self.indices(mesh),
            material: self.root.materials.len(),
        };
        self.root.materials.push(material);
        self.root.nodes.push(Node { name, mesh: Some(self.root.meshes.len()), children: Vec::new() });
        self.root.meshes.push(Mesh { name, primitives: [primitive] });
        let child = self.root.nodes.len() - 1;
        self.root.nodes[0].children.push(child);
        Ok(())
    }

    fn positions(&mut self, positions: &[Vec3], bounds: [Vec3; 2]) -> Result<usize, ExportError> {
        let scale = self.scale;
        // Multiplication keeps the order, so the corners of the scaled box are the scaled corners to the last bit.
        let [min, max] = bounds.map(|corner| corner * scale);
        if !(min.is_finite() && max.is_finite()) {
            return Err(ExportError::NotFinite);
        }
        let index = self.floats("VEC3", positions.iter().map(|&position| (position * scale).to_array()));
        let accessor = &mut self.root.accessors[index];
        (accessor.min, accessor.max) = (Some(min.to_array()), Some(max.to_array()));
        Ok(index)
    }

    fn floats<const N: usize>(
        &mut self,
        shape: &'static str,
        values: impl Iterator<Item = [f32; N]>,
    ) -> usize {
        let (offset, mut count) = (self.binary.len(), 0);
        self.words(values.inspect(|_| count += 1).flatten().map(f32::to_le_bytes));
        self.accessor(offset, ARRAY_BUFFER, FLOAT, shape, count)
    }

    fn indices(&mut self, mesh: &TriangleMesh) -> usize {
        let (offset, count) = (self.binary.len(), mesh.indices.len());
        let component_type = if mesh.positions.len() <= RESERVED_INDEX {
            self.words(mesh.indices.iter().map(|&index| (index as u16).to_le_bytes()));
            UNSIGNED_SHORT
        } else {
            self.words(mesh.indices.iter().map(|index| index.to_le_bytes()));
            UNSIGNED_INT
        };
        self.accessor(offset, ELEMENT_ARRAY_BUFFER, component_type, "SCALAR", count)
    }

    fn words<const N: usize>(&mut self, words: impl Iterator<Item = [u8; N]>) {
        self.binary.reserve(N * words.size_hint().0);
        for word in words {
            self.binary.extend_from_slice(&word);
        }
    }

    /// Makes the bytes from `offset` on a view and an accessor, and returns the accessor.
    fn accessor(
        &mut self,
        offset: usize,
        target: u32,
        component_type: u32,
        shape: &'static str,
        count: usize,
    ) -> usize {
        let byte_length = self.binary.len() - offset;
        self.root.buffer_views.push(BufferView { buffer: 0, byte_offset: offset, byte_length, target });
        // The next view must begin where its components are aligned.
        pad(&mut self.binary, 0);
        self.root.accessors.push(Accessor {
            buffer_view: self.root.buffer_views.len() - 1,
            component_type,
            count,
            shape,
            min: None,
            max: None,
        });
        self.root.accessors.len() - 1
    }

    fn finish(mut self) -> Result<Vec<u8>, ExportError> {
        if !self.binary.is_empty() {
            self.root.buffers.push(Buffer { byte_length: self.binary.len() });
        }
        // Writing to memory does not fail, and all keys are strings.
        let mut json = serde_json::to_vec(&self.root).expect("the root is always JSON");
        pad(&mut json, b' ');
        let chunks = [(JSON_CHUNK, json), (BINARY_CHUNK, self.binary)];
        let chunks = chunks.iter().filter(|(_, bytes)| !bytes.is_empty());
        let length = 12 + chunks.clone().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
        let total = u32::try_from(length).map_err(|_| ExportError::TooLarge)?;
        let mut file = Vec::with_capacity(length);
        let word = |file: &mut Vec<u8>, word: u32| file.extend(word.to_le_bytes());
        for header in [MAGIC, VERSION, total] {
            word(&mut file, header);
        }
        for (kind, bytes) in chunks {
            // Shorter than the file, whose length has 32 bits.
            word(&mut file, bytes.len() as u32);
            word(&mut file, *kind);
            file.extend(bytes);
        }
        Ok(file)
    }
}

/// Chunks and views begin at multiples of four.
fn pad(bytes: &mut Vec<u8>, filler: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), filler);
}
