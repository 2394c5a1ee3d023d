//! The part of glTF 2.0's JSON that a plant needs.

use serde::Serialize;

/// `componentType` of 16-bit indices.
pub(crate) const UNSIGNED_SHORT: u32 = 5123;
/// `componentType` of 32-bit indices.
pub(crate) const UNSIGNED_INT: u32 = 5125;
/// `componentType` of everything else.
pub(crate) const FLOAT: u32 = 5126;
/// `target` of a view of vertices.
pub(crate) const ARRAY_BUFFER: u32 = 34962;
/// `target` of a view of indices.
pub(crate) const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The root. glTF forbids empty lists, so they are left out.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Root {
    pub asset: Asset,
    pub scene: usize,
    pub scenes: Vec<Scene>,
    pub nodes: Vec<Node>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub meshes: Vec<Mesh>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<Material>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffer_views: Vec<BufferView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffers: Vec<Buffer>,
}

#[derive(Serialize)]
pub(crate) struct Asset {
    pub version: &'static str,
    pub generator: &'static str,
}

#[derive(Serialize)]
pub(crate) struct Scene {
    pub name: &'static str,
    pub nodes: Vec<usize>,
}

#[derive(Serialize)]
pub(crate) struct Node {
    pub name: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub children: Vec<usize>,
}

#[derive(Serialize)]
pub(crate) struct Mesh {
    pub name: &'static str,
    pub primitives: [Primitive; 1],
}

#[derive(Serialize)]
pub(crate) struct Primitive {
    pub attributes: Attributes,
    pub indices: usize,
    pub material: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub(crate) struct Attributes {
    pub position: usize,
    pub normal: usize,
    pub texcoord_0: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Material {
    pub name: &'static str,
    pub pbr_metallic_roughness: PbrMetallicRoughness,
    pub double_sided: bool,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct PbrMetallicRoughness {
    pub base_color_factor: [f32; 4],
    pub metallic_factor: f32,
    pub roughness_factor: f32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Accessor {
    pub buffer_view: usize,
    pub component_type: u32,
    pub count: usize,
    #[serde(rename = "type")]
    pub shape: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<[f32; 3]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BufferView {
    pub buffer: usize,
    pub byte_offset: usize,
    pub byte_length: usize,
    pub target: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Buffer {
    pub byte_length: usize,
}
