//! The part of glTF 2.0's JSON that a plant needs.

use serde::Serialize;
use serde_json::Value;

/// `componentType` of quantised directions.
pub(crate) const BYTE: u32 = 5120;
/// `componentType` of quantised places and turns.
pub(crate) const SHORT: u32 = 5122;
/// `componentType` of colours.
pub(crate) const UNSIGNED_BYTE: u32 = 5121;
/// `componentType` of 16-bit indices and of quantised places in a texture.
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
#[derive(Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Root {
    pub asset: Asset,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extensions_used: Vec<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extensions_required: Vec<&'static str>,
    pub scene: usize,
    pub scenes: Vec<Scene>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<Node>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub meshes: Vec<Mesh>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<Material>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub textures: Vec<Texture>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<Image>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub skins: Vec<Skin>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub animations: Vec<Animation>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffer_views: Vec<BufferView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffers: Vec<Buffer>,
}

#[derive(Default, Serialize)]
pub(crate) struct Asset {
    pub version: &'static str,
    pub generator: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub copyright: Option<String>,
    pub extras: Value,
}

#[derive(Serialize)]
pub(crate) struct Scene {
    pub name: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<usize>,
}

#[derive(Default, Serialize)]
pub(crate) struct Node {
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation: Option<[f32; 3]>,
    /// A turn, x y z w.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f32; 4]>,
    /// The same in all directions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skin: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub children: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extensions: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extras: Option<Value>,
}

#[derive(Serialize)]
pub(crate) struct Mesh {
    pub name: String,
    pub primitives: Vec<Primitive>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extras: Option<Value>,
}

#[derive(Serialize)]
pub(crate) struct Primitive {
    pub attributes: Attributes,
    pub indices: usize,
    pub material: usize,
}

#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub(crate) struct Attributes {
    pub position: usize,
    pub normal: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangent: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texcoord_0: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texcoord_1: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texcoord_2: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texcoord_3: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color_0: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints_0: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weights_0: Option<usize>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Skin {
    pub inverse_bind_matrices: usize,
    pub joints: Vec<usize>,
}

#[derive(Serialize)]
pub(crate) struct Animation {
    pub name: String,
    pub channels: Vec<Channel>,
    pub samplers: Vec<Sampler>,
}

#[derive(Serialize)]
pub(crate) struct Channel {
    pub sampler: usize,
    pub target: Target,
}

#[derive(Serialize)]
pub(crate) struct Target {
    pub node: usize,
    pub path: Path,
}

#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Path {
    Rotation,
    Translation,
}

/// Between its keys values go on evenly.
#[derive(Serialize)]
pub(crate) struct Sampler {
    pub input: usize,
    pub output: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Material {
    pub name: String,
    pub pbr_metallic_roughness: PbrMetallicRoughness,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_texture: Option<NormalTexture>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub occlusion_texture: Option<TextureInfo>,
    /// `OPAQUE` where it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha_mode: Option<&'static str>,
    pub double_sided: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extras: Option<Value>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct PbrMetallicRoughness {
    pub base_color_factor: [f32; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_color_texture: Option<TextureInfo>,
    pub metallic_factor: f32,
    pub roughness_factor: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub metallic_roughness_texture: Option<TextureInfo>,
}

#[derive(Clone, Copy, Serialize)]
pub(crate) struct TextureInfo {
    pub index: usize,
}

#[derive(Serialize)]
pub(crate) struct NormalTexture {
    pub index: usize,
    pub scale: f32,
}

#[derive(Serialize)]
pub(crate) struct Texture {
    pub source: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Image {
    pub name: String,
    pub mime_type: &'static str,
    pub buffer_view: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Accessor {
    pub buffer_view: usize,
    #[serde(skip_serializing_if = "is_zero")]
    pub byte_offset: usize,
    pub component_type: u32,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub normalized: bool,
    pub count: usize,
    #[serde(rename = "type")]
    pub shape: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<Vec<f32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<Vec<f32>>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BufferView {
    pub buffer: usize,
    pub byte_offset: usize,
    pub byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub byte_stride: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extensions: Option<Value>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Buffer {
    pub byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extensions: Option<Value>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(offset: &usize) -> bool {
    *offset == 0
}
