//! Materials of `UsdPreviewSurface`.

use super::{
    ROOT,
    layer::{
        Done, Layer, Prim, Value,
        Variability::{Uniform, Varying},
    },
};
use crate::mean_materials::{MeanMaterial, MeanMaterials};

/// A texture as it is read: its name in the material, what it holds, its space, and how what it holds is changed.
struct Picture {
    name: &'static str,
    kind: &'static str,
    space: &'static str,
    /// What its colours are multiplied by, and what is added then.
    change: Option<[[f32; 4]; 2]>,
}

/// The scope of all materials.
pub(super) fn write(
    materials: &MeanMaterials,
    has_pictures: bool,
    metres: f32,
    layer: &mut dyn Layer,
) -> Done {
    layer.begin(Prim { type_name: "Scope", name: "Looks", ..Prim::default() })?;
    for material in &materials.0 {
        one(material, has_pictures && material.texture.is_some(), metres, layer)?;
    }
    layer.end()
}

fn one(material: &MeanMaterial, has_pictures: bool, metres: f32, layer: &mut dyn Layer) -> Done {
    let path = format!("/{ROOT}/Looks/{}", material.name);
    layer.begin(Prim { type_name: "Material", name: &material.name, ..Prim::default() })?;
    layer.connected("token", "outputs:surface", &format!("{path}/Surface.outputs:surface"))?;
    shader(layer, "Surface", "UsdPreviewSurface")?;
    layer.value(Varying, "inputs:roughness", &Value::Float(0.8))?;
    if has_pictures {
        layer.connected("color3f", "inputs:diffuseColor", &format!("{path}/Colour.outputs:rgb"))?;
        layer.connected("normal3f", "inputs:normal", &format!("{path}/Normal.outputs:rgb"))?;
        if material.is_cut_out {
            layer.connected("float", "inputs:opacity", &format!("{path}/Colour.outputs:a"))?;
            layer.value(Varying, "inputs:opacityThreshold", &Value::Float(0.5))?;
        }
    } else {
        layer.value(Varying, "inputs:diffuseColor", &Value::Colour(material.seen().to_array()))?;
    }
    layer.declared("token", "outputs:surface")?;
    layer.end()?;
    if has_pictures {
        shader(layer, "Place", "UsdPrimvarReader_float2")?;
        layer.value(Varying, "inputs:varname", &Value::String("st"))?;
        layer.declared("float2", "outputs:result")?;
        layer.end()?;
        for Picture { name, kind, space, change } in pictures(material, metres) {
            shader(layer, name, "UsdUVTexture")?;
            layer.value(Varying, "inputs:file", &Value::Asset(&material.picture(kind)))?;
            layer.connected("float2", "inputs:st", &format!("{path}/Place.outputs:result"))?;
            layer.value(Varying, "inputs:sourceColorSpace", &Value::Token(space))?;
            // Never that of a picture whose alpha is read: not all programs keep it out of the change.
            if let Some([scale, bias]) = change {
                layer.value(Varying, "inputs:scale", &Value::Float4(scale))?;
                layer.value(Varying, "inputs:bias", &Value::Float4(bias))?;
            }
            layer.value(Varying, "inputs:wrapS", &Value::Token("repeat"))?;
            layer.value(Varying, "inputs:wrapT", &Value::Token("repeat"))?;
            layer.declared("float3", "outputs:rgb")?;
            layer.declared("float", "outputs:a")?;
            layer.end()?;
        }
    }
    layer.end()
}

fn shader(layer: &mut dyn Layer, name: &str, id: &str) -> Done {
    layer.begin(Prim { type_name: "Shader", name, ..Prim::default() })?;
    layer.value(Uniform, "info:id", &Value::Token(id))
}

fn pictures(material: &MeanMaterial, metres: f32) -> impl Iterator<Item = Picture> {
    let relief = material.texture.as_ref().map_or(1.0, |(_, relief)| *relief);
    // Textures of normals count from -1 to 1; the relief makes them steeper.
    let (slope, rest) = (2.0 * relief, -relief);
    // Nothing is moved by depths: whoever draws cards with them takes them from here, in metres.
    let depth = material.texture.as_ref().and_then(|(texture, _)| texture.depth.as_ref()).map(|depth| {
        let [(_, far), (_, near)] = depth.about(metres);
        let gain = near - far;
        let change = Some([[gain, gain, gain, 1.0], [far, far, far, 0.0]]);
        Picture { name: "Depth", kind: "depth", space: "raw", change }
    });
    let colour = Picture { name: "Colour", kind: "colour", space: "sRGB", change: None };
    let change = Some([[slope, slope, 2.0, 1.0], [rest, rest, -1.0, 0.0]]);
    let normal = Picture { name: "Normal", kind: "normal", space: "raw", change };
    [colour, normal].into_iter().chain(depth)
}
