//! Materials of `UsdPreviewSurface`.

use std::io::{self, Write};

use super::{Pictures, ROOT, arrays::joined};
use crate::{
    mean_materials::{MeanMaterial, MeanMaterials},
    surface::ONE_CELL,
};

/// The scope of all materials.
pub(super) fn write(
    materials: &MeanMaterials,
    pictures: Pictures,
    metres: f32,
    out: &mut dyn Write,
) -> io::Result<()> {
    let has_pictures = pictures == Pictures::Beside;
    writeln!(out, "def Scope \"Looks\"\n{{")?;
    for material in &materials.all {
        one(material, has_pictures && material.texture.is_some(), metres, out)?;
    }
    writeln!(out, "}}")
}

fn one(material: &MeanMaterial, has_pictures: bool, metres: f32, out: &mut dyn Write) -> io::Result<()> {
    let path = format!("/{ROOT}/Looks/{}", material.name);
    writeln!(out, "def Material \"{}\"\n{{", material.name)?;
    writeln!(out, "token outputs:surface.connect = <{path}/Surface.outputs:surface>")?;
    writeln!(out, "def Shader \"Surface\"\n{{\nuniform token info:id = \"UsdPreviewSurface\"")?;
    writeln!(out, "float inputs:roughness = 0.8")?;
    if has_pictures {
        writeln!(out, "color3f inputs:diffuseColor.connect = <{path}/Colour.outputs:rgb>")?;
        writeln!(out, "normal3f inputs:normal.connect = <{path}/Normal.outputs:rgb>")?;
        if material.is_cut_out {
            writeln!(out, "float inputs:opacity.connect = <{path}/Colour.outputs:a>")?;
            writeln!(out, "float inputs:opacityThreshold = 0.5")?;
        }
    } else {
        // Who follows no connection to colours of vertices has the value.
        writeln!(out, "color3f inputs:diffuseColor = {}", joined(&material.seen().to_array()))?;
        if material.texture.is_some() {
            writeln!(out, "color3f inputs:diffuseColor.connect = <{path}/Own.outputs:result>")?;
        }
    }
    writeln!(out, "token outputs:surface\n}}")?;
    if !has_pictures && material.texture.is_some() {
        // Each vertex has its own colour, and each leaf where they are instances; who knows none takes the material's.
        writeln!(out, "def Shader \"Own\"\n{{\nuniform token info:id = \"UsdPrimvarReader_float3\"")?;
        writeln!(out, "string inputs:varname = \"displayColor\"")?;
        writeln!(out, "float3 inputs:fallback = {}", joined(&material.seen().to_array()))?;
        writeln!(out, "float3 outputs:result\n}}")?;
    }
    if has_pictures {
        writeln!(out, "def Shader \"Place\"\n{{\nuniform token info:id = \"UsdPrimvarReader_float2\"")?;
        writeln!(out, "string inputs:varname = \"st\"\nfloat2 outputs:result\n}}")?;
        // The relief is the same in all cells of the colours.
        let cells = material.cells();
        if cells != ONE_CELL {
            writeln!(out, "def Shader \"Cell\"\n{{\nuniform token info:id = \"UsdTransform2d\"")?;
            writeln!(out, "float2 inputs:in.connect = <{path}/Place.outputs:result>")?;
            writeln!(out, "float2 inputs:scale = ({}, {})\nfloat2 outputs:result\n}}", cells[0], cells[1])?;
        }
        let relief = material.texture.as_ref().map_or(1.0, |(_, relief)| *relief);
        // Textures of normals count from -1 to 1; the relief makes them steeper.
        let (slope, rest) = (2.0 * relief, -relief);
        // Nothing is moved by depths: whoever draws cards with them takes them from here, in metres.
        let depth = material.texture.as_ref().and_then(|(texture, _)| texture.depth.as_ref()).map(|depth| {
            let [(_, far), (_, near)] = depth.about(metres);
            let gain = near - far;
            let settings =
                format!("float4 inputs:scale = ({gain}, {gain}, {gain}, 1)\nfloat4 inputs:bias = ({far}, {far}, {far}, 0)");
            ("Depth", "depth", "raw", settings)
        });
        let both = [
            // Never changed when it is read: not all programs keep alpha out of that.
            ("Colour", "colour", "sRGB", String::new()),
            (
                "Normal",
                "normal",
                "raw",
                format!(
                    "float4 inputs:scale = ({slope}, {slope}, 2, 1)\nfloat4 inputs:bias = ({rest}, {rest}, -1, 0)"
                ),
            ),
        ];
        for (name, kind, space, settings) in both.into_iter().chain(depth) {
            writeln!(out, "def Shader \"{name}\"\n{{\nuniform token info:id = \"UsdUVTexture\"")?;
            writeln!(out, "asset inputs:file = @{}@", material.picture(kind))?;
            let place = if name == "Normal" && cells != ONE_CELL { "Cell" } else { "Place" };
            writeln!(out, "float2 inputs:st.connect = <{path}/{place}.outputs:result>")?;
            writeln!(out, "token inputs:sourceColorSpace = \"{space}\"")?;
            if !settings.is_empty() {
                writeln!(out, "{settings}")?;
            }
            writeln!(out, "token inputs:wrapS = \"repeat\"\ntoken inputs:wrapT = \"repeat\"")?;
            writeln!(out, "float3 outputs:rgb\nfloat outputs:a\n}}")?;
        }
    }
    writeln!(out, "}}")
}
