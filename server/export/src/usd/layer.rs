//! What a scene says, whatever form it is written in: prims with attributes and relationships.

use serde_json::{Map, Value as Json};

use crate::ExportError;

pub(super) type Done = Result<(), ExportError>;
/// Takes the rows of a list, one after the other.
pub(super) type Rows<'a> = &'a mut dyn FnMut(&[f32]) -> Done;
/// Takes the numbers of a list, one after the other.
pub(super) type Numbers<'a> = &'a mut dyn FnMut(u32) -> Done;

/// A prim as it begins.
#[derive(Default)]
pub(super) struct Prim<'a> {
    pub(super) type_name: &'static str,
    pub(super) name: &'a str,
    pub(super) is_group: bool,
    pub(super) apis: &'static [&'static str],
    /// What is said of it besides, by name: whole numbers, others, and lists of them by name.
    pub(super) data: Map<String, Json>,
}

/// What an attribute is, unless it is a list.
pub(super) enum Value<'a> {
    Bool(bool),
    Token(&'a str),
    Tokens(&'a [&'a str]),
    String(&'a str),
    /// A file beside this one.
    Asset(&'a str),
    Float(f32),
    Colour([f32; 3]),
    Float4([f32; 4]),
    Double3([f32; 3]),
    Float3s(&'a [[f32; 3]]),
}

impl Value<'_> {
    pub(super) const fn type_name(&self) -> &'static str {
        match self {
            Self::Bool(_) => "bool",
            Self::Token(_) => "token",
            Self::Tokens(_) => "token[]",
            Self::String(_) => "string",
            Self::Asset(_) => "asset",
            Self::Float(_) => "float",
            Self::Colour(_) => "color3f",
            Self::Float4(_) => "float4",
            Self::Double3(_) => "double3",
            Self::Float3s(_) => "float3[]",
        }
    }
}

/// What the rows of a list are.
#[derive(Clone, Copy)]
pub(super) enum Row {
    Point,
    Normal,
    Place,
    Colour,
    Float3,
    /// A rotation, its real part first.
    Rotation,
}

impl Row {
    pub(super) const fn type_name(self) -> &'static str {
        match self {
            Self::Point => "point3f[]",
            Self::Normal => "normal3f[]",
            Self::Place => "texCoord2f[]",
            Self::Colour => "color3f[]",
            Self::Float3 => "float3[]",
            Self::Rotation => "quath[]",
        }
    }
}

/// Whether somebody who changes the scene may let an attribute change with time.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Variability {
    Varying,
    Uniform,
}

/// A layer that is being written, from its first prim to its last.
pub(super) trait Layer {
    fn begin(&mut self, prim: Prim<'_>) -> Done;
    /// Ends the prim that began last and has not ended.
    fn end(&mut self) -> Done;
    fn value(&mut self, variability: Variability, name: &str, value: &Value<'_>) -> Done;
    /// An attribute that follows another, which `target` is the path of.
    fn connected(&mut self, type_name: &'static str, name: &str, target: &str) -> Done;
    /// An attribute without a value.
    fn declared(&mut self, type_name: &'static str, name: &str) -> Done;
    /// A relationship to prims, by their paths.
    fn related(&mut self, name: &str, targets: &[String], is_list: bool) -> Done;
    /// A list of rows; with `is_vertex` one for each vertex.
    fn rows(&mut self, row: Row, name: &str, is_vertex: bool, fill: &mut dyn FnMut(Rows<'_>) -> Done)
    -> Done;
    fn numbers(&mut self, name: &str, fill: &mut dyn FnMut(Numbers<'_>) -> Done) -> Done;
}

/// What is said of the layer as a whole.
pub(super) struct Head<'a> {
    pub(super) program: &'a str,
    /// As JSON.
    pub(super) extras: &'a str,
    pub(super) copyright: Option<&'a str>,
}
